// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors pair by pair and solutions with them: known values, closure, reciprocity, and
// agreement with passes, which share nothing with them but the scene.
#include "transillum/pair_form_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "support/scenes.h"
#include "transillum/errors.h"
#include "transillum/first_shot.h"
#include "transillum/form_factor_solve.h"
#include "transillum/point_sensors.h"
#include "transillum/shading.h"
#include "transillum/solve_session.h"
#include "transillum/study.h"

namespace transillum::pair_form_factors_test {
namespace {

using testing::box_in_cube;
using testing::Sketch;

std::vector<double> dense_row(const Scene& scene, const FormFactors& f, PatchId i) {
  std::vector<double> row(scene.patches().size());
  for (std::size_t k = f.row_begin[static_cast<std::size_t>(i)];
       k < f.row_begin[static_cast<std::size_t>(i) + 1]; ++k) {
    row[static_cast<std::size_t>(f.source[k])] = f.value[k];
  }
  return row;
}

double sum(const std::vector<double>& row) { return std::accumulate(row.begin(), row.end(), 0.0); }

/// Largest difference of a row sum from 1.
double closure_error(const Scene& scene, const FormFactors& f) {
  double error = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    error = std::max(error, std::abs(sum(dense_row(scene, f, i)) - 1));
  }
  return error;
}

const auto turned = testing::random_rotation_about({0.5, 0.5, 0.5}, 4);

TEST(PairFormFactors, OfOppositeSquaresAreTheClosedForm) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, gray);
  const auto scene = sketch.scene();
  const FormFactors f = pair_form_factors(*scene, {});
  ASSERT_EQ(f.size(), 2U);
  EXPECT_NEAR(f.value[0], 0.1998248957, 1e-10);
  EXPECT_EQ(f.value[0], f.value[1]);
}

/// Two quadrilaterals with nothing in between; corner `corner` of the first is moved by `bend`
/// across its plane. The plane of the second cuts the first.
std::shared_ptr<const Scene> bent_pair(std::size_t corner, double bend, bool two_sided = false) {
  std::vector<Vec3> bent{
      {-.35, 1.04, 1.33}, {-.31, 1.042, 1.37}, {-.05, 1.042, 1.37}, {-.01, 1.04, 1.33}};
  bent[corner].y += bend;
  Sketch sketch;
  sketch.face(bent, sketch.material(0.5, 1));
  sketch.face({{-.17, 1.18, 1.45}, {-.17, 1.18, 1.43}, {-.17, 1.08, 1.43}, {-.17, 1.08, 1.45}},
              sketch.material(0.5, 0));
  return sketch.scene({.two_sided = two_sided});
}

/// A quadrilateral bent by rounding hid itself: 30 % to all of these form factors was lost.
TEST(PairFormFactors, OfABentQuadrilateralAreThoseOfThePlanarOne) {
  constexpr double planar = 3.2396158e-3;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    for (const double bend : {0.0, 1e-15, 1e-13, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5}) {
      for (const double signed_bend : {bend, -bend}) {
        const auto scene = bent_pair(corner, signed_bend);
        const auto place = [&] { return ::testing::Message() << corner << ' ' << signed_bend; };
        const double near = 1e-8 + 1e2 * bend * planar;
        const FormFactors f = pair_form_factors(*scene, {});
        ASSERT_EQ(f.size(), 2U) << place();
        EXPECT_NEAR(f.value[0], planar, near) << place();
        EXPECT_NEAR(exact_form_factors(*scene, 0)[1], planar, near) << place();
        const double lamp_area = scene->patch(0).area, area = scene->patch(1).area;
        EXPECT_NEAR(shoot(*scene, {0}).irradiance[1].g, planar * lamp_area / area, 10 * near)
            << place();
        const auto both_sides = exact_form_factors(*bent_pair(corner, signed_bend, true), 0);
        EXPECT_NEAR(both_sides[2], planar, near) << place();
        EXPECT_LE(both_sides[1], 10 * bend) << place() << ": its own back";
      }
    }
  }
}

/// A wall through a ceiling of four triangles, whose far edge is `bend` below.
std::vector<double> factors_below_a_bent_ceiling(double bend) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{4, 3, 0}, {4, 0, 0}, {0, 0, 0}}, gray);
  sketch.face({{4, 3, 0}, {0, 0, 0}, {0, 3, 0}}, gray);
  sketch.face({{8, 3, -bend}, {8, 0, -bend}, {4, 0, 0}}, gray);
  sketch.face({{8, 3, -bend}, {4, 0, 0}, {4, 3, 0}}, gray);
  sketch.face({{.1, 0, -4}, {.1, 3, -4}, {.1, 3, .1}}, gray);
  const auto scene = sketch.scene();
  return dense_row(*scene, pair_form_factors(*scene, {}), 4);
}

/// The face that the triangles are merged into reaches below some of them by rounding. It hid these
/// triangles: 2e-19 instead of 0.0438.
TEST(PairFormFactors, OfTrianglesOfABentFaceAreThoseOfAPlanarOne) {
  const std::vector<double> planar = factors_below_a_bent_ceiling(0);
  for (const double size : {1e-12, 1e-10, 1e-8, 1e-7, 1e-6}) {
    for (const double bend : {size, -size}) {
      const std::vector<double> bent = factors_below_a_bent_ceiling(bend);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(bent[i], planar[i], 1e-8 + 10 * size) << i << ' ' << bend;
      }
    }
  }
}

TEST(PairFormFactors, OfAPointToABentQuadrilateralIsThatToThePlanarOne) {
  const PointSensor sensor{{-.17, 1.13, 1.44}, {-1, 0, 0}};
  const double planar = sensor_form_factors(*bent_pair(0, 0), {{sensor}}).value.at(0);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    for (const double bend : {1e-12, 1e-8, 1e-6, -1e-12, -1e-8, -1e-6}) {
      const FormFactors f = sensor_form_factors(*bent_pair(corner, bend), {{sensor}});
      EXPECT_NEAR(f.value.at(0), planar, 1e2 * std::abs(bend)) << corner << ' ' << bend;
    }
  }
}

/// A box near a floor, below a far lamp whose edges are parallel to none of its own. The floor was
/// sampled at few points, since it is small for its distance from the lamp: its light was up to
/// 22 % off. A far lamp casts the shadow of a sun.
TEST(PairFormFactors, PastABlockerThatIsNearTheReceiverOfAFarLamp) {
  const Vec3 toward = normalized({0.6, 0.3, 1}), up{0, 0, 1};
  for (const auto& [distance, half, allowed] :
       {std::tuple{30.0, 0.2, 2e-3}, {1000.0, 0.5, 1e-4}, {1000.0, 20.0, 2e-3}}) {
    Sketch sketch;
    const int gray = sketch.material(0.5, 0);
    sketch.face({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, gray);
    sketch.box({-1, -1, 0.2}, {0, 0.5, 1.5}, false, gray);
    // The sun casts the same shadow, but for the penumbra and the difference of directions.
    double lit = 0;
    const Vec3 rays[] = {toward};
    const auto without_lamp = sketch.scene();
    sunlit_fractions(without_lamp, std::make_shared<const BspTree>(*without_lamp), rays,
                     [&](std::size_t, const std::vector<double>& found) { lit = found[0]; });
    const Vec3 middle = distance * toward, u = normalized(cross(toward, up)), v = cross(toward, u);
    sketch.face({middle - half * u - half * v, middle - half * u + half * v,
                 middle + half * u + half * v, middle + half * u - half * v},
                sketch.material(0, 1));
    const auto scene = sketch.scene();
    const PatchId lamp = scene->patch_count() - 1;
    const DirectLight light = shoot(*scene, {lamp});
    const double far = 4 * half * half * toward.z / (std::numbers::pi * distance * distance);
    EXPECT_NEAR(light.irradiance[0].r, lit * far, (allowed + 4 / distance) * far) << distance;
    EXPECT_LT(lit, 0.85);
  }
}

TEST(PairFormFactors, RowsOfAConvexRoomSumToOne) {
  Sketch sketch;
  sketch.box({0, 0, 0}, {3, 1, 2}, true, sketch.material(0.5, 1));
  const auto scene = sketch.scene({.max_patch_area = 0.1});
  EXPECT_LT(closure_error(*scene, pair_form_factors(*scene, {.points = 1})), 1e-12);
}

/// Twice as many points leave a third of the error or less, where edges are parallel and where none
/// are.
TEST(PairFormFactors, RowsPastBlockersSumToOneTheBetterTheMorePoints) {
  for (const bool parallel : {true, false}) {
    const auto scene = parallel ? box_in_cube(4, 2).scene() : box_in_cube(4, 2, turned).scene();
    double last = closure_error(*scene, pair_form_factors(*scene, {.points = 8}));
    EXPECT_LT(last, 1e-2);
    for (const int points : {16, 32, 64}) {
      const double error = closure_error(*scene, pair_form_factors(*scene, {.points = points}));
      EXPECT_LT(error, last) << points;
      last = error;
    }
    EXPECT_LT(last, 2e-4);
  }
}

TEST(PairFormFactors, AreReciprocal) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.05});
  const FormFactors f = pair_form_factors(*scene, {});
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const std::vector<double> row = dense_row(*scene, f, i);
    for (PatchId j = 0; j < i; ++j) {
      const double one = scene->patch(i).area * row[static_cast<std::size_t>(j)];
      const double other =
          scene->patch(j).area * dense_row(*scene, f, j)[static_cast<std::size_t>(i)];
      // Both values are rounded by a division and a product.
      EXPECT_LE(std::abs(one - other), 2 * std::numeric_limits<double>::epsilon() * one);
    }
  }
}

TEST(PairFormFactors, AreTheRowsOfExactFormFactors) {
  for (const bool two_sided : {false, true}) {
    const auto scene = load_scene("rooms", {.two_sided = two_sided});
    const FormFactors f = pair_form_factors(*scene, {.points = 16});
    for (PatchId i = 0; i < scene->patch_count(); i += 31) {
      const std::vector<double> row = dense_row(*scene, f, i),
                                exact = exact_form_factors(*scene, i);
      for (std::size_t j = 0; j < row.size(); ++j) {
        EXPECT_NEAR(row[j], exact[j], 1e-14) << i << " " << j;
      }
    }
  }
}

/// A small patch under a plate that hides half of the ceiling from it: by its size over the
/// distance it gets three points, which see a third of that, or two.
TEST(PairFormFactors, PastABlockerNearASmallPatchTakeMorePoints) {
  testing::Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face({{-0.05, -0.05, 0}, {0.05, -0.05, 0}, {0.05, 0.05, 0}, {-0.05, 0.05, 0}}, gray);
  sketch.face({{-2.5, -2.5, 3}, {-2.5, 2.5, 3}, {2.5, 2.5, 3}, {2.5, -2.5, 3}}, gray);
  sketch.face({{0.01, -1, 0.02}, {1, -1, 0.02}, {1, 1, 0.02}, {-0.02, 1, 0.02}}, gray);
  const auto scene = sketch.scene();
  const double usual = dense_row(*scene, pair_form_factors(*scene, {.points = 32}), 0)[1];
  const double many = dense_row(*scene, pair_form_factors(*scene, {.points = 512}), 0)[1];
  EXPECT_GT(many, 0.1);
  EXPECT_NEAR(usual, many, 0.005 * many);
}

TEST(PairFormFactors, AreTheSameBitsForAnyNumberOfThreads) {
  const auto scene = box_in_cube(4, 2, turned).scene();
  const FormFactors one = pair_form_factors(*scene, {.threads = 1});
  const FormFactors many = pair_form_factors(*scene, {.threads = 5});
  EXPECT_EQ(one.row_begin, many.row_begin);
  EXPECT_EQ(one.source, many.source);
  EXPECT_EQ(one.value, many.value);
}

TEST(PairFormFactors, RefuseBadOptionsAndRespectTheMemoryLimit) {
  const auto scene = load_scene("furnace");
  EXPECT_THROW(pair_form_factors(*scene, {.points = 0}), InputError);
  EXPECT_THROW(pair_form_factors(*scene, {.points = 1025}), InputError);
  EXPECT_THROW(pair_form_factors(*scene, {.threads = -1}), InputError);
  EXPECT_THROW(pair_form_factors(*scene, {.memory = 100}), MemoryLimitExceeded);
}

TEST(PairFormFactors, AreCanceledWithinARow) {
  const auto scene = load_scene("sphere-flake:levels=1");
  const Cancellation cancellation;
  double last = 0;
  EXPECT_THROW(pair_form_factors(*scene, {.threads = 1}, cancellation,
                                 [&](double fraction) {
                                   EXPECT_GE(fraction, last);
                                   last = fraction;
                                   cancellation.cancel();
                                 }),
               Canceled);
  EXPECT_GT(last, 0);
  EXPECT_LT(last, 0.1);
}

Solution solved_by_pairs(const std::shared_ptr<const Scene>& scene, int points) {
  SolveOptions options{.engine = Engine::pairs, .tolerance = 1e-9};
  options.engine_options.points = points;
  return solve_by_form_factors(scene, options);
}

/// Two methods that share only the scene: pairs without directions, and rotated passes, whose error
/// their replicas estimate.
TEST(PairSolve, AgreesWithPassesWithinTheirError) {
  for (const auto& scene : {box_in_cube().scene(), box_in_cube(8, 4, turned).scene(),
                            load_scene("cornell-box", {.max_patch_area = 0.05})}) {
    const Solution passes = solve(scene, {.directions = 8192, .replicas = 8, .tolerance = 1e-8});
    const Solution pairs = solved_by_pairs(scene, 64);
    const RadiosityError error = radiosity_error(*scene, pairs.radiosity, passes.radiosity);
    EXPECT_LT(error.rms, passes.error.quantile * passes.error.rms);
    // A single set is more evenly spread than replicas.
    const Solution one_set =
        solve(scene, {.directions = 12288, .first_shot = {}, .tolerance = 1e-8});
    EXPECT_LT(radiosity_error(*scene, pairs.radiosity, one_set.radiosity).rms, 1e-4);
  }
}

TEST(PairSolve, ReportsItsStatistics) {
  const auto scene = box_in_cube(4, 2).scene();
  const Solution solution = solved_by_pairs(scene, 32);
  const SolveStatistics& s = solution.statistics;
  EXPECT_TRUE(solution.complete && s.converged);
  EXPECT_EQ(s.pairs, 120 * 119 / 2);
  EXPECT_EQ(s.directions, 32);
  EXPECT_LT(s.closure_defect_max, 1e-3);
  EXPECT_LT(s.energy_defect, 1e-8);  // the tolerance of the iteration
  EXPECT_NEAR(s.energy_balance, 1, 1e-3);
}

TEST(PairSolve, RefusesWhatNeedsDirections) {
  const auto scene = load_scene("furnace");
  EXPECT_THROW(solve_by_form_factors(scene, {.engine = Engine::pairs, .replicas = 2}), InputError);
  EXPECT_THROW(solve_by_form_factors(scene, {.engine = Engine::fast}), InputError);
  EXPECT_THROW(make_engine(Engine::pairs, scene, nullptr), InputError);
  EXPECT_FALSE(takes_directions(Engine::pairs));
}

/// The estimate is at least the error, compared with many more points.
TEST(PairSolve, ReachesAnAccuracy) {
  const auto scene = box_in_cube(4, 2, turned).scene();
  const Solution reference = solved_by_pairs(scene, 256);
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    const PairSolution result = solve_by_pairs(scene, {}, accuracy);
    EXPECT_TRUE(result.reached);
    EXPECT_LE(result.error, accuracy);
    EXPECT_LE(radiosity_error(*scene, result.solution.radiosity, reference.radiosity).rms,
              result.error);
  }
  EXPECT_THROW(solve_by_pairs(scene, {}, 0), InputError);
}

TEST(PairSolve, IsExactAtOnceWhereNothingIsBetween) {
  Sketch sketch;
  sketch.box({0, 0, 0}, {1, 2, 1}, true, sketch.material(0.5, 1));
  const PairSolution result = solve_by_pairs(sketch.scene(), {}, 1e-9);
  EXPECT_TRUE(result.reached);
  EXPECT_EQ(result.error, 0);
}

}  // namespace
}  // namespace transillum::pair_form_factors_test
