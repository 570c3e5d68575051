// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Form factors by rays and by passes, against formulas and against each other.

#include <gtest/gtest.h>

#include <cmath>

#include "support/form_factor_rows.h"
#include "support/scenes.h"
#include "transillum/errors.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_session.h"

namespace transillum::form_factors_test {
namespace {

using testing::form_factor;
using testing::row_sum;
using testing::Sketch;

constexpr double parallel_unit_squares = 0.1998248957;       // at distance 1
constexpr double perpendicular_unit_squares = 0.2000437761;  // with a common edge

std::shared_ptr<const Scene> squares(const std::vector<Vec3>& second,
                                     const SceneOptions& options = {}) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray).face(second, gray);
  return sketch.scene(options);
}

TEST(Gather, MatchesTheClosedForms) {
  const std::pair<std::vector<Vec3>, double> cases[] = {
      {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, parallel_unit_squares},
      {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, perpendicular_unit_squares}};
  for (const auto& [second, exact] : cases) {
    const auto scene = squares(second);
    double squares_sum = 0, sum = 0;
    constexpr int trials = 50, rays = 4000;
    for (std::uint64_t seed = 0; seed < trials; ++seed) {
      const FormFactors f = gather_form_factors(*scene, {.rays_per_patch = rays, .seed = seed});
      for (const double error : {form_factor(f, 0, 1) - exact, form_factor(f, 1, 0) - exact}) {
        sum += error;
        squares_sum += error * error;
      }
    }
    // The estimate is unbiased. With evenly spread points, the error is below the error of random
    // points, sqrt(F (1 - F) / N).
    const double deviation = std::sqrt(squares_sum / (2 * trials));
    EXPECT_LT(deviation, 0.6 * std::sqrt(exact * (1 - exact) / rays));
    EXPECT_LT(std::abs(sum / (2 * trials)), 3.5 * deviation / std::sqrt(2 * trials));
    const FormFactors fine = gather_form_factors(*scene, {.rays_per_patch = 1 << 20});
    EXPECT_NEAR(form_factor(fine, 0, 1), exact, 1e-4);
  }
}

/// Squares receive on their lit side only: their backs block light and receive nothing.
TEST(Gather, CoincidentOppositeSquaresAreHitOnTheirLitSides) {
  const std::vector<Vec3> ceiling{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const auto two_sided = squares(ceiling, {.two_sided = true});  // patches 0, 1 and 2, 3
  const FormFactors f = gather_form_factors(*two_sided, {.rays_per_patch = 100000});
  EXPECT_NEAR(form_factor(f, 0, 2), parallel_unit_squares, 1e-3);
  EXPECT_EQ(form_factor(f, 0, 3), 0);
  EXPECT_EQ(row_sum(f, 1), 0);
  EXPECT_EQ(row_sum(f, 3), 0);
  const auto turned = squares({ceiling.rbegin(), ceiling.rend()});
  EXPECT_EQ(gather_form_factors(*turned, {}).size(), 0U);
}

TEST(Gather, RowsOfClosedScenesSumToOne) {
  for (const char* spec : {"furnace", "cornell-box", "rooms", "sphere-flake:levels=1"}) {
    const auto scene = load_scene(spec);
    const FormFactors f = gather_form_factors(*scene, {.rays_per_patch = 300});
    ASSERT_EQ(f.row_begin.size(), scene->patches().size() + 1);
    double sum = 0;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      // In single precision, rays that start next to an edge may leak.
      EXPECT_NEAR(row_sum(f, i), 1, 0.01) << spec << " " << i;
      sum += row_sum(f, i);
      const auto row = static_cast<std::size_t>(i);
      for (std::size_t k = f.row_begin[row]; k < f.row_begin[row + 1]; ++k) {
        ASSERT_GT(f.value[k], 0);
        ASSERT_TRUE(k == f.row_begin[row] || f.source[k - 1] < f.source[k]);
      }
    }
    EXPECT_NEAR(sum, scene->patch_count(), 1e-4 * scene->patch_count()) << spec;
  }
}

TEST(Gather, IsReciprocalWithinNoise) {
  const auto scene = load_scene("cornell-box");
  constexpr int rays = 20000;
  const FormFactors f = gather_form_factors(*scene, {.rays_per_patch = rays});
  int pairs = 0;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    for (PatchId j = 0; j < i; ++j) {
      const double there = form_factor(f, i, j), back = form_factor(f, j, i);
      if (there == 0 && back == 0) {
        continue;
      }
      const double a = scene->patch(i).area, b = scene->patch(j).area;
      const double deviation =
          std::sqrt((a * a * there + b * b * back) / rays) + a / rays + b / rays;
      EXPECT_LT(std::abs(a * there - b * back), 4 * deviation) << i << " " << j;
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 50);
}

TEST(Gather, IsTheSameForAnyNumberOfThreads) {
  const auto scene = load_scene("rooms");
  const auto gather = [&](int threads, std::uint64_t seed) {
    return gather_form_factors(*scene, {.rays_per_patch = 200, .seed = seed, .threads = threads});
  };
  const FormFactors one = gather(1, 1);
  for (const int threads : {2, 7}) {
    const FormFactors other = gather(threads, 1);
    EXPECT_EQ(one.source, other.source);
    EXPECT_EQ(one.value, other.value);
    EXPECT_EQ(one.row_begin, other.row_begin);
  }
  EXPECT_NE(one.value, gather(1, 2).value);
}

TEST(Gather, CanBeCanceledAndRejectsBadOptions) {
  const auto scene = load_scene("furnace");
  for (const int rays : {0, -1, (1 << 24) + 1}) {
    EXPECT_THROW(gather_form_factors(*scene, {.rays_per_patch = rays}), InputError);
  }
  EXPECT_THROW(gather_form_factors(*scene, {.threads = -1}), InputError);
  Cancellation cancellation;
  cancellation.cancel();
  EXPECT_THROW(gather_form_factors(*scene, {}, cancellation), Canceled);
}

TEST(FormFactors, FromPassesGiveTheSolversRadiosity) {
  const auto scene = load_scene("cornell-box");
  for (const bool two_way : {true, false}) {
    RadiositySolver solver(
        scene, {.directions = 300, .two_way = two_way, .first_shot = {}, .tolerance = 1e-12});
    EXPECT_THROW(solver.form_factors(), std::runtime_error);
    solver.advance(RadiositySolver::Until::finished);
    const FormFactors f = solver.form_factors();
    const auto sums = solver.form_factor_sums();
    const auto b = solve_radiosity(*scene, f, 1e-12);
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_NEAR(row_sum(f, i), sums[k], 1e-12);
      EXPECT_NEAR(b[k].g, solver.radiosity()[k].g, 1e-9 * (1 + b[k].g));
    }
  }
  RadiositySolver forgetful(scene, {.directions = 10, .iterations = 1, .memory = 1});
  forgetful.advance(RadiositySolver::Until::finished);
  EXPECT_THROW(forgetful.form_factors(), std::runtime_error);
}

TEST(FormFactors, FromRaysGiveTheRadiosityFromPasses) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.02});
  const Solution passes = solve(scene, {.directions = 4000, .tolerance = 1e-9});
  const FormFactors f = gather_form_factors(*scene, {.rays_per_patch = 50000});
  const auto rays = solve_radiosity(*scene, f, 1e-9);
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    error += std::pow(rays[i].g - passes.radiosity[i].g, 2);
    norm += std::pow(passes.radiosity[i].g, 2);
  }
  // Measured: 1.1e-2, 2.2e-3 and 6.5e-4 with 2,000, 20,000 and 80,000 rays.
  EXPECT_LT(std::sqrt(error / norm), 1.5e-3);
}

TEST(FormFactors, ThatDoNotContractAreReported) {
  const auto scene = load_scene("furnace");
  FormFactors f = gather_form_factors(*scene, {.rays_per_patch = 100});
  for (double& value : f.value) {
    value *= 3;
  }
  EXPECT_THROW(solve_radiosity(*scene, f, 1e-6), std::runtime_error);
}

}  // namespace
}  // namespace transillum::form_factors_test
