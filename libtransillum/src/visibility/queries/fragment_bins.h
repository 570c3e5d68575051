// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// A partition of the plane into square bins, each with the projected fragments that may reach into
/// it, in BSP order (decisions/0014-bins.md). Bins are small where fragments are small.
class FragmentBins {
 public:
  using Entry = std::int32_t;
  static constexpr Entry none = -1;

  /// A bin: [x, x + size) by [y, y + size) grid units, and its entries from begin to end. The entry
  /// before them and the one after them are sentinels without a fragment, whose boxes overlap every
  /// window.
  struct Bin {
    std::int64_t x, y, size;
    Entry begin, end;
  };

  /// @param backs_only front-facing fragments get boxes that overlap no window.
  FragmentBins(const ProjectedFragments& projected, bool backs_only)
      : projected_(projected), backs_only_(backs_only) {}

  /// Rebuilds the bins from the current projected fragments.
  /// @throws Canceled
  void fill(const Cancellation& cancellation);

  const std::vector<Bin>& bins() const { return bins_; }
  /// The fragment of an entry; -1 for sentinels.
  std::int32_t fragment(Entry e) const { return at(entry_fragments_, e); }
  const FragmentBox& box(Entry e) const { return at(boxes_, e); }
  /// The entries of one fragment, in different bins: the last one, and from each the one before.
  Entry last_entry(std::int32_t fragment) const { return at(last_, fragment); }
  Entry entry_before(Entry e) const { return at(before_, e); }
  std::int32_t entry_count(std::int32_t fragment) const { return at(counts_, fragment); }

 private:
  struct Region {
    std::int64_t x, y;
    int shift;               ///< its width is 2^shift grid units
    std::size_t begin, end;  ///< range of its fragments in lists_
  };
  /// The cells of a region that a fragment's box covers.
  struct Cells {
    std::int32_t x0, y0, x1, y1;
  };

  int cell_shift(const Region& region) const;
  void divide(const Region& region, int shift);
  bool reaches(std::int32_t fragment, std::int64_t x, std::int64_t y, std::int64_t size) const;
  Cells cells_of(std::int32_t fragment, const Region& region, int shift) const;
  void add_bin(const Region& region);
  void add_sentinel();

  const ProjectedFragments& projected_;
  bool backs_only_;
  std::vector<Bin> bins_;
  // Per entry.
  std::vector<FragmentBox> boxes_;
  std::vector<std::int32_t> entry_fragments_;
  std::vector<Entry> before_;
  // Per fragment.
  std::vector<Entry> last_;
  std::vector<std::int32_t> counts_;

  // While building:
  std::vector<std::int32_t> lists_;  ///< fragments of the regions in open_, one list after another
  std::vector<Region> open_;         ///< stack of regions still to be divided
  std::vector<Cells> cells_;         ///< per fragment of the region being divided
  std::vector<std::uint32_t> fill_;  ///< per cell of that region: where its list is filled
};

}  // namespace transillum
