// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/build/point_table.h"
#include "transillum/vec3.h"

namespace transillum {

/// A parameter of a built-in scene: a whole number within a range.
struct SceneParameter {
  std::string name;
  int default_value;
  int low, high;  ///< range
};

/// The values that follow a built-in's name and a colon, as in `levels=2,slices=17`.
class ParameterValues {
 public:
  /// @throws InputError that lists the available parameters.
  ParameterValues(const std::string& scene, const std::string& text,
                  const std::vector<SceneParameter>& parameters);
  int operator[](const std::string& name) const { return values_.at(name); }

 private:
  std::map<std::string, int> values_;
};

/// `levels=2,slices=17,stacks=8`: the parameters with their defaults.
std::string describe(const std::vector<SceneParameter>& parameters);

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

/// A convex floor minus a convex footprint of something that stands on it: convex parts, cut along
/// the lines of the footprint's edges like a pinwheel. Both outlines are counter-clockwise about
/// `up`. If the two do not overlap, the result is the whole floor.
///
/// If the floor continued under a block, it would see the inside of the block, and its radiosity
/// would be averaged over a region that no light reaches.
std::vector<std::vector<Vec3>> floor_around(const std::vector<Vec3>& floor,
                                            const std::vector<Vec3>& footprint, const Vec3& up);

/// The same for several footprints that do not overlap.
std::vector<std::vector<Vec3>> floor_around_all(const std::vector<Vec3>& floor,
                                                const std::vector<std::vector<Vec3>>& footprints,
                                                const Vec3& up);

// The built-in scenes, in meters. Each is closed: from the lit side of any face, every ray hits a
// face.

void make_sphere_flake(SceneMaker& maker, const ParameterValues& values,
                       const Cancellation& cancellation);
void make_cornell_box(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_furnace(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_flatland(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_boards(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_rooms(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_gallery(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_stars(SceneMaker& maker, const ParameterValues& values, const Cancellation&);

}  // namespace transillum
