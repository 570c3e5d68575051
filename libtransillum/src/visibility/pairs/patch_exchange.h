// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"
#include "transillum/scene.h"

namespace transillum {

/// What two patches exchange.
struct PatchExchange {
  double area = 0;    ///< A_i F_ij = A_j F_ji, m²
  bool whole = true;  ///< nothing stands between: exact but for rounding
};

/// Form factors of single pairs of patches, with what stands between.
///
/// Where nothing reaches into the shaft between them, it is that of the polygons. Else the smaller
/// of the two is taken as points, from each of which the other is seen exactly, less the blockers'
/// shadows: the error falls about as the square of the points' distance, or as the distance where a
/// blocker touches the smaller. Of patches of one plane
/// that face the same way those cover others that do in BspTree::order(). Surfaces nearer to each
/// other than 1e-12 of the scene's size count as touching, and then as back to back or side by
/// side.
///
/// Time grows with what is in the shaft, and the logarithm of the number of patches.
/// Threads: immutable once built.
class ExchangeFinder {
 public:
  /// Keeps a reference.
  /// @param density points along a patch as large as its distance; the more, the finer.
  /// @throws Canceled
  explicit ExchangeFinder(const Scene& scene, const Cancellation& cancellation = {},
                          double density = 16);

  PatchExchange operator()(PatchId i, PatchId j) const;

 private:
  std::vector<Corners> open_parts(std::size_t piece, const BoxTree& pieces) const;
  bool covers(PatchId upper, PatchId lower) const;
  Corners corners_of(const Piece& piece) const;
  void collect_blockers(const FacingPolygons& facing, std::vector<Corners>& blockers) const;
  bool is_hidden(const FacingPolygons& facing, const Corners& blocker) const;
  double partial_exchange(const FacingPolygons& facing, const std::vector<Corners>& blockers) const;
  std::span<const Corners> parts_of(PatchId i) const {
    const auto k = static_cast<std::size_t>(i);
    return {parts_.data() + part_begin_[k], part_begin_[k + 1] - part_begin_[k]};
  }

  const Scene& scene_;
  double density_;
  double tolerance_;
  std::vector<Corners> blockers_;
  BoxTree tree_;                ///< of blockers_
  std::vector<Corners> parts_;  ///< convex, of patches, less what covers them
  std::vector<std::size_t> part_begin_;
};

}  // namespace transillum
