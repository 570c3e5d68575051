// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/orientation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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

/// Two halves of a long room without a lamp, each open toward the other, with a gap between, and
/// boxes inside: an interior as modeled, of which light can come from anywhere.
Sketch interior() {
  Sketch sketch;
  const int wall = sketch.material(0.5, 0);
  for (const double x : {0.0, 10.02}) {
    const double z = x + 10, end = x == 0.0 ? x : z;
    const std::vector<std::vector<Vec3>> walls{
        {{x, 0, 0}, {z, 0, 0}, {z, 4, 0}, {x, 4, 0}},
        {{x, 0, 0}, {x, 0, 3}, {z, 0, 3}, {z, 0, 0}},
        {{x, 4, 0}, {z, 4, 0}, {z, 4, 3}, {x, 4, 3}},
        {{x, 0, 3}, {x, 4, 3}, {z, 4, 3}, {z, 0, 3}},
        {{end, 0, 0}, {end, 4, 0}, {end, 4, 3}, {end, 0, 3}}};
    for (std::vector<Vec3> outline : walls) {
      if (outline[0].x == end && outline[2].x == end && x > 0) {
        std::reverse(outline.begin(), outline.end());
      }
      sketch.face(outline, wall);
    }
  }
  sketch.box({2, 1, 0.5}, {3, 2, 1.5}, false, wall).box({14, 1, 0.5}, {15, 3, 1}, false, wall);
  return sketch;
}

double backs_of(const SceneDescription& description) {
  return back_fraction(Scene(description)).fraction;
}

TEST(OrientationPlan, KeepsAnInteriorWithoutALamp) {
  SceneDescription description = interior().description();
  EXPECT_LT(backs_of(description), 1e-3);
  EXPECT_FALSE(plan_orientation(description).changes());
  // Furniture that is inside out is turned alone.
  for (std::size_t f = 10; f < 16; ++f) {
    turn(description, f);
  }
  EXPECT_GT(backs_of(description), 0.01);
  EXPECT_EQ(faces_of(plan_orientation(description).turned),
            (std::vector<std::size_t>{10, 11, 12, 13, 14, 15}));
}

/// Two tunnels that see each other through their open ends, without anything inside.
TEST(OrientationPlan, NeverShowsMoreBacksThanTheFile) {
  const SceneDescription whole = interior().description();
  Sketch tunnels;
  const int wall = tunnels.material(0.5, 0);
  for (std::size_t f = 0; f < 10; ++f) {
    std::vector<Vec3> outline;
    for (const PointId p : whole.outline(f)) {
      outline.push_back(at(whole.points, p));
    }
    tunnels.face(outline, wall);
  }
  // A ramp from one into the other, seen from below too.
  tunnels.face({{9, 1, 1}, {11, 1, 1.5}, {11, 3, 1.5}, {9, 3, 1}}, wall);
  SceneDescription description = tunnels.description();
  const double before = backs_of(description);
  const OrientationReport report = orient(description);
  EXPECT_LE(backs_of(description), before + 0.01);
  EXPECT_THAT(
      report.sentences,
      ::testing::Contains(::testing::HasSubstr("left mostly as in the file, since more of")));
}

/// Without light, closed components are solids, also where they overlap and see more backs.
TEST(OrientationPlan, TurnsOverlappingSolidsInsideOutWithoutALamp) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.box({0, 0, 0}, {1, 1, 1}, true, gray).box({0.8, 0.7, 0.6}, {2, 2, 2}, true, gray);
  sketch.box({0.4, 0.4, 0.9}, {0.6, 0.6, 1.5}, true, gray);
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_EQ(plan.report.faces_turned, 18);
  EXPECT_EQ(plan.report.faces_two_sided, 0);
}

/// A cube of small squares, in which one square is replaced by a twisted band.
TEST(OrientationPlan, KeepsAScanThatCannotBeOriented) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  constexpr int n = 4;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      for (int k = 0; k < n * n; ++k) {
        const double u = k % n, v = k / n;  // NOLINT(bugprone-integer-division)
        const auto corner = [&](double a, double b) {
          const double p = a / n, q = b / n;
          return axis == 0 ? Vec3{side, p, q} : axis == 1 ? Vec3{q, side, p} : Vec3{p, q, side};
        };
        std::vector<Vec3> square{corner(u, v), corner(u + 1, v), corner(u + 1, v + 1),
                                 corner(u, v + 1)};
        if (side == 0) {
          std::reverse(square.begin(), square.end());
        }
        if (axis == 2 && side == 1 && k == 5) {
          const Vec3 middle = 0.5 * (square[0] + square[2]) + Vec3{0, 0, 0.05};
          for (const auto& [i, j] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}}) {
            sketch.face({at(square, i), at(square, j), middle}, gray);
          }
        } else {
          sketch.face(square, gray);
        }
      }
    }
  }
  const OrientationPlan plan = plan_orientation(sketch.description());
  EXPECT_EQ(plan.report.not_orientable, 1);
  EXPECT_FALSE(plan.changes());
  // Alone, nothing tells that it is inside out, as where it can be oriented.
  SceneDescription inside_out = sketch.description();
  for (std::size_t f = 0; f < inside_out.face_count(); ++f) {
    turn(inside_out, f);
  }
  EXPECT_FALSE(plan_orientation(inside_out).changes());
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
