// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// RadiositySolver and solve(): stepping, pausing, cancellation, convergence, options.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include "support/refusal.h"
#include "support/scenes.h"
#include "support/stopping.h"
#include "transillum/errors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::radiosity_solver_test {
namespace {

using ::testing::HasSubstr;
using testing::Sketch;
using Until = RadiositySolver::Until;

std::shared_ptr<const Scene> small_scene() { return load_scene("furnace"); }

TEST(RadiositySolver, AdvancesByDirectionByIterationAndToTheEnd) {
  RadiositySolver solver(small_scene(), {.directions = 5, .tolerance = 1e-8});
  EXPECT_TRUE(solver.advance(Until::direction));
  EXPECT_EQ(solver.progress().direction, 1);
  EXPECT_EQ(solver.progress().iteration, 0);
  EXPECT_EQ(solver.estimate_changes().size(), 1u);
  EXPECT_TRUE(solver.advance(Until::iteration));
  EXPECT_EQ(solver.progress().direction, 0);
  EXPECT_EQ(solver.progress().iteration, 1);
  EXPECT_FALSE(solver.advance(Until::finished));
  EXPECT_TRUE(solver.progress().finished);
  EXPECT_FALSE(solver.advance(Until::finished));
  EXPECT_LE(solver.statistics().iteration_records.back().change, 1e-8);
}

TEST(RadiositySolver, SinglePassesAndAllAtOnceGiveTheSameBits) {
  const SolveOptions options{.directions = 9, .iterations = 3};
  RadiositySolver stepped(small_scene(), options);
  while (stepped.advance(Until::direction)) {
  }
  EXPECT_TRUE(stepped.radiosity() == solve(small_scene(), options).radiosity);
}

TEST(RadiositySolver, PausesWhenTheObserverReturnsFalse) {
  RadiositySolver solver(small_scene(), {.directions = 400, .threads = 2});
  int heard = 0;
  const bool more = solver.advance(Until::finished, [&](const RadiositySolver& s) {
    ++heard;
    EXPECT_EQ(s.progress().direction, heard);
    return heard < 10;
  });
  EXPECT_TRUE(more);
  // Only the passes that have begun are still added.
  EXPECT_GE(solver.progress().direction, 10);
  EXPECT_LE(solver.progress().direction, 10 + 4);
  const Solution whole = solve(small_scene(), {.directions = 400, .threads = 2});
  solver.advance(Until::finished);
  EXPECT_TRUE(solver.radiosity() == whole.radiosity);
}

TEST(RadiositySolver, ACanceledSolveReturnsTheEstimateSoFar) {
  const Cancellation cancellation;
  const Solution solution = solve(
      load_scene("rooms"), {.directions = 5000},
      [&](const SolveSession& s) {
        if (s.progress().direction >= 20) {
          cancellation.cancel();
        }
        return true;
      },
      cancellation);
  EXPECT_FALSE(solution.complete);
  EXPECT_EQ(solution.statistics.iterations, 0);
  double lit = 0;
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
    lit += max_abs(solution.radiosity[i] - solution.scene->exitance(static_cast<PatchId>(i)));
  }
  EXPECT_GT(lit, 0);
}

TEST(RadiositySolver, CancelingIsQuick) {
  const Cancellation cancellation;
  const auto scene = load_scene("sphere-flake");
  constexpr int threads = 2;
  RadiositySolver solver(scene, {.directions = 100000, .threads = threads}, {}, cancellation);
  const auto now = [] { return testing::cpu_seconds(CLOCK_PROCESS_CPUTIME_ID); };
  const double begin = now();
  solver.advance(Until::direction);
  const double pass = now() - begin;
  double canceled = 0;
  std::atomic<bool> passes_made = false;
  std::thread canceler([&] {
    passes_made.wait(false);
    canceled = now();
    cancellation.cancel();
  });
  // The thread cancels while further passes run.
  EXPECT_THROW(solver.advance(Until::finished,
                              [&](const RadiositySolver&) {
                                passes_made = true;
                                passes_made.notify_one();
                                return true;
                              }),
               Canceled);
  const double stopped = now();
  passes_made = true;
  passes_made.notify_one();
  canceler.join();
  // Each thread may take this time; sanitizers slow everything down in proportion.
  EXPECT_LT(stopped - canceled, threads * std::max(testing::longest_stop, 0.2 * pass));
}

TEST(RadiositySolver, GivesItsSolutionAtAnyTime) {
  RadiositySolver solver(small_scene(), {.directions = 20, .replicas = 2});
  solver.advance(RadiositySolver::Until::iteration);
  EXPECT_EQ(solver.solution().radiosity, solver.radiosity());
  EXPECT_EQ(solver.solution().irradiance, solver.irradiance());
  EXPECT_EQ(solver.solution().error.standard_error, solver.error_estimate().standard_error);
  EXPECT_EQ(solver.solution().statistics.iterations, 1);
  EXPECT_FALSE(solver.solution().complete);
  solver.advance(RadiositySolver::Until::finished);
  EXPECT_EQ(solver.solution().scene, solver.shared_scene());
  EXPECT_TRUE(solver.solution().complete);
}

TEST(RadiositySolver, ReportsTheChangeOfTheLastIteration) {
  RadiositySolver solver(small_scene(), {.directions = 20});
  EXPECT_EQ(solver.progress().change, 0);
  while (solver.advance(RadiositySolver::Until::iteration)) {
    EXPECT_GT(solver.progress().change, 0);
    EXPECT_EQ(solver.progress().change, solver.statistics().iteration_records.back().change);
  }
}

TEST(RadiositySolver, GivesTheRunningEstimateAsSolutionWithinAnIteration) {
  RadiositySolver solver(small_scene(), {.directions = 20});
  solver.advance(RadiositySolver::Until::direction);
  ASSERT_EQ(solver.progress().direction, 1);
  EXPECT_EQ(solver.solution().radiosity, solver.running_estimate());
  EXPECT_NE(solver.solution().radiosity, solver.radiosity());
  EXPECT_FALSE(solver.solution().complete);
}

TEST(RadiositySolver, ReportsDivergence) {
  // One direction down onto a highly reflective floor below a lamp: rows sum to 4.
  Sketch sketch;
  sketch.box({0, 0, 0}, {1, 1, 1}, true, sketch.material(0.99, 1));
  try {
    solve(sketch.scene(), {.directions = 1, .two_way = true});
    FAIL() << "converged";
  } catch (const NotConvergent& error) {
    EXPECT_THAT(error.what(), HasSubstr("does not converge"));
    EXPECT_EQ(error.remedy(), Remedy::directions_or_row_normalization);
  }
  EXPECT_NO_THROW(solve(sketch.scene(), {.directions = 1, .normalize = Normalization::rows}));
}

TEST(RadiositySolver, ADarkSceneConvergesImmediately) {
  Sketch sketch;
  sketch.box({0, 0, 0}, {1, 1, 1}, true, sketch.material(0.5, 0));
  const Solution solution = solve(sketch.scene(), {.directions = 8});
  EXPECT_TRUE(solution.complete);
  EXPECT_EQ(solution.statistics.iterations, 1);
  for (const Rgb& b : solution.radiosity) {
    EXPECT_EQ(max_abs(b), 0);
  }
}

/// Eq. 25: the contraction is at most rho_max times the largest row sum.
TEST(RadiositySolver, ContractsAsPredicted) {
  const Solution solution = solve(load_scene("furnace"), {.directions = 300, .tolerance = 1e-10});
  const double predicted = solution.statistics.predicted_contraction;
  EXPECT_GT(predicted, 0.5);
  EXPECT_LT(predicted, 0.55);
  for (std::size_t k = 1; k < solution.statistics.iteration_records.size(); ++k) {
    EXPECT_LE(solution.statistics.iteration_records[k].contraction, predicted);
  }
  EXPECT_LE(solution.statistics.iterations,
            static_cast<int>(std::ceil(std::log(1e-10) / std::log(predicted))) + 1);
}

/// For a box, eq. 17 is evaluated for the normals along the axes.
TEST(RadiositySolver, ReportsTheQuadratureErrorOfTheCosine) {
  RadiositySolver solver(load_scene("furnace"), {.directions = 30, .two_way = false});
  solver.advance(Until::iteration);
  const auto& errors = solver.quadrature_errors();
  ASSERT_EQ(errors.size(), 30u);
  for (std::size_t m = 1; m <= errors.size(); ++m) {
    double worst = 0;
    for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      for (const double sign : {1.0, -1.0}) {
        double sum = 0;
        for (std::size_t d = 0; d < m; ++d) {
          sum += std::max(0.0, sign * dot(n, solver.directions()[d]));
        }
        worst = std::max(worst, std::abs(4 * std::numbers::pi / static_cast<double>(m) * sum -
                                         std::numbers::pi));
      }
    }
    EXPECT_NEAR(errors[m - 1], worst, 1e-12);
  }
}

TEST(SolveOptions, ReportValuesOutOfRange) {
  const auto message = [](const SolveOptions& options) {
    return test::refusal([&] { options.validate(); });
  };
  EXPECT_THAT(message({.directions = 0}), HasSubstr("directions: \"0\""));
  EXPECT_THAT(message({.directions = -5}), HasSubstr("directions: \"-5\""));
  EXPECT_THAT(message({.iterations = -1}), HasSubstr("iterations: \"-1\""));
  EXPECT_THAT(message({.tolerance = 0}), HasSubstr("tolerance: \"0\""));
  EXPECT_THAT(message({.tolerance = std::nan("")}), HasSubstr("tolerance"));
  EXPECT_THAT(message({.threads = -1}), HasSubstr("threads: \"-1\""));
  EXPECT_EQ(message({}), "");
}

}  // namespace
}  // namespace transillum::radiosity_solver_test
