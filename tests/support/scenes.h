// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <random>
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

/// The same faces with every point mapped by `move`.
SceneDescription moved(const SceneDescription& description,
                       const std::function<Vec3(const Vec3&)>& move);
/// The same faces in another order.
SceneDescription reordered(const SceneDescription& description, const std::vector<int>& order);

/// A random rotation.
std::function<Vec3(const Vec3&)> random_rotation(std::uint64_t seed);

/// `count` unit vectors: axes and diagonals, along which many faces are edge-on, then random ones.
std::vector<Vec3> test_directions(int count, std::uint64_t seed);

}  // namespace transillum::testing
