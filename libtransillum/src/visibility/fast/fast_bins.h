// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "visibility/fast/projected_fragments.h"

namespace transillum {

/// The plane cut into square bins, each with the faces that may reach into it, in their order
/// (decisions/0014-bins.md). Bins are small where faces are.
class FastBins {
 public:
  using Entry = std::int32_t;
  static constexpr Entry none = -1;

  /// A bin: [x, x + size) by [y, y + size) steps, and its entries from begin to end. The entry
  /// before them and the one behind them are no faces but ends, which every box overlaps.
  struct Bin {
    std::int64_t x, y, size;
    Entry begin, end;
  };

  /// @param backs_only front-facing faces are not found by their boxes.
  FastBins(const ProjectedFragments& faces, bool backs_only)
      : input_(faces), backs_only_(backs_only) {}

  /// Deals the faces out anew.
  /// @throws Canceled
  void fill(const Cancellation& cancellation);

  const std::vector<Bin>& bins() const { return bins_; }
  /// The face of an entry; -1 at the ends.
  std::int32_t face(Entry e) const { return at(faces_of_, e); }
  const FaceBox& box(Entry e) const { return at(boxes_, e); }
  /// The entries of one face, in different bins: the last one, and from each to the one before.
  Entry last_entry(std::int32_t face) const { return at(last_, face); }
  Entry entry_before(Entry e) const { return at(before_, e); }
  std::int32_t entry_count(std::int32_t face) const { return at(counts_, face); }

 private:
  struct Region {
    std::int64_t x, y;
    int shift;               ///< 2^shift steps wide
    std::size_t begin, end;  ///< of its faces, in lists_
  };
  /// The cells of a region that a face reaches.
  struct Cells {
    std::int32_t x0, y0, x1, y1;
  };

  int cell_shift(const Region& region) const;
  void divide(const Region& region, int shift);
  bool reaches(std::int32_t face, std::int64_t x, std::int64_t y, std::int64_t size) const;
  Cells cells_of(std::int32_t face, const Region& region, int shift) const;
  void add_bin(const Region& region);
  void add_end();

  const ProjectedFragments& input_;
  bool backs_only_;
  std::vector<Bin> bins_;
  std::vector<FaceBox> boxes_;
  std::vector<std::int32_t> faces_of_;
  std::vector<Entry> before_;
  std::vector<Entry> last_;
  std::vector<std::int32_t> counts_;

  // While building: faces of the regions still to be divided, one list after the other.
  std::vector<std::int32_t> lists_;
  std::vector<Region> open_;
  std::vector<Cells> cells_;
  std::vector<std::uint32_t> fill_;
};

}  // namespace transillum
