// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves with lobes to an accuracy: which stages are made, and whether the goal is reached.
#include <gtest/gtest.h>

#include "support/glossy_scenes.h"
#include "support/scenes.h"
#include "transillum/accuracy_goal.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::glossy_accuracy_test {
namespace {

using testing::box_scene;
using testing::ggx;
using testing::glossy_box;
using testing::glossy_options;
using testing::relative_error;

/// All stages are new solves with as many replicas: none is added to a finished one. The first
/// resolves the lobes, whose largest exponent is 8.
TEST(GlossyAccuracy, IsReachedAndReported) {
  const auto scene = glossy_box();
  SolveOptions options = glossy_options(1);
  options.tolerance = 1e-6;
  options.goal.accuracy = 0.03;
  options.goal.of = AccuracyOf::rms;
  options.threads = 1;
  const Solution solution = solve(scene, options);
  ASSERT_NE(solution.glossy, nullptr);
  ASSERT_TRUE(solution.accuracy);
  const AccuracyReport& report = *solution.accuracy;
  EXPECT_TRUE(report.reached);
  EXPECT_TRUE(solution.complete);
  EXPECT_EQ(report.error, solution.error.rms_limit);
  EXPECT_EQ(report.stages.front().directions, 4 * 80);
  for (const AccuracyStage& stage : report.stages) {
    EXPECT_EQ(stage.replicas, 4);
  }
  SolveOptions many = glossy_options(2048);
  many.tolerance = 1e-8;
  const std::vector<Rgb> truth = solve(scene, many).radiosity;
  EXPECT_LE(relative_error(*scene, solution.radiosity, truth), 0.03);
  options.threads = 3;
  const Solution more = solve(scene, options);
  EXPECT_EQ(more.radiosity, solution.radiosity);
  EXPECT_EQ(more.accuracy->passes_made, report.passes_made);
}

/// A surface that reflects by its lobe only counts, and its errors too.
TEST(GlossyAccuracy, CountsMetals) {
  const auto scene = box_scene([](std::size_t, Material& material) {
    material.reflectance = {};
    material.lobe = ggx(0.6, 0.8);
  });
  SolveOptions options = glossy_options(128);
  options.replicas = 4;
  const ErrorEstimate error = solve(scene, options).error;
  double area = 0, measured = 0;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    measured += max_abs(scene->exitance(i)) == 0 ? scene->patch(i).area : 0.0;
  }
  for (const SurfaceError& surface : error.surfaces.surfaces) {
    area += surface.area;
    EXPECT_GT(surface.limit, 0);
  }
  EXPECT_NEAR(area, measured, 1e-9);
  EXPECT_GT(solve(scene, options).statistics.light_directions, 0);
}

TEST(GlossyAccuracy, EndsWithTheTime) {
  SolveOptions options = glossy_options(1);
  options.tolerance = 1e-4;
  options.goal.seconds = 0.2;
  const Solution solution = solve(glossy_box(), options);
  EXPECT_TRUE(solution.complete);
  EXPECT_FALSE(solution.accuracy->reached);
  EXPECT_GE(solution.accuracy->stages.size(), 1U);
  EXPECT_EQ(solution.accuracy->stages.front().directions, 4 * 4);
}

}  // namespace
}  // namespace transillum::glossy_accuracy_test
