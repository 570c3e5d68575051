// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/read/gltf/gltf_file.h"
#include "transillum/vec3.h"

namespace transillum {

/// Three of the numbers.
inline Vec3 vector_of(const std::vector<double>& v, std::size_t first = 0) {
  return {v[first], v[first + 1], v[first + 2]};
}

/// An affine map: columns, then the origin.
struct Placement {
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 origin;

  Vec3 direction(const Vec3& v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
  Vec3 point(const Vec3& p) const { return direction(p) + origin; }
  Placement operator*(const Placement& inner) const {
    return {{direction(inner.axes[0]), direction(inner.axes[1]), direction(inner.axes[2])},
            point(inner.origin)};
  }
  /// Whether no triangle has an area.
  bool flattens() const {
    return norm(cross(axes[0], axes[1])) == 0 && norm(cross(axes[1], axes[2])) == 0 &&
           norm(cross(axes[2], axes[0])) == 0;
  }
  bool mirrors() const { return dot(cross(axes[0], axes[1]), axes[2]) < 0; }
  /// The largest sum of magnitudes in a row.
  double growth() const {
    const auto row = [&](double Vec3::*c) {
      return std::abs(axes[0].*c) + std::abs(axes[1].*c) + std::abs(axes[2].*c);
    };
    return std::max({row(&Vec3::x), row(&Vec3::y), row(&Vec3::z)});
  }
};

/// A node of a file's scene.
struct PlacedNode {
  int node;
  Placement placement;
};
/// The nodes of the scene, each with its place, parents first.
/// @throws InputError naming the file and the node
std::vector<PlacedNode> placed_nodes(const GltfFile& file);

}  // namespace transillum
