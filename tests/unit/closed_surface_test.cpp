// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_test_support.h"

namespace transillum::closed_surface_test {
namespace {

using Outlines = std::vector<std::vector<PointId>>;

const std::vector<Vec3> cube_points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},  {0, 0, 1},
                                    {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0, 0}};
const Outlines cube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                    {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

bool is_closed(const Outlines& faces, const SceneOptions& options = {}) {
  return is_closed_surface(Scene(test::polygons(cube_points, faces), options));
}

TEST(ClosedSurface, CubeIsClosed) {
  EXPECT_TRUE(is_closed(cube));
  Outlines inward = cube;
  for (auto& outline : inward) {
    std::reverse(outline.begin(), outline.end());
  }
  EXPECT_TRUE(is_closed(inward));
}

TEST(ClosedSurface, CubeWithoutAFaceIsOpen) {
  for (std::size_t missing = 0; missing < cube.size(); ++missing) {
    Outlines open = cube;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_FALSE(is_closed(open));
    // With two-sided faces the remaining faces form a closed shell.
    EXPECT_TRUE(is_closed(open, {.two_sided = true}));
  }
}

TEST(ClosedSurface, CubeWithAReversedFaceIsOpen) {
  for (std::size_t face = 0; face < cube.size(); ++face) {
    Outlines inconsistent = cube;
    std::reverse(inconsistent[face].begin(), inconsistent[face].end());
    EXPECT_FALSE(is_closed(inconsistent));
  }
}

TEST(ClosedSurface, TwoSidedSheetIsClosed) {
  EXPECT_FALSE(is_closed({{0, 1, 2, 3}}));
  EXPECT_TRUE(is_closed({{0, 1, 2, 3}}, {.two_sided = true}));
  EXPECT_TRUE(is_closed({{0, 1, 2, 3}, {3, 2, 1, 0}}));
  // A surface with the same side twice is not closed.
  EXPECT_FALSE(is_closed({{0, 1, 2, 3}, {0, 1, 2, 3}}));
}

TEST(ClosedSurface, ClosedSurfacesMayShareAnEdge) {
  // The cube, and a two-sided triangle on one of its edges.
  Outlines with_fin = cube;
  with_fin.push_back({0, 1, 6});
  with_fin.push_back({6, 1, 0});
  EXPECT_TRUE(is_closed(with_fin));
  with_fin.pop_back();
  EXPECT_FALSE(is_closed(with_fin));
}

TEST(ClosedSurface, SurfaceWithATJunctionIsOpen) {
  // The bottom and its neighbor share an edge that point 8 splits in one of them.
  Outlines split = cube;
  split[0] = {0, 3, 2, 1, 8};
  EXPECT_FALSE(is_closed(split));
  split[2] = {0, 8, 1, 5, 4};
  EXPECT_TRUE(is_closed(split));
}

TEST(ClosedSurface, OfBuiltIns) {
  EXPECT_TRUE(is_closed_surface(*load_scene("sphere-flake")));
  EXPECT_TRUE(is_closed_surface(*load_scene("sphere-flake:levels=0")));
  EXPECT_TRUE(is_closed_surface(*load_scene("boards", {.two_sided = true})));
  EXPECT_FALSE(is_closed_surface(*load_scene("stars")));
}

}  // namespace
}  // namespace transillum::closed_surface_test
