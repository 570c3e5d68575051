// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Random points of surfaces and rays from them, with which the sides of faces are judged. Lengths
// are in Embree's units, in which the scene has radius 1.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "base/bit_mixing.h"
#include "transillum/at.h"
#include "transillum/scene.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {

/// Random numbers that depend on a key only, so that each sample has its own.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t key) : state_(mixed(key + golden_step)) {}
  /// Uniform in [0,1).
  double next() { return static_cast<double>(mixed(state_ += golden_step) >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

/// Points of a list of patches, uniform by area.
class SurfacePoints {
 public:
  struct Point {
    PatchId patch;
    Vec3 position;  ///< in Embree's units
  };
  /// Triangles of consecutive patches of the list.
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  SurfacePoints(const Scene& scene, const EmbreeScene& embree, std::span<const PatchId> patches) {
    std::vector<std::size_t> first_piece(scene.patches().size() + 1, scene.pieces().size());
    for (std::size_t p = scene.pieces().size(); p-- > 0;) {
      at(first_piece, scene.pieces()[p].patch) = p;
    }
    below_.push_back(0);
    for (const PatchId i : patches) {
      for (std::size_t p = at(first_piece, i);
           p < scene.pieces().size() && scene.pieces()[p].patch == i; ++p) {
        add(scene, embree, scene.pieces()[p]);
      }
      ends_.push_back(triangles_.size());
    }
  }
  /// The triangles of patches `begin` to `end` of the list.
  Range range(std::size_t begin, std::size_t end) const {
    return {begin > 0 ? ends_[begin - 1] : 0, end > 0 ? ends_[end - 1] : 0};
  }
  /// @param where the position in the range's area, in [0,1).
  Point point(const Range& range, double where, RandomNumbers& random) const {
    const double area = below_[range.begin] + where * (below_[range.end] - below_[range.begin]);
    const auto found = std::upper_bound(below_.begin() + to_difference(range.begin),
                                        below_.begin() + to_difference(range.end), area);
    const Triangle& t =
        triangles_[std::max<std::size_t>(static_cast<std::size_t>(found - below_.begin()),
                                         range.begin + 1) -
                   1];
    const double root = std::sqrt(random.next()), v = random.next();
    return {t.patch, t.corner + root * (1 - v) * t.a + root * v * t.b};
  }

 private:
  struct Triangle {
    PatchId patch;
    Vec3 corner, a, b;
  };
  static std::ptrdiff_t to_difference(std::size_t k) { return static_cast<std::ptrdiff_t>(k); }
  void add(const Scene& scene, const EmbreeScene& embree, const Piece& piece) {
    const auto corners = scene.corners(piece);
    const auto corner = [&](std::size_t k) { return embree.inside(scene.point(corners[k])); };
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Vec3 a = corner(k) - corner(0), b = corner(k + 1) - corner(0);
      triangles_.push_back({piece.patch, corner(0), a, b});
      below_.push_back(below_.back() + norm(cross(a, b)));
    }
  }

  std::vector<Triangle> triangles_;
  std::vector<double> below_;      ///< twice the area of all triangles before each, and of all
  std::vector<std::size_t> ends_;  ///< by patch of the list: one past its last triangle
};

/// A direction distributed as diffuse light that leaves a surface with this unit normal.
inline Vec3 diffuse_direction(const Vec3& normal, RandomNumbers& random) {
  const Vec3 u =
      normalized(cross(std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, normal));
  const Vec3 v = cross(normal, u);
  const double square = random.next(), angle = 2 * std::numbers::pi * random.next();
  const double radius = std::sqrt(square);
  return radius * std::cos(angle) * u + radius * std::sin(angle) * v +
         std::sqrt(1 - square) * normal;
}

/// Where a ray meets a surface.
struct SurfaceHit {
  PatchId patch;
  float distance;
};

/// Height above a surface at which rays start: a few roundings of a coordinate.
inline constexpr double ray_lift = 1e-6;

/// Paths of light, and the surfaces that one meets at most.
inline constexpr std::size_t path_count = 1U << 13, longest_path = 16, paths_in_block = 128;
/// Fraction of the paths below which light meets nothing that counts.
inline constexpr double nothing = 1e-3;

/// The first surface that a ray meets, on either side.
inline std::optional<SurfaceHit> first_meeting(const EmbreeScene& embree, const Vec3& origin,
                                               const Vec3& direction) {
  RTCRayHit ray = make_ray(origin, direction);
  embree.first_hit(ray, false);
  if (!has_hit(ray)) {
    return std::nullopt;
  }
  return SurfaceHit{embree.patch_of(ray.hit.primID), ray.ray.tfar};
}

}  // namespace transillum
