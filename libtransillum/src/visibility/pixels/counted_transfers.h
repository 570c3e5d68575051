// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/transfers.h"
#include "visibility/pixels/patch_heights.h"
#include "visibility/pixels/pixel_grid.h"

namespace transillum {

/// Transfers of one direction from sample lines along it, all of the same area. Lines are counted
/// in integers, so the result does not depend on the order of the calls.
class CountedTransfers : public VisibilitySink {
 public:
  /// Keeps references.
  CountedTransfers(const Scene& scene, const PatchHeights& heights,
                   const Cancellation& cancellation);

  /// Adds `count` lines on which `below` is the next patch below `above` (no_patch: the topmost).
  void count(PatchId below, PatchId above, std::int64_t count);
  void record(int /*row*/, int begin, int end, PatchId below, PatchId above) override {
    count(below, above, end - begin);
  }

  /// @param area that each line represents, m²
  /// @returns all transfers; may be called once
  /// @throws Canceled
  Transfers finish(const Vec3& omega, double area);

 private:
  struct Side {
    std::int64_t projected = 0, covered = 0;
  };
  struct Exchange {
    PatchId receiver, source;
    std::int64_t count;
  };
  Side& side(PatchId i) { return at((heights_.front_facing(i) ? forward_ : backward_), i); }
  void merge_exchanges();

  const Scene& scene_;
  const PatchHeights& heights_;
  const Cancellation& cancellation_;
  std::vector<Side> forward_, backward_;
  std::vector<std::int64_t> back_seen_;
  std::vector<Exchange> exchanges_, by_receiver_;
  std::size_t merge_at_ = 1 << 20;  ///< size of exchanges_ at which equal pairs are merged
};

}  // namespace transillum
