// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// SceneOptions::max_patch_area: cells of triangles, rectangles and concave faces, shared points
// along edges, and limits.
#include <gtest/gtest.h>

#include <set>

#include "scene_test_support.h"

namespace transillum::scene_refinement_test {
namespace {

Scene refined(const SceneDescription& d, double max_area, bool two_sided = false) {
  return Scene(d, {.two_sided = two_sided, .max_patch_area = max_area});
}

TEST(Refinement, DividesARectangleIntoEqualNearlySquareCells) {
  const Scene scene = refined(test::polygon({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}}), 0.25);
  EXPECT_EQ(scene.patch_count(), 16);
  EXPECT_EQ(scene.report().refined, 1);
  for (const Patch& p : scene.patches()) {
    EXPECT_NEAR(p.area, 0.25, 1e-15);
    EXPECT_EQ(p.face, 0);
  }
  EXPECT_EQ(scene.points().size(), 9u * 3);
}

TEST(Refinement, DividesATriangleIntoSimilarOnes) {
  const Scene scene = refined(test::polygon({{0, 0, 0}, {3, 0, 0}, {0, 3, 3}}), 1);
  EXPECT_EQ(scene.patch_count(), 9);
  for (const Patch& p : scene.patches()) {
    EXPECT_NEAR(p.area, scene.patch(0).area, 1e-14);
  }
  EXPECT_EQ(scene.points().size(), 10u);
}

TEST(Refinement, KeepsTotalAreaAndLimitForEveryBuiltIn) {
  for (const BuiltInScene& b : built_in_scenes()) {
    SCOPED_TRACE(b.name);
    const SceneDescription d = describe_scene(b.name);
    const Scene whole(d);
    const double bound = 0.1 * whole.bounds().diagonal() * whole.bounds().diagonal() / 100;
    const Scene fine = refined(d, bound);
    EXPECT_GT(fine.patch_count(), whole.patch_count());
    EXPECT_NEAR(total_area(fine), total_area(whole), 1e-11 * total_area(whole));
    std::int32_t face = 0;
    for (const Patch& p : fine.patches()) {
      EXPECT_LE(p.area, bound * (1 + 1e-8));
      EXPECT_GE(p.face, face) << "the order of faces is kept";
      face = p.face;
    }
  }
}

TEST(Refinement, SharesPointsAlongCommonEdges) {
  // Two rectangles with a common edge of non-dyadic coordinates, in opposite directions.
  const Vec3 a{0.1, 0.2, 0.3}, b{1.3, 0.7, 0.3}, up{0, 0, 1.7}, side{0.5, -1.2, 0};
  const Scene scene = refined(
      test::polygons({a, b, b + up, a + up, b + side, a + side}, {{0, 1, 2, 3}, {1, 0, 5, 4}}),
      0.05);
  std::set<PointId> first, second;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    auto& points = scene.patch(i).face == 0 ? first : second;
    for (const PointId p : scene.outline(i)) {
      points.insert(p);
    }
  }
  std::size_t shared = 0;
  for (const PointId p : first) {
    shared += second.count(p);
  }
  EXPECT_GE(shared, 4u);
  // No two different points are close to each other.
  for (std::size_t i = 0; i < scene.points().size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(norm(scene.points()[i] - scene.points()[j]), 1e-6);
    }
  }
}

TEST(Refinement, PrecedesTheDoublingOfTwoSidedFaces) {
  const Scene scene =
      refined(test::polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 0.25, true);
  ASSERT_EQ(scene.patch_count(), 8);
  for (PatchId i = 0; i < 8; i += 2) {
    EXPECT_EQ(scene.patch(i).center, scene.patch(i + 1).center);
    EXPECT_EQ(scene.patch(i).normal, -scene.patch(i + 1).normal);
  }
}

TEST(Refinement, DividesConcaveFaces) {
  const Scene scene = refined(
      test::polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}), 0.1);
  EXPECT_NEAR(total_area(scene), 3, 1e-13);
  EXPECT_GE(scene.patch_count(), 30);
}

TEST(Refinement, RefusesTooManyPatches) {
  const SceneDescription d = test::polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_NE(test::refusal([&] { refined(d, 1e-9); }).find("more than 50000000 patches"),
            std::string::npos);
  EXPECT_NE(test::refusal([&] { refined(d, 1e-300); }).find("more than 50000000 patches"),
            std::string::npos);
  EXPECT_NE(test::refusal([&] { refined(d, -1); }).find("maximum patch area is -1"),
            std::string::npos);
}

}  // namespace
}  // namespace transillum::scene_refinement_test
