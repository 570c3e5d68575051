// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "scene/build/point_table.h"

namespace transillum {

/// Builds the description of a built-in scene. Equal points become one, so adjacent faces share
/// their corners.
class SceneMaker {
 public:
  using MaterialNumber = int;

  MaterialNumber material(const std::string& name, const Rgb& reflectance, const Rgb& exitance = {},
                          const Lobe& lobe = {});
  PointId point(const Vec3& position) { return table_.id_of(position); }
  /// Adds a face; corners counter-clockwise seen from the lit side.
  void face(const std::vector<PointId>& outline, MaterialNumber material);
  void face(const std::vector<Vec3>& outline, MaterialNumber material);

  /// A parallelepiped: a corner and three edges from it, right-handed.
  struct Block {
    Vec3 corner;
    Vec3 x, y, z;
    Vec3 at(int i, int j, int k) const { return corner + i * x + j * y + k * z; }
  };
  enum class Facing { outward, inward };
  /// The six sides of a block.
  void block(const Block& block, Facing facing, MaterialNumber material);
  /// A floor facing up (+z), without the parts under the blocks that stand on it.
  void floor(const std::vector<Vec3>& outline, const std::vector<Block>& standing,
             MaterialNumber material);
  /// A block that stands on a floor: without its bottom, which is invisible.
  void standing_block(const Block& block, MaterialNumber material);
  /// The four walls of a block.
  void walls(const Block& block, Facing facing, MaterialNumber material);

  /// An axis-parallel rectangle in a horizontal plane, m.
  struct Rectangle {
    double x0, x1, y0, y1;
  };
  /// A ceiling at height z over `room` facing down, with the rectangle `lamp` as a light.
  void lit_ceiling(const Rectangle& room, const Rectangle& lamp, double z, MaterialNumber ceiling,
                   MaterialNumber light);

  std::int64_t face_count() const { return static_cast<std::int64_t>(description_.face_count()); }
  SceneDescription take(const std::string& name);

 private:
  SceneDescription description_;
  PointTable table_;
};

}  // namespace transillum
