// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "pictures/gathered_light.h"
#include "pictures/lamp_light.h"

namespace transillum {

/// Gathered light, interpolated between points of a patch: bilinearly in quadrilaterals, which are
/// divided where what their middle gathers differs from the mean of their corners. Where that does
/// not help, the point itself gathers.
///
/// Threads: any number may query; a value does not depend on the order of queries.
class InterpolatedLight {
 public:
  /// Keeps references to all.
  InterpolatedLight(const Scene& scene, const GatheredLight& gathered, const LampLight& lamps);
  ~InterpolatedLight();
  InterpolatedLight(const InterpolatedLight&) = delete;
  InterpolatedLight& operator=(const InterpolatedLight&) = delete;

  /// Irradiance by what is not a lamp, W/m².
  Rgb at_point(PatchId patch, const Vec3& x) const;

 private:
  struct Cell;
  struct PatchCells;
  struct Quad {
    std::array<Vec3, 4> corners;
    std::array<std::int32_t, 4> node;  ///< of nodes_; -1: a point inside the patch
  };
  /// A point of the scene, as a part of a plane.
  struct Node {
    Vec3 place;  ///< a little inside
    Vec3 normal;
    std::atomic<const Rgb*> light{nullptr};
  };

  void make_nodes();
  const PatchCells& cells_of(PatchId patch) const;
  Vec3 inward(const Vec3& x, const Vec3& middle) const;
  Rgb light_of(Node& node) const;
  Rgb light_inside(const PatchCells& cells, const Vec3& x) const;
  const Cell& root_of(const PatchCells& cells, std::size_t q) const;
  const Cell* children_of(const PatchCells& cells, const std::array<Vec3, 4>& corners,
                          const Cell& cell) const;

  const Scene& scene_;
  const GatheredLight& gathered_;
  const LampLight& lamps_;
  double diagonal_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<std::int32_t> node_of_corner_;             ///< by corner of a piece
  std::vector<std::size_t> first_piece_;                 ///< by patch
  std::vector<std::size_t> first_corner_;                ///< by piece
  mutable std::vector<std::atomic<PatchCells*>> cells_;  ///< by patch
};

}  // namespace transillum
