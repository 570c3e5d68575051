// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// From faces to patches: welding, areas, convex pieces, non-planar and degenerate faces, two-sided
// faces, warnings and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "geometry/convex_partition.h"
#include "scene_test_support.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"

namespace transillum::scene_patches_test {
namespace {

using test::polygon;
using test::polygons;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

/// Each piece is convex and oriented as its patch, and the areas of the pieces add up to the
/// patch's.
void expect_sound_pieces(const Scene& scene) {
  std::vector<double> area(static_cast<std::size_t>(scene.patch_count()));
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    const Patch& patch = scene.patch(piece.patch);
    const double doubled = dot(patch.normal, test::doubled_area(scene, corners));
    EXPECT_GT(doubled, 0);
    at(area, piece.patch) += 0.5 * doubled;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 a = scene.point(corners[i]);
      const Vec3 b = scene.point(corners[(i + 1) % corners.size()]);
      const Vec3 c = scene.point(corners[(i + 2) % corners.size()]);
      EXPECT_GE(dot(patch.normal, cross(b - a, c - b)), -1e-12);
    }
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    EXPECT_NEAR(at(area, i), scene.patch(i).area, 1e-9 * scene.patch(i).area);
  }
}

TEST(ScenePatches, HaveNormalAreaAndCenter) {
  const Scene scene(polygon({{0, 0, 2}, {4, 0, 2}, {4, 2, 2}, {0, 2, 2}}));
  ASSERT_EQ(scene.patch_count(), 1);
  EXPECT_EQ(scene.patch(0).normal, (Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(scene.patch(0).area, 8);
  EXPECT_EQ(scene.patch(0).center, (Vec3{2, 1, 2}));
  EXPECT_THAT(scene.pieces(), SizeIs(1));
  EXPECT_EQ(scene.bounds().high, (Vec3{4, 2, 2}));
}

TEST(ScenePatches, OfConcavePolygonsHaveTheCenterOfTheArea) {
  // An L of three unit squares.
  const Scene scene(polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}));
  EXPECT_DOUBLE_EQ(scene.patch(0).area, 3);
  EXPECT_NEAR(scene.patch(0).center.x, 5.0 / 6, 1e-15);
  EXPECT_NEAR(scene.patch(0).center.y, 5.0 / 6, 1e-15);
  EXPECT_THAT(scene.pieces(), SizeIs(2));
  expect_sound_pieces(scene);
}

TEST(ScenePatches, WeldEqualPointsWithMinusZeroAsZero) {
  const Scene scene(
      polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {1, 0, 0}, {0, -1, 0}},
               {{0, 1, 2}, {4, 3, 5}}));
  EXPECT_THAT(scene.points(), SizeIs(4));
  for (const Vec3& p : scene.points()) {
    EXPECT_FALSE(std::signbit(p.x) && p.x == 0);
    EXPECT_FALSE(std::signbit(p.z) && p.z == 0);
  }
}

TEST(ScenePatches, RemoveRepeatedCornersAndKeepStraightOnes) {
  const Scene scene(
      polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}}));
  EXPECT_THAT(scene.outline(0), SizeIs(5));
  EXPECT_THAT(scene.pieces(), SizeIs(1));
}

TEST(ScenePatches, RemoveFacesWithoutAreaAndCountThem) {
  const Scene scene(polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 0, 1e-17}},
                             {{0, 1, 3}, {0, 1, 2}, {0, 0, 1}, {0, 3, 4}, {}}));
  EXPECT_EQ(scene.patch_count(), 1);
  EXPECT_EQ(scene.patch(0).face, 1);
  EXPECT_EQ(scene.report().removed_degenerate, 4);
}

TEST(ScenePatches, KeepThinFacesThatHaveArea) {
  const Scene scene(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1e-12, 0}}));
  EXPECT_NEAR(scene.patch(0).area, 5e-13, 1e-25);
}

std::vector<Vec3> bent_square(double off) { return {{0, 0, 0}, {1, 0, 0}, {1, 1, off}, {0, 1, 0}}; }

// The area is the small difference of large products; such quadrilaterals were once refused as
// crossing themselves.
TEST(ScenePatches, KeepQuadrilateralsOfRelativeWidth1eMinus7) {
  const Scene scene(polygon({{-0.93879856506340864, 0.27196618361825475, 0.041234870875667406},
                             {0.78580605615928334, -0.088742516725631299, -0.90514144642816285},
                             {0.78580602476888761, -0.088742447006912112, -0.90514153020474153},
                             {-0.93879859645380437, 0.27196625333697394, 0.041234787099088704}}));
  EXPECT_NEAR(total_area(scene), 2.26844e-7, 1e-11);
}

TEST(ScenePatches, BentQuadrilateralsAreSplitDependingOnTheirDeviation) {
  const Scene flat(polygon(bent_square(1e-16)));
  EXPECT_EQ(flat.patch_count(), 1);
  EXPECT_THAT(flat.pieces(), SizeIs(1));
  const Scene nearly(polygon(bent_square(1e-9)));
  EXPECT_EQ(nearly.patch_count(), 1);
  EXPECT_THAT(nearly.outline(0), SizeIs(4));
  EXPECT_THAT(nearly.pieces(), SizeIs(1));
  EXPECT_EQ(nearly.report().cut_non_planar, 0);
  const Scene bent(polygon(bent_square(1e-3)));
  EXPECT_EQ(bent.patch_count(), 2);
  EXPECT_EQ(bent.patch(0).face, 0);
  EXPECT_EQ(bent.patch(1).face, 0);
  EXPECT_EQ(bent.report().cut_non_planar, 1);
  EXPECT_THAT(bent.report().warnings, Contains(HasSubstr("test: face 0: not planar")));
}

/// For a face 1000 km long and 1 m wide, a deviation of 1 m is not rounding.
TEST(ScenePatches, PlanarityOfLongFacesDependsOnTheirWidth) {
  const Scene scene(polygon({{1e6, 1e6, 1e6},
                             {1e6 + 0.7, 1e6 + 0.1, 0.1},
                             {1e6 + 0.6, 1e6 + 0.9, 1e6 + 0.4},
                             {1e6 - 0.1, 1e6 + 0.8, 1e6 + 0.1}}));
  EXPECT_EQ(scene.report().cut_non_planar, 1);
  EXPECT_EQ(scene.patch_count(), 2);
}

/// The rounding of their coordinates is large relative to their size.
TEST(ScenePatches, SmallFacesFarFromTheOriginAreNotSplit) {
  const Scene scene(polygon({{1e6, 1e6, 1e6},
                             {1e6 + 1e-3, 1e6, 1e6 + 1e-3},
                             {1e6 + 1e-3, 1e6 + 1e-3, 1e6 + 1.3e-3},
                             {1e6, 1e6 + 1e-3, 1e6 + 0.3e-3}}));
  EXPECT_EQ(scene.report().cut_non_planar, 0);
  EXPECT_EQ(scene.patch_count(), 1);
}

TEST(ScenePatches, QuadrilateralsWhoseProjectionCrossesItselfAreTwoTriangles) {
  // Folded by more than a right angle.
  const Scene scene(polygon({{0, 0, 0}, {2, 0, 0}, {0.2, 0.1, 2}, {0, 2, 0}}));
  EXPECT_EQ(scene.patch_count(), 2);
}

TEST(ScenePatches, AcceptOutlinesThatTouchThemselvesAtABridge) {
  // A square with a square hole, connected by a bridge that the outline passes twice.
  const Scene scene(polygons(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}},
      {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}));
  ASSERT_EQ(scene.patch_count(), 1);
  EXPECT_DOUBLE_EQ(scene.patch(0).area, 8);
  expect_sound_pieces(scene);
}

TEST(ScenePatches, SplitOutlinesWithLoopsOfOppositeOrientation) {
  // An 8 whose loops meet at a corner; of different sizes, so the total area is not 0.
  const std::vector<Vec3> points{{0, 0, 0}, {2, 2, 0}, {2, -2, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const Scene scene(polygons(points, {{0, 2, 1, 0, 3, 4}}));
  EXPECT_EQ(scene.patch_count(), 1) << "these loops have the same orientation";
  EXPECT_THAT(scene.report().warnings, ::testing::IsEmpty());
  const Scene eight(polygons(points, {{0, 2, 1, 0, 4, 3}}));
  EXPECT_DOUBLE_EQ(total_area(eight), 5);
  EXPECT_THAT(eight.report().warnings,
              ElementsAre("test: face 0: the outline crosses itself; split into triangles"));
}

/// A face that crosses itself is split where it does; all parts have the face's number and front.
TEST(ScenePatches, SplitOutlinesThatCrossThemselves) {
  struct Case {
    std::vector<Vec3> points;
    double area;
    Vec3 normal;
  };
  const Case cases[] = {
      // Bow ties without and with signed area, a pentagram by the even-odd rule, a bent bow tie.
      {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}}, 2, {0, 0, 1}},
      {{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, -1, 0}}, 2.5, {0, 0, 1}},
      {{{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}}, 0, {0, 0, 1}},
      {{{0, 0, 0.3}, {3, 0, 0}, {3, 2, 0}, {2, 3, 0}, {0, -1, 0.1}}, 0, {0, 0, 1}},
  };
  for (const Case& c : cases) {
    std::vector<PointId> outline(c.points.size());
    std::iota(outline.begin(), outline.end(), 0);
    std::vector<Vec3> points = c.points;
    points.insert(points.end(), {{9, 0, 0}, {9, 1, 0}, {8, 0, 0}});
    const auto first = static_cast<PointId>(c.points.size());
    const Scene scene(polygons(points, {{first, first + 1, first + 2}, outline}));
    EXPECT_THAT(scene.report().warnings,
                ElementsAre("test: face 1: the outline crosses itself; split into triangles"));
    ASSERT_GT(scene.patch_count(), 2);
    for (PatchId i = 1; i < scene.patch_count(); ++i) {
      EXPECT_EQ(scene.patch(i).face, 1);
      EXPECT_GT(dot(scene.patch(i).normal, c.normal), 0.9);
    }
    if (c.area > 0) {
      EXPECT_NEAR(total_area(scene) - scene.patch(0).area, c.area, 1e-12);
    }
    expect_sound_pieces(scene);
  }
}

/// The first edge and the fourth cross, but are collinear to doubles: where they cross was 0/0.
TEST(ScenePatches, SplitOutlinesWhoseEdgesCrossNearlyCollinearly) {
  testing::Sketch sketch;
  sketch.face({{0.07530366532695643, 0.02200122767307447, 0},
               {0.26617294780469836, 0.0777668869056792, 0},
               {0.9, 0.1629468752273268, 0},
               {0.7967380704360125, 0.2327803780514496, 0},
               {0.08929741293276827, 0.026089735526420566, 0},
               {0.08444241688684884, 0.9, 0}},
              sketch.material(0.5, 0));
  sketch.face({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0);
  const auto scene = sketch.scene();
  for (const Vec3& p : scene->points()) {
    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  EXPECT_GT(scene->patch_count(), 0);
}

/// A star with 19,700 crossings is not split; the message says why.
TEST(ScenePatches, RemoveOutlinesThatCrossThemselvesTooOften) {
  testing::Sketch sketch;
  std::vector<Vec3> star;
  for (int k = 0; k < 201; ++k) {
    const double angle = 2 * std::numbers::pi * 99 * k / 201;
    star.push_back({std::cos(angle), std::sin(angle), 0});
  }
  sketch.face(star, sketch.material(0.5, 0));
  EXPECT_THAT(
      test::refusal([&] { sketch.scene(); }),
      HasSubstr("the outline crosses itself and cannot be split; the scene has no patches"));
  sketch.face({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0);
  const auto scene = sketch.scene();
  EXPECT_EQ(scene->patch_count(), 1);
  EXPECT_EQ(scene->report().removed_degenerate, 1);
}

TEST(ScenePatches, CountOutlinesThatCrossThemselves) {
  SceneDescription d = polygons({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}}, {});
  d.materials = {{"white", {0.5, 0.5, 0.5}, {}}};
  for (int k = 0; k < 13; ++k) {
    const auto first = static_cast<PointId>(d.points.size());
    const double z = k;
    d.points.insert(d.points.end(), {{0, 0, z}, {2, 0, z}, {0, 2, z}, {2, 2, z}});
    d.add_face(std::vector<PointId>{first, first + 1, first + 2, first + 3}, 0);
  }
  EXPECT_THAT(Scene(d).report().warnings,
              Contains("and 3 more faces whose outlines cross themselves"));
}

TEST(ScenePatches, InEveryOrientationHavePiecesOfTheSameOrientation) {
  const std::vector<Vec3> star{{0, 2, 0},  {-.5, .5, 0}, {-2, 0, 0}, {-.5, -.5, 0},
                               {0, -2, 0}, {.5, -.5, 0}, {2, 0, 0},  {.5, .5, 0}};
  for (int turn = 0; turn < 6; ++turn) {
    std::vector<Vec3> turned;
    for (const Vec3& p : star) {
      const Vec3 q = turn % 3 == 0 ? p : turn % 3 == 1 ? Vec3{p.y, p.z, p.x} : Vec3{p.z, p.x, p.y};
      turned.push_back(turn < 3 ? q : -q);
    }
    if (turn >= 3) {
      std::reverse(turned.begin(), turned.end());
    }
    const Scene scene(polygon(turned));
    EXPECT_GE(scene.pieces().size(), 3u);
    EXPECT_LE(scene.pieces().size(), 5u);
    expect_sound_pieces(scene);
  }
}

TEST(ScenePatches, CountCoincidentFacesAndUnusedPoints) {
  const Scene scene(polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {5, 5, 5}},
                             {{0, 1, 2}, {2, 1, 3}, {1, 2, 0}}));
  EXPECT_EQ(scene.report().coincident_faces, 2);
  EXPECT_EQ(scene.report().unused_points, 1);
  EXPECT_THAT(scene.report().warnings, Contains(HasSubstr("face 2: same points as face 0")));
  // Face 1 is the other side of face 0: two-sided faces are saved so.
  EXPECT_THAT(scene.report().warnings, Not(Contains(HasSubstr("face 1: same points"))));
  EXPECT_THAT(scene.report().warnings, Contains(HasSubstr("1 of 5 vertices are not used")));
  EXPECT_THAT(scene.points(), SizeIs(3));
}

TEST(ScenePatches, WarnOnlyAboutTheFirstFewOfAKind) {
  SceneDescription d = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  for (int i = 0; i < 1000; ++i) {
    d.add_face(std::vector<PointId>{0, 1, 1}, 0);
  }
  const Scene scene(d);
  EXPECT_EQ(scene.report().removed_degenerate, 1000);
  EXPECT_THAT(scene.report().warnings, SizeIs(11));
  EXPECT_EQ(scene.report().warnings.back(), "and 990 more faces without area, removed");
}

TEST(ScenePatches, TwoSidedFacesGiveOppositePairsFrontFirst) {
  const Scene scene(polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}),
                    {.two_sided = true});
  ASSERT_EQ(scene.patch_count(), 2);
  EXPECT_EQ(scene.patch(0).normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(scene.patch(1).normal, (Vec3{-0.0, -0.0, -1}));
  EXPECT_EQ(scene.patch(1).face, 0);
  EXPECT_THAT(scene.outline(1), ElementsAre(5, 4, 3, 2, 1, 0));
  EXPECT_THAT(scene.pieces(), SizeIs(4));
  expect_sound_pieces(scene);
}

TEST(ScenePatches, RefuseInvalidDescriptions) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SceneDescription d = polygon({{0, 0, 0}, {1, 0, nan}, {0, 1, 0}});
  EXPECT_EQ(test::refusal([&] { Scene{d}; }),
            "test: vertex 1: a coordinate is not a finite number");
  d = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  d.corners[1] = 3;
  EXPECT_EQ(test::refusal([&] { Scene{d}; }),
            "test: face 0: vertex index 3 is out of range; there are 3 vertices");
  d.corners[1] = -1;
  EXPECT_THAT(test::refusal([&] { Scene{d}; }), HasSubstr("vertex index -1"));
  d = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  d.face_material[0] = 1;
  EXPECT_THAT(test::refusal([&] { Scene{d}; }), HasSubstr("material 1 is out of range"));
  d.face_material[0] = 0;
  d.materials[0].reflectance.g = 1;
  EXPECT_THAT(test::refusal([&] { Scene{d}; }),
              HasSubstr("green reflectance rho (Kd) is 1, but must be >= 0 and < 1"));
}

}  // namespace
}  // namespace transillum::scene_patches_test
