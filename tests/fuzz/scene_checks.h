// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Checks that hold for every scene that is built from a file, however damaged the file is.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "fuzz/require.h"
#include "radiosity/norms.h"
#include "transillum/at.h"
#include "transillum/scene.h"

namespace transillum::fuzz {

/// Newell vector of an outline: its normal times twice its area.
inline Vec3 doubled_area(const Scene& scene, std::span<const PointId> outline) {
  Vec3 sum;
  const Vec3 origin = scene.point(outline[0]);
  for (std::size_t k = 2; k < outline.size(); ++k) {
    sum = sum + cross(scene.point(outline[k - 1]) - origin, scene.point(outline[k]) - origin);
  }
  return sum;
}

/// Largest effect of the rounding of coordinates on an area in the scene, m².
inline double rounding_of_areas(const Scene& scene) {
  double largest = 0;
  for (const Vec3& p : scene.points()) {
    largest = std::max(largest, max_abs(p));
  }
  return 256 * 0x1p-52 * largest * scene.bounds().diagonal();
}

/// Uncertainty of the area of a slightly bent patch that is treated as planar, m²: a corner that is
/// straight in the projection along an axis, but not in the projection along the normal, is in no
/// triangle.
inline double bend_of(const Scene& scene, PatchId i) {
  const Patch& patch = scene.patch(i);
  Bounds box;
  double deviation = 0;
  for (const PointId p : scene.outline(i)) {
    box.add(scene.point(p));
    deviation = std::max(deviation, std::abs(dot(patch.normal, scene.point(p) - patch.center)));
  }
  return deviation * box.diagonal();
}

inline void check(const Scene& scene) {
  const double rounding = rounding_of_areas(scene);
  std::vector<double> piece_area(static_cast<std::size_t>(scene.patch_count()));
  for (const Piece& piece : scene.pieces()) {
    require(piece.end - piece.begin >= 3, "a piece has three corners");
    const Vec3& normal = scene.patch(piece.patch).normal;
    const double area = dot(normal, doubled_area(scene, scene.corners(piece))) / 2;
    at(piece_area, piece.patch) += area;
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& patch = scene.patch(i);
    require(patch.area > 0 && std::isfinite(patch.area), "a patch has an area");
    require(std::abs(norm(patch.normal) - 1) < 1e-12, "a normal is a unit vector");
    require(is_finite(patch.center), "a patch has a center");
    require(std::abs(at(piece_area, i) - patch.area) <=
                1e-9 * patch.area + bend_of(scene, i) + rounding,
            "the pieces cover the patch");
    const Rgb &rho = scene.reflectance(i), &e = scene.exitance(i);
    for (const double channel : {rho.r, rho.g, rho.b}) {
      require(channel >= 0 && channel < 1, "0 <= rho < 1");
    }
    for (const double channel : {e.r, e.g, e.b}) {
      require(channel >= 0 && std::isfinite(channel), "0 <= E < infinity");
    }
  }
}

}  // namespace transillum::fuzz
