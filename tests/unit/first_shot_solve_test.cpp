// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Solves with a first shot of small sources.
#include <gmock/gmock.h>

#include <cmath>

#include "support/canceled.h"
#include "support/refusal.h"
#include "transillum/errors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::first_shot_solve_test {
namespace {

using ::testing::HasSubstr;

/// Relative RMS difference over patches that do not emit.
double error_of(const Solution& solution, const Solution& reference) {
  double error = 0, norm = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    if (max_abs(solution.scene->exitance(i)) > 0) {
      continue;
    }
    const auto k = static_cast<std::size_t>(i);
    error += std::pow(solution.radiosity[k].g - reference.radiosity[k].g, 2);
    norm += std::pow(reference.radiosity[k].g, 2);
  }
  return std::sqrt(error / norm);
}

TEST(FirstShot, RemovesTheErrorOfStars) {
  const auto scene = load_scene("stars");
  const Solution reference = solve(scene, {.directions = 8192, .first_shot = {}});
  const Solution plain = solve(scene, {.directions = 512, .first_shot = {}});
  const Solution shot = solve(scene, {.directions = 256, .first_shot = small_source_ratio});
  EXPECT_EQ(shot.statistics.shot_sources, 96);
  EXPECT_DOUBLE_EQ(shot.statistics.shot_power_fraction, 1);
  // The reference, of plain passes, still has an error of 1.8e-3.
  EXPECT_GT(error_of(plain, reference), 5 * error_of(shot, reference));
  const Solution finer = solve(scene, {.directions = 2048, .first_shot = small_source_ratio});
  EXPECT_LT(error_of(shot, finer), 1e-3);
  EXPECT_GT(error_of(plain, finer), 10 * error_of(shot, finer));
}

TEST(FirstShot, OfAllSourcesAgreesWithPlainPasses) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.03});
  const Solution plain = solve(scene, {.directions = 4000});
  const Solution shot = solve(scene, {.directions = 1000, .first_shot = 0});
  EXPECT_LT(error_of(shot, plain), 4e-3);
  EXPECT_NEAR(shot.statistics.energy_balance, 1, 2e-3);
  EXPECT_LT(shot.statistics.energy_defect, 1e-12);
}

TEST(FirstShot, LeavesTheFurnaceExact) {
  const Solution solution = solve(
      load_scene("furnace"), {.directions = 64, .normalize = Normalization::rows, .first_shot = 0});
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
    EXPECT_NEAR(solution.radiosity[i].g, 2, 1e-3) << i;
    EXPECT_NEAR(solution.irradiance[i].g, 2, 2e-3) << i;
  }
}

/// All replicas add the same shot, whose error does not show in their spread.
TEST(FirstShot, IsIncludedInTheErrorFromReplicas) {
  const Solution solution = solve(load_scene("furnace"), {.directions = 128,
                                                          .normalize = Normalization::rows,
                                                          .first_shot = 0,
                                                          .replicas = 8,
                                                          .tolerance = 1e-10});
  double largest = 0;
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
    const double off = std::abs(solution.radiosity[i].g - 2);
    EXPECT_LE(off, solution.error.quantile * solution.error.standard_error[i].g) << i;
    EXPECT_LT(solution.error.standard_error[i].g, 1e-2) << i;
    largest = std::max(largest, off);
  }
  EXPECT_GT(largest, 1e-6) << "there is an error to include";
}

TEST(FirstShot, DoesNotDependOnSchemeThreadsOrPauses) {
  const auto scene = load_scene("stars:n=2");
  SolveOptions options{.directions = 128, .tolerance = 1e-10};
  options.first_shot = small_source_ratio;
  const Solution fixed = solve(scene, options);
  options.threads = 3;
  EXPECT_TRUE(solve(scene, options).radiosity == fixed.radiosity);
  RadiositySolver stepped(scene, options);
  while (stepped.advance(RadiositySolver::Until::direction)) {
  }
  EXPECT_TRUE(stepped.radiosity() == fixed.radiosity);
  options.scheme = Scheme::conjugate_gradients;
  EXPECT_LT(error_of(solve(scene, options), fixed), 1e-5);
  options.normalize = Normalization::symmetric;
  options.scheme = Scheme::fixed;
  EXPECT_LT(error_of(solve(scene, options), fixed), 1e-2);
  options.replicas = 4;
  options.normalize = Normalization::none;
  const Solution replicas = solve(scene, options);
  EXPECT_LT(error_of(replicas, fixed), 1e-2);
  EXPECT_GT(replicas.error.rms, 0);
}

TEST(FirstShot, IsIncludedBeforeTheFirstPass) {
  const auto scene = load_scene("stars:n=2");
  SolveOptions options{.directions = 64};
  options.first_shot = small_source_ratio;
  const auto light = std::make_shared<const DirectLight>(shoot(*scene, find_small_sources(*scene)));
  const RadiositySolver solver(scene, options, {.shot = light});
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_TRUE(solver.irradiance()[k] == light->irradiance[k]);
    EXPECT_TRUE(solver.radiosity()[k] ==
                scene->exitance(i) + scene->reflectance(i) * light->irradiance[k]);
  }
  EXPECT_THROW(RadiositySolver(scene, options, {}, testing::canceled()), Canceled);
}

TEST(FirstShot, OptionsAreParsedAndChecked) {
  EXPECT_EQ(first_shot_from_name("none"), std::nullopt);
  EXPECT_EQ(first_shot_from_name("auto"), first_shot_where_it_pays);
  EXPECT_EQ(first_shot_from_name("2.5e3"), 2500.0);
  for (const char* name : {"", "-1", "nan", "inf", "12x", "Auto"}) {
    EXPECT_THAT(test::refusal([&] { first_shot_from_name(name); }),
                HasSubstr("is not none, auto or a number of at least 0"))
        << name;
  }
  SolveOptions options;
  options.first_shot = -2;
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace transillum::first_shot_solve_test
