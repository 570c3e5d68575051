// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Engine pairs with linear functions (ALGORITHM.md 5.9, 6.12): moments from a point against a
// quadrature, closure of the moments, and agreement with passes, which share nothing with pairs but
// the scene.

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "geometry/point_moments.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/form_factor_solve.h"
#include "transillum/linear_basis.h"
#include "transillum/pair_form_factors.h"
#include "transillum/solve_session.h"
#include "transillum/study.h"

namespace transillum::pair_moments_test {
namespace {

using testing::box_in_cube;
using testing::Sketch;

const auto turned = testing::random_rotation_about({0.5, 0.5, 0.5}, 4);

using Points = std::vector<PlaneRegion::Point>;

/// Calls visit(x, weight) for Gauss points of [0, 1].
template <class Visit>
void for_gauss_points(Visit visit) {
  using Rule = boost::math::quadrature::gauss<double, 40>;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    const double x = Rule::abscissa()[k], weight = Rule::weights()[k] / 2;
    visit((1 + x) / 2, weight);
    visit((1 - x) / 2, weight);
  }
}

/// The integrals of point_moments(), by Gauss points of the triangles of a convex polygon.
std::array<double, 3> by_quadrature(const Vec3& n, const Points& polygon) {
  std::array<double, 3> sum{};
  const PlaneRegion::Point& o = polygon[0];
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const double au = polygon[k].u - o.u, av = polygon[k].v - o.v;
    const double bu = polygon[k + 1].u - o.u, bv = polygon[k + 1].v - o.v;
    const double area = std::abs(au * bv - av * bu);
    for_gauss_points([&](double s, double weight_s) {
      for_gauss_points([&](double t, double weight_t) {
        const double u = o.u + s * ((1 - t) * au + t * bu);
        const double v = o.v + s * ((1 - t) * av + t * bv);
        const double square = 1 + u * u + v * v;
        const double kernel = area * s * weight_s * weight_t * (n.z + n.x * u + n.y * v) /
                              (std::numbers::pi * square * square);
        sum[0] += kernel;
        sum[1] += kernel * u;
        sum[2] += kernel * v;
      });
    });
  }
  return sum;
}

TEST(PointMoments, AreThoseOfAQuadrature) {
  // The polygons are clockwise: around the foot of the point, beside it, with a corner on it and
  // with an edge through it.
  const std::pair<Vec3, Points> cases[] = {
      {{0.1, -0.2, 0.97}, {{-0.5, -0.4}, {-0.4, 0.6}, {0.5, 0.7}, {0.6, -0.3}}},
      {{0.2, 0.3, 0.93}, {{0.1, 0.2}, {1.2, 1.7}, {1.5, 0.3}}},
      {{0.5, 0.1, 0.86}, {{3, 1}, {4, 5}, {8, 6}, {9, 2}}},
      {{0.9, 0, 0.43}, {{0, 0}, {0, 1}, {1, 1}, {1, 0}}},
      {{0, 0, 1}, {{-1, 0}, {-1, 2}, {1, 2}, {1, 0}}}};
  for (const auto& [normal, polygon] : cases) {
    const PointMoments moments = point_moments(normal, polygon);
    const auto expected = by_quadrature(normal, polygon);
    EXPECT_NEAR(moments.one, expected[0], 1e-13);
    EXPECT_NEAR(moments.u, expected[1], 1e-13);
    EXPECT_NEAR(moments.v, expected[2], 1e-13);
  }
}

Solution solved(const std::shared_ptr<const Scene>& scene, int points, Basis basis) {
  SolveOptions options{.engine = Engine::pairs, .basis = basis, .tolerance = 1e-10};
  options.engine_options.points = points;
  return solve_by_form_factors(scene, options);
}

/// All coefficients, one patch after the other.
std::vector<Rgb> coefficients(const Solution& solution) {
  std::vector<Rgb> values;
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
    values.push_back(solution.radiosity[i]);
    values.push_back(solution.linear_terms[i].first);
    values.push_back(solution.linear_terms[i].second);
  }
  return values;
}

/// Oracle 1 for moments, with all directions at once: sum_j T^a0(i,j) = ∫ phi_a = 0.
TEST(PairMoments, CloseTheBetterTheMorePoints) {
  Sketch room;
  room.box({0, 0, 0}, {3, 1, 2}, true, room.material(0.5, 1));
  for (const auto& scene : {room.scene({.max_patch_area = 0.5}), box_in_cube(3, 2).scene(),
                            box_in_cube(3, 2, turned).scene()}) {
    double last = 0.05;
    for (const int points : {4, 8, 16, 32}) {
      const Solution solution = solved(scene, points, Basis::linear);
      const double defect = solution.statistics.closure_defect_moments;
      EXPECT_GT(defect, 0);
      EXPECT_LT(defect, 0.7 * last) << points;
      last = defect;
    }
    EXPECT_LT(last, 1e-3);
  }
}

TEST(PairMoments, FormFactorsAreThoseOfConstantFunctions) {
  for (const auto& scene : {box_in_cube(4, 2).scene(), load_scene("rooms")}) {
    const Solution linear = solved(scene, 8, Basis::linear);
    const Solution constant = solved(scene, 8, Basis::constant);
    EXPECT_EQ(linear.form_factors->row_begin, constant.form_factors->row_begin);
    EXPECT_EQ(linear.form_factors->source, constant.form_factors->source);
    EXPECT_EQ(linear.form_factors->value, constant.form_factors->value);
    EXPECT_EQ(linear.form_factor_sums, constant.form_factor_sums);
    EXPECT_EQ(linear.statistics.form_factors, constant.statistics.form_factors);
  }
}

/// Two methods that share only the scene.
TEST(PairMoments, SolutionsAgreeWithPasses) {
  for (const auto& scene :
       {box_in_cube(4, 2).scene(), box_in_cube(4, 2, turned).scene(), load_scene("cornell-box")}) {
    const Solution passes =
        solve(scene, {.directions = 16384, .basis = Basis::linear, .tolerance = 1e-8});
    double last = 0.05;
    for (const int points : {4, 16}) {
      const Solution pairs = solved(scene, points, Basis::linear);
      const double error = function_error(*scene, coefficients(pairs), coefficients(passes)).rms;
      EXPECT_LT(error, last) << points;
      last = error;
    }
    EXPECT_LT(last, 1e-3);
  }
}

/// Oracles 3 and 4.
TEST(PairMoments, FurnaceAndEnergy) {
  Sketch furnace;
  furnace.box({0, 0, 0}, {1, 2, 1}, true, furnace.material(0.5, 1));
  const Solution uniform = solved(furnace.scene({.max_patch_area = 0.5}), 64, Basis::linear);
  for (const Rgb& b : uniform.radiosity) {
    EXPECT_NEAR(b.r, 2, 1e-5);
  }
  for (const LinearTerm& part : uniform.linear_terms) {
    EXPECT_LT(std::max(max_abs(part.first), max_abs(part.second)), 1e-3);
  }
  const Solution box = solved(load_scene("cornell-box"), 16, Basis::linear);
  EXPECT_LT(box.statistics.energy_defect, 1e-8);  // the tolerance of the iteration
  EXPECT_NEAR(box.statistics.energy_balance, 1, 5e-3);
  EXPECT_GT(box.statistics.negative_corners, 0);
  EXPECT_TRUE(box.complete && box.statistics.converged);
}

TEST(PairMoments, AreTheSameBitsForAnyNumberOfThreads) {
  const auto scene = box_in_cube(4, 2, turned).scene();
  SolveOptions options{.engine = Engine::pairs, .basis = Basis::linear};
  options.engine_options.points = 4;
  options.threads = 1;
  const Solution one = solve_by_form_factors(scene, options);
  options.threads = 5;
  EXPECT_EQ(coefficients(one), coefficients(solve_by_form_factors(scene, options)));
}

TEST(PairMoments, RespectTheMemoryLimit) {
  SolveOptions options{.engine = Engine::pairs, .basis = Basis::linear};
  options.memory = 1000;
  EXPECT_THROW(solve_by_form_factors(load_scene("furnace"), options), MemoryLimitExceeded);
}

/// The estimate is at least the error, compared with many more points.
TEST(PairMoments, ReachAnAccuracy) {
  const auto scene = box_in_cube(4, 2, turned).scene();
  const SolveOptions options{.basis = Basis::linear};
  const Solution reference = solved(scene, 64, Basis::linear);
  for (const double accuracy : {1e-2, 1e-3}) {
    const PairSolution result = solve_by_pairs(scene, options, accuracy);
    EXPECT_TRUE(result.reached);
    EXPECT_LE(result.error, accuracy);
    EXPECT_LE(function_error(*scene, coefficients(result.solution), coefficients(reference)).rms,
              result.error);
  }
}

}  // namespace
}  // namespace transillum::pair_moments_test
