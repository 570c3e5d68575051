// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ALGORITHM.md 6.13: jumps across edges by hand, and refinement in rounds against even division.
#include "transillum/refinement.h"
#include "transillum/solve_session.h"

#include <gmock/gmock.h>

#include <cmath>

#include "radiosity/analysis/function_comparison.h"
#include "scene/build/division.h"
#include "scene/build/patch_count.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum::refinement_test {
namespace {

using ::testing::Each;
using ::testing::SizeIs;
using testing::Sketch;

/// A result with the given irradiances, all gray.
Solution with_irradiance(const std::shared_ptr<const Scene>& scene,
                         const std::vector<double>& irradiance) {
  Solution solution;
  solution.scene = scene;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const double h = at(irradiance, i);
    solution.irradiance.push_back({h, h, h});
    solution.radiosity.push_back(scene->exitance(i) +
                                 scene->reflectance(i) * solution.irradiance.back());
  }
  return solution;
}

/// The square [x, x + size] x [y, y + size] in the plane z = 0.
std::vector<Vec3> square(double x, double y, double size) {
  return {{x, y, 0}, {x + size, y, 0}, {x + size, y + size, 0}, {x, y + size, 0}};
}

const double gray = std::sqrt(3.0);

TEST(Jumps, AreThoseOfTheIrradianceTimesTheReflectance) {
  Sketch sketch;
  const int half = sketch.material(0.5, 0), lamp = sketch.material(0.25, 7);
  // Two smaller squares are beside the second.
  sketch.face(square(0, 0, 2), half).face(square(2, 0, 2), lamp);
  sketch.face(square(4, 0, 1), half).face(square(4, 1, 1), half);
  const auto jumps = radiosity_jumps(with_irradiance(sketch.scene(), {1, 3, 3, 7}));
  EXPECT_NEAR(jumps[0], 0.5 * 2 * gray, 1e-12);
  // The jump is 2 along 2 m, 0 along 1 m and 4 along 1 m.
  EXPECT_NEAR(jumps[1], 0.25 * std::sqrt((2 * 4 + 1 * 0 + 1 * 16) / 4.0) * gray, 1e-12);
  EXPECT_NEAR(jumps[2], 0.5 * std::sqrt((0 + 16) / 2.0) * gray, 1e-12);
}

TEST(Jumps, OfPatchesWithoutNeighborsInTheirPlane) {
  Sketch sketch;
  const int half = sketch.material(0.5, 0);
  sketch.face(square(0, 0, 1), half);
  sketch.face({{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}, half);
  sketch.face(square(5, 5, 1), half);
  const auto jumps = radiosity_jumps(with_irradiance(sketch.scene(), {4, 10, 6}));
  EXPECT_NEAR(jumps[0], 0.5 * 6 * gray, 1e-12);  // to the square at an angle
  EXPECT_NEAR(jumps[1], 0.5 * 6 * gray, 1e-12);
  EXPECT_NEAR(jumps[2], 0.5 * 6 * gray, 1e-12);  // its own
}

TEST(Jumps, OfALinearFunctionCutInTwoAreNone) {
  Sketch sketch;
  sketch.face(square(0, 0, 1), sketch.material(0.5, 0));
  const auto whole = sketch.scene();
  const auto cut = divide(*whole, std::vector<PatchId>{0}).scene;
  // H = 2 + x + 3 y.
  std::vector<double> means;
  for (const Patch& patch : cut->patches()) {
    means.push_back(2 + patch.center.x + 3 * patch.center.y);
  }
  Solution solution = with_irradiance(cut, means);
  const double steps = radiosity_jumps(solution)[0];
  for (PatchId i = 0; i < cut->patch_count(); ++i) {
    const LinearBasis basis = linear_basis(*cut, i);
    // The coefficients of x + 3 y are along the edges, whose functions are orthogonal in a square.
    const Vec3 slope{1, 3, 0};
    const auto part = [&](std::size_t a) {
      const double b =
          0.5 * dot(slope, basis.gradient[a]) / dot(basis.gradient[a], basis.gradient[a]);
      return Rgb{b, b, b};
    };
    solution.linear_terms.push_back({part(0), part(1)});
  }
  EXPECT_GT(steps, 0.1);
  EXPECT_THAT(radiosity_jumps(solution), Each(::testing::Lt(1e-12)));
}

SolveOptions options(Basis basis = Basis::constant) { return {.directions = 1024, .basis = basis}; }

std::shared_ptr<const Scene> evenly(const char* spec, std::int64_t patches) {
  return load_scene(spec, {.max_patch_area = max_patch_area_for(*load_scene(spec), patches)});
}

/// The reference is finer than the compared solutions, with the same directions, so that both have
/// their error.
const Solution& reference() {
  static const Solution solution = solve(evenly("cornell-box", 2500), options(Basis::linear));
  return solution;
}

/// Relative L2 error without the lamps.
double error_of(const std::shared_ptr<const Scene>& scene, Basis basis) {
  return compare_functions(reference(), solve(scene, options(basis))).l2;
}

class RefinementBy : public ::testing::TestWithParam<std::tuple<RefineBy, Basis>> {};

/// The same number of patches represents the radiosity better if the patches to divide are chosen.
TEST_P(RefinementBy, IsBetterThanEvenDivision) {
  const auto [by, basis] = GetParam();
  const Refinement refined =
      refine(load_scene("cornell-box"), options(basis), {.by = by, .patches = 300});
  EXPECT_LE(refined.scene->patch_count(), 300);
  EXPECT_GE(refined.scene->patch_count(), 297);
  const auto even = evenly("cornell-box", 300);
  EXPECT_GE(even->patch_count(), 285);
  EXPECT_LT(error_of(refined.scene, basis), 0.92 * error_of(even, basis));
  for (std::size_t k = 1; k < refined.rounds.size(); ++k) {
    EXPECT_LE(refined.rounds[k].patches, 2 * refined.rounds[k - 1].patches + 3);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RefinementBy,
                         ::testing::Combine(::testing::Values(RefineBy::jump, RefineBy::error),
                                            ::testing::Values(Basis::constant, Basis::linear)),
                         [](const auto& tested) {
                           return name_of(std::get<0>(tested.param)) + "_" +
                                  name_of(std::get<1>(tested.param));
                         });

/// A floor of which a large plate just above it shades the part x > 2: the shadow's edge is
/// divided, the light and the dark on its sides are not.
TEST_P(RefinementBy, DividesAtTheEdgeOfAShadowFirst) {
  const auto [by, basis] = GetParam();
  Sketch sketch;
  const int floor = sketch.material(0.5, 0), black = sketch.material(0, 0),
            lamp = sketch.material(0, 1);
  sketch.face({{-0.7, 0, 0}, {4.3, 0, 0}, {4.3, 2, 0}, {-0.7, 2, 0}}, floor);
  sketch.face({{2, -4, 0.02}, {9, -4, 0.02}, {9, 6, 0.02}, {2, 6, 0.02}}, black);
  sketch.face({{-9, -9, 2}, {-9, 9, 2}, {9, 9, 2}, {9, -9, 2}}, lamp);
  // Most patches are of the lamp, so that a round could divide all of the floor.
  const auto scene = sketch.scene({.max_patch_area = 0.5});
  const Refinement refined =
      refine(scene, options(basis), {.by = by, .patches = scene->patch_count() + 250});
  double at_edge = 0, beside = 0;
  int count_at_edge = 0, count_beside = 0;
  for (const Patch& patch : refined.scene->patches()) {
    if (patch.face == 0) {
      const bool near = std::abs(patch.center.x - 2) < 0.4;
      (near ? at_edge : beside) += patch.area;
      ++(near ? count_at_edge : count_beside);
    }
  }
  EXPECT_GT(count_at_edge, 100);
  EXPECT_LT(at_edge / count_at_edge, 0.2 * beside / count_beside);
}

/// Two such shadows, far apart: one in bright red light, the other in dim blue light.
TEST_P(RefinementBy, DividesAtTheEdgeOfAShadowInADimColorToo) {
  const auto [by, basis] = GetParam();
  Sketch sketch;
  const int floor = sketch.material(0.5, 0), black = sketch.material(0, 0);
  constexpr double apart = 1000;
  const std::array lamps{sketch.material(0, 1000), sketch.material(0, 1)};
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    const double y = apart * static_cast<double>(k);
    sketch.face({{-0.7, y, 0}, {4.3, y, 0}, {4.3, y + 2, 0}, {-0.7, y + 2, 0}}, floor);
    sketch.face({{2, y - 4, 0.02}, {9, y - 4, 0.02}, {9, y + 6, 0.02}, {2, y + 6, 0.02}}, black);
    sketch.face({{-9, y - 9, 2}, {-9, y + 9, 2}, {9, y + 9, 2}, {9, y - 9, 2}}, lamps[k]);
  }
  SceneDescription description = sketch.description();
  at(description.materials, lamps[0]).exitance = {1000, 0, 0};
  at(description.materials, lamps[1]).exitance = {0, 0, 1};
  const auto scene =
      std::make_shared<const Scene>(description, SceneOptions{.max_patch_area = 0.5});
  const Refinement refined =
      refine(scene, options(basis), {.by = by, .patches = scene->patch_count() + 250});
  int red = 0, blue = 0;
  for (const Patch& patch : refined.scene->patches()) {
    if (std::abs(patch.center.x - 2) < 0.4 && patch.center.z == 0) {
      ++(patch.center.y < apart / 2 ? red : blue);
    }
  }
  EXPECT_GT(red, 50);
  EXPECT_GT(blue, 50);
  EXPECT_LT(std::abs(red - blue), red / 2);
}

/// With RefineBy::error, the measure of the last round estimates the error of the result.
TEST(Refinement, EstimatesItsError) {
  const Refinement refined =
      refine(load_scene("cornell-box"), options(), {.by = RefineBy::error, .patches = 200});
  const double error = error_of(refined.scene, Basis::constant);
  // A division changes sqrt(3/4) of an error that falls as h, and sqrt(1/2) of an error that falls
  // as sqrt(h).
  EXPECT_LT(refined.rounds.back().measure, error);
  EXPECT_GT(refined.rounds.back().measure, 0.6 * error);
  EXPECT_EQ(refined.rounds.back().patches, refined.scene->patch_count());
}

TEST(Refinement, EndsWhereItsFigureIsReached) {
  const RefineOptions until{.by = RefineBy::error, .patches = 100000, .until = 0.2};
  const Refinement refined = refine(load_scene("cornell-box"), options(), until);
  EXPECT_LE(refined.rounds.back().measure, 0.2);
  EXPECT_GT(refined.rounds[refined.rounds.size() - 2].measure, 0.2);
  EXPECT_LT(refined.scene->patch_count(), 2000);
}

TEST(Refinement, LeavesUniformLightAlone) {
  for (const RefineBy by : {RefineBy::jump, RefineBy::error}) {
    SolveOptions rows = options();
    rows.normalize = Normalization::rows;
    const Refinement refined = refine(load_scene("furnace"), rows, {.by = by, .patches = 500});
    EXPECT_THAT(refined.rounds, SizeIs(1));
    EXPECT_LT(refined.rounds.front().measure, 1e-6);
    EXPECT_EQ(refined.scene->patch_count(), load_scene("furnace")->patch_count());
  }
}

TEST(Refinement, DoesNotDependOnThreads) {
  SolveOptions one = options(), two = options();
  one.threads = 1;
  two.threads = 2;
  const RefineOptions by{.patches = 400};
  const auto a = refine(load_scene("rooms"), one, by).scene,
             b = refine(load_scene("rooms"), two, by).scene;
  EXPECT_EQ(a->points(), b->points());
  EXPECT_EQ(a->patch_count(), b->patch_count());
}

TEST(Refinement, RefusesWhatItCannotDo) {
  const auto scene = load_scene("furnace");
  EXPECT_THROW(refine(scene, options(), {.patches = 0}), InputError);
  EXPECT_THROW(refine(scene, options(), {.patches = 9, .until = 1}), InputError);
  EXPECT_THROW(refine(scene, {.engine = Engine::pairs}, {.patches = 9}), InputError);
  EXPECT_THROW(from_name<RefineBy>("jumps"), InputError);
  const Cancellation canceled;
  canceled.cancel();
  EXPECT_THROW(refine(scene, options(), {.patches = 99}, {}, canceled), Canceled);
}

}  // namespace
}  // namespace transillum::refinement_test
