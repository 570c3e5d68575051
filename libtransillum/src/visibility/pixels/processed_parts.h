// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// Whether the projection of a polygon holds a point of the plane. Two polygons at an edge compute
/// the same numbers, so one of them has it.
bool holds(std::span<const PointId> outline, const std::vector<Vec3>& points,
           const PlaneFrame& frame, const Vec2& point);

/// What of each patch some fragments of a tree are, as seen along a direction.
class ProcessedParts {
 public:
  /// Keeps references.
  ProcessedParts(const Scene& scene, const BspTree& tree, std::span<const FragmentId> fragments,
                 const PlaneFrame& frame);

  /// Whether a point of patch i's projection is in one of them.
  bool hold(PatchId i, const Vec2& at) const;

 private:
  struct Part {
    std::vector<PointId> outline;
    Vec2 low, high;  ///< the box round it
  };
  Part part_of(FragmentId f) const;

  const BspTree& tree_;
  PlaneFrame frame_;
  std::vector<bool> whole_;               ///< a patch: all of its fragments are there
  std::vector<std::vector<Part>> parts_;  ///< of a patch that is there in part
};

/// Finds the piece of a scene that a fragment of its tree was cut from.
class PieceFinder {
 public:
  /// Keeps references. `frame`: of a direction along which what is asked for is not edge-on.
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
