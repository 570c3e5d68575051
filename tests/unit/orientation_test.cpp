// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/orientation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene_test_support.h"
#include "support/canceled.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/form_factor_solve.h"
#include "transillum/solution.h"
#include "transillum/solve_session.h"

namespace transillum::orientation_test {
namespace {

using testing::Sketch;

void turn(SceneDescription& description, std::size_t face) {
  const auto first =
      description.corners.begin() + static_cast<std::ptrdiff_t>(description.face_begin[face]);
  std::reverse(first, first + std::ssize(description.outline(face)));
}

std::vector<std::size_t> faces_of(const std::vector<bool>& flags) {
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if (flags[f]) {
      faces.push_back(f);
    }
  }
  return faces;
}

/// A room of 4 m whose ceiling emits if it is lit: faces 0 to 5, of which face 5 is the ceiling.
Sketch room(bool lit = true) {
  Sketch sketch;
  const int wall = sketch.material(0.5, 0), lamp = sketch.material(0, lit ? 10 : 0);
  sketch.face({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, wall)
      .face({{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}}, wall)
      .face({{4, 0, 0}, {4, 0, 4}, {4, 4, 4}, {4, 4, 0}}, wall)
      .face({{4, 4, 0}, {4, 4, 4}, {0, 4, 4}, {0, 4, 0}}, wall)
      .face({{0, 4, 0}, {0, 4, 4}, {0, 0, 4}, {0, 0, 0}}, wall)
      .face({{0, 0, 4}, {0, 4, 4}, {4, 4, 4}, {4, 0, 4}}, lamp);
  return sketch;
}

TEST(OrientationPlan, TurnsWhatTurnedFacesOfARoomNeed) {
  // A cube lit by its ceiling, with all faces, one wall, or the lamp turned.
  for (const std::vector<std::size_t>& turned :
       {std::vector<std::size_t>{0, 1, 2, 3, 4, 5}, {2}, {5}, {0, 1, 2}, {}}) {
    SceneDescription description = room().description();
    for (const std::size_t f : turned) {
      turn(description, f);
    }
    const OrientationPlan plan = plan_orientation(description);
    EXPECT_EQ(faces_of(plan.turned), turned);
    EXPECT_THAT(faces_of(plan.two_sided), ::testing::IsEmpty());
    EXPECT_EQ(plan.report.components, 1);
    EXPECT_EQ(plan.report.components_turned, turned.empty() ? 0 : 1);
  }
}

TEST(OrientationPlan, KeepsALonelySurfaceThatDoesNotEmit) {
  Sketch outward;
  outward.box({0, 0, 0}, {1, 1, 1}, false, outward.material(0.5, 0));
  EXPECT_FALSE(plan_orientation(outward.description()).changes());
  SceneDescription one_turned = outward.description();
  turn(one_turned, 4);
  EXPECT_EQ(faces_of(plan_orientation(one_turned).turned), std::vector<std::size_t>{4});
}

TEST(OrientationPlan, TurnsSolidsOutward) {
  Sketch sketch = room();
  sketch.box({1, 1, 1}, {2, 2, 2}, true, 0);     // 6 to 11: wrong
  sketch.box({2.5, 1, 1}, {3, 2, 2}, false, 0);  // 12 to 17: right
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_EQ(faces_of(plan.turned), (std::vector<std::size_t>{6, 7, 8, 9, 10, 11}));
  ASSERT_EQ(plan.report.materials.size(), 1U);
  EXPECT_EQ(plan.report.materials[0].turned, 6);
  EXPECT_EQ(plan.report.materials[0].faces, 17);
}

TEST(OrientationPlan, MakesOpenSheetsTwoSidedUnlessTheyEmit) {
  Sketch sketch = room();
  const int lamp = sketch.material(0.5, 5);
  sketch.face({{1, 1, 2}, {3, 1, 2}, {3, 3, 2}, {1, 3, 2}}, 0);
  sketch.face({{1, 1, 3}, {3, 1, 3}, {3, 3, 3}, {1, 3, 3}}, lamp);
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_EQ(faces_of(plan.two_sided), std::vector<std::size_t>{6});
  EXPECT_THAT(faces_of(plan.turned), ::testing::IsEmpty());
  EXPECT_EQ(plan.report.components_two_sided, 1);
}

/// A lamp just below the ceiling lights the room, not the gap, however it was turned.
TEST(OrientationPlan, TurnsALampInFrontOfTheCeilingToTheRoom) {
  for (const bool up : {false, true}) {
    Sketch sketch = room(false);
    const int lamp = sketch.material(0.5, 5);
    std::vector<Vec3> outline{{1, 1, 3.99}, {1, 3, 3.99}, {3, 3, 3.99}, {3, 1, 3.99}};
    if (up) {
      std::reverse(outline.begin(), outline.end());
    }
    sketch.face(outline, lamp);
    const OrientationPlan plan = plan_orientation(sketch.description());
    EXPECT_EQ(faces_of(plan.turned), up ? std::vector<std::size_t>{6} : std::vector<std::size_t>{});
  }
}

/// A box without a bottom on the floor, whose edges the floor does not have.
TEST(OrientationPlan, LightsAnOpenBoxOnTheFloorOutside) {
  for (const bool inside_out : {false, true}) {
    Sketch box;
    box.box({1, 1, 0}, {2, 2, 1}, inside_out, box.material(0.5, 0));
    Sketch sketch = room();
    std::vector<std::size_t> expected;
    for (std::size_t f = 0; f < box.description().face_count(); ++f) {
      std::vector<Vec3> outline;
      for (const PointId p : box.description().outline(f)) {
        outline.push_back(at(box.description().points, p));
      }
      if (std::ranges::any_of(outline, [](const Vec3& p) { return p.z > 0; })) {
        if (inside_out) {
          expected.push_back(sketch.description().face_count());
        }
        sketch.face(outline, 0);
      }
    }
    const OrientationPlan plan = plan_orientation(sketch.description());
    EXPECT_EQ(faces_of(plan.turned), expected);
    EXPECT_THAT(faces_of(plan.two_sided), ::testing::IsEmpty());
  }
}

/// An object of several open parts without light, like most published models: light can only come
/// from outside, not from places where the parts see most of each other.
TEST(OrientationPlan, LightsAnUnlitObjectFromOutside) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  // A jar: a box without a top, and above it a lid that is a box without a bottom.
  sketch.face({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, gray)
      .face({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, gray)
      .face({{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}, gray)
      .face({{1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}}, gray)
      .face({{0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}}, gray)
      .face({{-.01, -.01, 1.02}, {1.01, -.01, 1.02}, {1.01, 1.01, 1.02}, {-.01, 1.01, 1.02}}, gray)
      .face({{-.01, -.01, .95}, {1.01, -.01, .95}, {1.01, -.01, 1.02}, {-.01, -.01, 1.02}}, gray);
  const std::vector<std::size_t> jar{0, 1, 2, 3, 4};
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_THAT(faces_of(plan.turned), ::testing::IsEmpty());
  // The lid is seen from inside too, where little light comes.
  EXPECT_THAT(faces_of(plan.two_sided), ::testing::Each(::testing::Ge(5U)));
  SceneDescription inside_out = sketch.description();
  for (const std::size_t f : jar) {
    turn(inside_out, f);
  }
  EXPECT_EQ(faces_of(plan_orientation(inside_out).turned), jar);
}

TEST(OrientationPlan, MakesAMoebiusStripTwoSidedAndSaysSo) {
  Sketch sketch = room();
  constexpr int n = 24;
  const auto rung = [](int k, double side) {
    const double turn = 2 * std::numbers::pi * (k % n) / n, half = turn / 2;
    // After one turn the rung is upside down.
    const double s = k < n ? side : -side;
    const double r = 1 + 0.3 * s * std::cos(half);
    return Vec3{2 + r * std::cos(turn), 2 + r * std::sin(turn), 2 + 0.3 * s * std::sin(half)};
  };
  for (int k = 0; k < n; ++k) {
    sketch.face({rung(k, -1), rung(k, 1), rung(k + 1, 1)}, 0);
    sketch.face({rung(k, -1), rung(k + 1, 1), rung(k + 1, -1)}, 0);
  }
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_EQ(plan.report.not_orientable, 1);
  EXPECT_EQ(plan.report.faces_two_sided, 2 * n);
  EXPECT_THAT(plan.report.sentences, ::testing::Contains(::testing::HasSubstr("Moebius")));
}

TEST(OrientationPlan, KeepsSurfacesThatHaveBothSidesAndTurnsDuplicatesTogether) {
  Sketch sketch = room();
  const std::vector<Vec3> sheet{{1, 1, 2}, {3, 1, 2}, {3, 3, 2}, {1, 3, 2}};
  sketch.face(sheet, 0).face({sheet.rbegin(), sheet.rend()}, 0);
  EXPECT_FALSE(plan_orientation(sketch.description()).changes());

  SceneDescription description = room().description();
  const std::vector<PointId> wall(description.outline(3).begin(), description.outline(3).end());
  description.add_face(wall, 0);
  turn(description, 3);
  turn(description, 6);
  EXPECT_EQ(faces_of(plan_orientation(description).turned), (std::vector<std::size_t>{3, 6}));
}

/// Three boxes that share an edge, and one face with an edge that three others share.
TEST(OrientationPlan, HandlesEdgesOfManyFaces) {
  Sketch sketch = room();
  sketch.box({1, 1, 1}, {2, 2, 2}, false, 0);
  sketch.box({2, 2, 1}, {3, 3, 2}, true, 0);
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_EQ(faces_of(plan.turned), (std::vector<std::size_t>{12, 13, 14, 15, 16, 17}));
  EXPECT_EQ(plan.report.components, 3);
}

TEST(OrientationPlan, IsAppliedOnceAndCanBeAppliedAgain) {
  Sketch sketch = room();
  sketch.box({1, 1, 1}, {2, 2, 2}, true, 0);
  sketch.face({{1, 1, 3}, {3, 1, 3}, {3, 3, 3}, {1, 3, 3}}, 0);
  SceneDescription description = sketch.description();
  const OrientationReport report = orient(description);
  EXPECT_EQ(report.faces_turned, 6);
  EXPECT_EQ(report.faces_two_sided, 1);
  EXPECT_TRUE(description.is_two_sided(12));
  EXPECT_EQ(Scene(description).patch_count(), 14);
  EXPECT_FALSE(plan_orientation(description).changes());
}

TEST(OrientationPlan, IsCanceled) {
  EXPECT_THROW(plan_orientation(room().description(), 0, testing::canceled()), Canceled);
  EXPECT_THROW(back_fraction(*room().scene(), 0, testing::canceled()), Canceled);
}

TEST(TwoSidedFaces, GiveTwoPatchesEach) {
  SceneDescription description = test::polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                                {{0, 1, 2, 3}, {0, 1, 2}, {0, 2, 3}});
  description.face_two_sided = {0, 1, 0};
  const Scene scene(description);
  ASSERT_EQ(scene.patch_count(), 4);
  EXPECT_EQ(scene.patch(1).face, 1);
  EXPECT_EQ(scene.patch(2).face, 1);
  EXPECT_EQ(scene.patch(2).normal, -scene.patch(1).normal);
  EXPECT_EQ(scene.patch(3).face, 2);
  description.add_face(std::vector<PointId>{0, 1, 3}, 0);
  EXPECT_EQ(description.face_two_sided.size(), 4U);
  description.face_two_sided.pop_back();
  EXPECT_THROW(Scene{description}, InputError);
}

TEST(BackFraction, IsZeroWhereOnlyFrontsAreSeen) {
  for (const char* spec : {"furnace", "cornell-box", "rooms", "boards"}) {
    const BackFraction fraction = back_fraction(*load_scene(spec));
    EXPECT_EQ(fraction.fraction, 0) << spec;
    EXPECT_EQ(fraction.open, 0) << spec;
    EXPECT_THAT(fraction.materials, ::testing::IsEmpty()) << spec;
  }
}

/// In a sphere every point sees equal areas alike, so light meets backs in proportion to their
/// area.
TEST(BackFraction, IsTheFractionOfTheAreaInASphere) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1), red = sketch.material(0.3, 1);
  constexpr int n = 24;
  const auto point = [](int i, int j) {
    const double t = std::numbers::pi * i / n, p = std::numbers::pi * (j % (2 * n)) / n;
    return Vec3{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      // The faces point inward, every fifth points outward.
      std::vector<Vec3> outline{point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)};
      if ((i + j) % 5 == 0) {
        std::reverse(outline.begin(), outline.end());
      }
      sketch.face(outline, (i + j) % 5 == 0 ? red : gray);
    }
  }
  const auto scene = sketch.scene();
  double turned = 0, all = 0;
  for (const Patch& patch : scene->patches()) {
    turned += patch.material == red ? patch.area : 0;
    all += patch.area;
  }
  const BackFraction fraction = back_fraction(*scene);
  EXPECT_NEAR(fraction.fraction, turned / all, 0.01);
  EXPECT_NEAR(fraction.open, turned / all, 0.01);
  ASSERT_EQ(fraction.materials.size(), 1U);
  EXPECT_EQ(fraction.materials[0].fraction, 1);
  EXPECT_EQ(fraction.materials[0].of_all, fraction.fraction);
}

/// Boxes that interpenetrate see backs inside each other, where no light is.
TEST(BackFraction, IsZeroWhereOnlyDarkPlacesSeeBacks) {
  Sketch sketch = room();
  sketch.box({1, 1, 1}, {2, 2, 2}, false, 0).box({1.2, 1.2, 0.5}, {1.8, 1.8, 2.5}, false, 0);
  EXPECT_LT(back_fraction(*sketch.scene()).fraction, 1e-4);
}

TEST(BackFraction, IsOneWhereTheOnlyLampIsTurnedAway) {
  SceneDescription description = room().description();
  turn(description, 5);
  EXPECT_EQ(back_fraction(Scene(description)).fraction, 1);
}

/// Turned solids are lit inside, which no light reaches.
TEST(BackFraction, IsOneWhereEverythingIsTurned) {
  for (const char* spec : {"cornell-box", "stars", "boards"}) {
    SceneDescription description = describe_scene(spec);
    for (std::size_t f = 0; f < description.face_count(); ++f) {
      turn(description, f);
    }
    EXPECT_GT(back_fraction(Scene(description)).fraction, 0.9) << spec;
  }
}

TEST(BackFraction, IsOneInARoomInsideOut) {
  SceneDescription description = room().description();
  for (std::size_t f = 0; f < 6; ++f) {
    turn(description, f);
  }
  EXPECT_EQ(back_fraction(Scene(description)).fraction, 1);
  EXPECT_EQ(back_fraction(Scene(description)).open, 1);
}

/// Nothing tells that it is meant to be seen from inside; a sky lights it.
TEST(BackFraction, IsZeroOfASolidWithoutLight) {
  Sketch sketch;
  sketch.box({0, 0, 0}, {1, 1, 1}, false, sketch.material(0.5, 0));
  EXPECT_EQ(back_fraction(*sketch.scene()).fraction, 0);
  EXPECT_EQ(back_fraction(*sketch.scene()).open, 1);
}

TEST(BackFraction, OfASealedRoomWithTwoSidedFacesIsZeroAndItIsClosed) {
  const auto scene = room().scene({.two_sided = true});
  EXPECT_EQ(back_fraction(*scene).fraction, 0);
  EXPECT_EQ(back_fraction(*scene).open, 0);
  EXPECT_EQ(back_fraction(*load_scene("cornell-box", {.two_sided = true})).open, 0);
  EXPECT_GT(back_fraction(*load_scene("cornell-box:open=1", {.two_sided = true})).open, 0.1);
}

/// The outer sides of a sealed room do not count as open, for passes and hemicubes alike.
TEST(TwoSidedFaces, OfASealedRoomLetNothingEscape) {
  const auto escaped = [](const std::string& spec, bool passes) {
    const auto scene = load_scene(spec, {.two_sided = true});
    const Solution solution =
        passes ? solve(scene, {.directions = 16, .iterations = 2})
               : solve_by_form_factors(scene, {.engine = Engine::hemicube, .iterations = 2});
    return solution.statistics.escaped;
  };
  for (const bool passes : {true, false}) {
    EXPECT_LT(escaped("cornell-box", passes), 1e-9);
    EXPECT_GT(escaped("cornell-box:open=1", passes), 0.05);
  }
}

TEST(BackFraction, DoesNotDependOnThreads) {
  SceneDescription description = describe_scene("rooms");
  for (std::size_t f = 0; f < description.face_count(); f += 5) {
    turn(description, f);
  }
  const Scene scene(description);
  const BackFraction one = back_fraction(scene, 1), many = back_fraction(scene, 4);
  EXPECT_GT(one.fraction, 0.05);
  EXPECT_EQ(one.fraction, many.fraction);
  EXPECT_EQ(one.open, many.open);
}

}  // namespace
}  // namespace transillum::orientation_test
