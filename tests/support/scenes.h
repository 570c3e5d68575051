// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::testing {

/// A description under construction, for tests.
class Sketch {
 public:
  explicit Sketch(std::string name = "test") { description_.name = std::move(name); }
  /// Materials are gray: reflectance and exitance.
  int material(double reflectance, double exitance);
  Sketch& face(const std::vector<Vec3>& outline, int material);
  /// The box between two corners; faces point inward if `inward`.
  Sketch& box(const Vec3& low, const Vec3& high, bool inward, int material);
  /// The parallelogram at `corner` as divisions² faces; it faces along cross(u, v). The material of
  /// a face is taken at its middle, whose coordinates along u and v are 0 to 1.
  Sketch& grid(const Vec3& corner, const Vec3& u, const Vec3& v, int divisions,
               const std::function<int(double s, double t)>& material);
  /// `count` random triangles of about `size` in the unit cube.
  Sketch& triangles(int count, double size, std::uint64_t seed, int material);
  /// `count` random tetrahedra of about `size` in the unit cube, with faces pointing outward; they
  /// may intersect.
  Sketch& tetrahedra(int count, double size, std::uint64_t seed, int material);
  const SceneDescription& description() const { return description_; }
  std::shared_ptr<const Scene> scene(const SceneOptions& options = {}) const {
    return std::make_shared<const Scene>(description_, options);
  }

 private:
  SceneDescription description_;
};

/// A cube of 1 m with `wall`² faces a wall, around a box of 0.4 m with `side`² faces a side, whose
/// points are mapped by `move`. Reflectance 0.5; the middle quarter of the ceiling emits.
Sketch box_in_cube(
    int wall = 8, int side = 4,
    const std::function<Vec3(const Vec3&)>& move = [](const Vec3& p) { return p; });

/// The same faces with every point mapped by `move`.
SceneDescription moved(const SceneDescription& description,
                       const std::function<Vec3(const Vec3&)>& move);
/// The same faces in another order.
SceneDescription reordered(const SceneDescription& description, const std::vector<int>& order);

/// A random rotation.
std::function<Vec3(const Vec3&)> random_rotation(std::uint64_t seed);

/// A random rotation about a point.
std::function<Vec3(const Vec3&)> random_rotation_about(const Vec3& center, std::uint64_t seed);

/// `count` unit vectors: axes and diagonals, along which many faces are edge-on, then random ones.
std::vector<Vec3> test_directions(int count, std::uint64_t seed);

}  // namespace transillum::testing
