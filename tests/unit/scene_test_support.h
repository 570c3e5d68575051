// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Small scene descriptions and measurements of scenes for the scene tests.

#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "transillum/scene.h"

namespace transillum::test {

/// A description with the given points and faces and one gray material.
inline SceneDescription polygons(const std::vector<Vec3>& points,
                                 const std::vector<std::vector<PointId>>& faces) {
  SceneDescription description;
  description.name = "test";
  description.points = points;
  description.materials = {{"gray", {0.5, 0.5, 0.5}, {}}};
  for (const auto& face : faces) {
    description.add_face(face, 0);
  }
  return description;
}
/// A description with one face that uses all points in order.
inline SceneDescription polygon(const std::vector<Vec3>& points) {
  std::vector<PointId> outline;
  for (std::size_t i = 0; i < points.size(); ++i) {
    outline.push_back(static_cast<PointId>(i));
  }
  return polygons(points, {outline});
}

/// Newell vector of an outline: its normal times twice its area.
inline Vec3 doubled_area(const Scene& scene, std::span<const PointId> outline) {
  Vec3 sum;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 origin = scene.point(outline[0]);
    sum = sum + cross(scene.point(outline[i]) - origin,
                      scene.point(outline[(i + 1) % outline.size()]) - origin);
  }
  return sum;
}

inline double total_area(const Scene& scene) {
  double sum = 0;
  for (const Patch& p : scene.patches()) {
    sum += p.area;
  }
  return sum;
}

}  // namespace transillum::test
