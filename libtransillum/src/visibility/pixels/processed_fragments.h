// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// Whether the projection of a polygon contains a point of the plane. Both polygons at a common
/// edge compute the same numbers, so a point on it is in exactly one of them.
bool contains_point(std::span<const PointId> outline, const std::vector<Vec3>& points,
                    const PlaneFrame& frame, const Vec2& point);

/// The parts of each patch that are covered by some of the tree's fragments, projected along a
/// direction.
class ProcessedFragments {
 public:
  /// Keeps references.
  ProcessedFragments(const Scene& scene, const BspTree& tree, std::span<const FragmentId> fragments,
                     const PlaneFrame& frame);

  /// Whether a point of patch i's projection is in one of the fragments.
  bool covers(PatchId i, const Vec2& point) const;

 private:
  struct BoxedOutline {
    std::vector<PointId> outline;
    Vec2 low, high;  ///< bounding box
  };
  BoxedOutline boxed_outline_of(FragmentId f) const;

  const BspTree& tree_;
  PlaneFrame frame_;
  std::vector<bool> whole_;  ///< per patch: all of its fragments are included
  std::vector<std::vector<BoxedOutline>> outlines_;  ///< per patch of which some are missing
};

/// Finds the piece of a scene that a fragment of its tree was cut from.
class PieceFinder {
 public:
  /// Keeps references. @param frame of a direction along which the queried fragments are not
  /// edge-on
  PieceFinder(const Scene& scene, const BspTree& tree, const PlaneFrame& frame);

  /// Index in Scene::pieces().
  std::size_t piece_of(FragmentId f) const;

 private:
  const Scene& scene_;
  const BspTree& tree_;
  PlaneFrame frame_;
  std::vector<std::vector<std::size_t>> pieces_;  ///< by patch
};

}  // namespace transillum
