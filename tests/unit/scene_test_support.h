// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Small scene descriptions and measurements of scenes for the scene tests.

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "radiosity/norms.h"
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

/// Describes a scene in a file of this name and content.
inline SceneDescription read_scene(const std::string& name, const std::string& content,
                                   const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return describe_scene(folder.write(name, content), options);
}
/// The message that refuses such a file, from its name on.
inline std::string scene_refusal(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  const std::string path = folder.write(name, content);
  const std::string message = refusal([&] { (void)describe_scene(path); });
  const std::size_t found = message.find(name);
  return found == std::string::npos ? message : message.substr(found);
}

/// Corners and outward faces of the unit cube.
inline const std::vector<Vec3> cube_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
inline const std::vector<std::vector<int>> cube_squares{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                        {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};

inline void expect_cube(const SceneDescription& description) {
  const Scene scene(description);
  ASSERT_EQ(scene.patch_count(), 6);
  for (PatchId i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(scene.patch(i).area, 1);
    EXPECT_GT(dot(scene.patch(i).normal, scene.patch(i).center - Vec3{0.5, 0.5, 0.5}), 0);
  }
  EXPECT_EQ(scene.points().size(), 8U);
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

}  // namespace transillum::test
