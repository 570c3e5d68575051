// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Why a solve to an accuracy ends before it is reached, by results of stages that are made up.
// (First shots that are not as accurate: SurfaceAccuracy.)
#include "session/accuracy_plan.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "transillum/at.h"

namespace transillum::accuracy_plan_test {
namespace {

/// A plan, and what its stages tell it.
class PlannedSolve {
 public:
  explicit PlannedSolve(const AccuracyGoal& goal)
      : options_{.goal = goal}, plan_(options_, *scene_), b_(scene_->patches().size()) {
    error_.replicas = plan_.stage().replicas;
    error_.quantile = 3.18;
    error_.standard_error.resize(b_.size());
    error_.mean_reflected = {1, 1, 1};
    statistics_.rho_max = 0.5;
    statistics_.light_directions = 1000;
  }
  /// Ends a stage with an error.
  AccuracyPlan::Next end_stage(double error) {
    error_.replicas = plan_.stage().replicas;
    error_.rms_limit = error;
    statistics_.passes_made = plan_.stage().directions;
    return plan_.next({*scene_, plan_.stage(), b_, statistics_, error_}, 0.1);
  }
  /// No direction has met light, and all replicas agree.
  void meet_no_light() {
    error_.mean_reflected = {};
    statistics_.light_directions = 0;
  }
  const AccuracyReport& report() const { return plan_.report(); }
  int directions() const { return plan_.stage().directions; }

 private:
  std::shared_ptr<const Scene> scene_ = load_scene("rooms");
  SolveOptions options_;
  AccuracyPlan plan_;
  std::vector<Rgb> b_;
  SolveStatistics statistics_;
  ErrorEstimate error_;
};

AccuracyGoal one_percent_rms() {
  AccuracyGoal goal = accuracy_of_from_name("rms");
  goal.accuracy = 0.01;
  return goal;
}

TEST(AccuracyPlan, EndsWithoutAnObstacleWhereTheGoalIsReached) {
  PlannedSolve solve(one_percent_rms());
  EXPECT_EQ(solve.end_stage(0.1), AccuracyPlan::Next::stage);
  EXPECT_EQ(solve.end_stage(0.009), AccuracyPlan::Next::done);
  EXPECT_TRUE(solve.report().reached);
  EXPECT_EQ(solve.report().obstacle, AccuracyObstacle::none);
}

/// Twice or eight times as many directions may show the same error by chance.
TEST(AccuracyPlan, StallsWhereSixteenTimesTheDirectionsDoNotHelp) {
  PlannedSolve solve(one_percent_rms());
  const int first = solve.directions();
  int last = first;
  while (last < 16 * first) {
    ASSERT_EQ(solve.report().obstacle, AccuracyObstacle::none);
    ASSERT_EQ(solve.end_stage(0.5), AccuracyPlan::Next::stage);
    last = solve.directions();
  }
  EXPECT_EQ(solve.end_stage(0.46), AccuracyPlan::Next::done);
  EXPECT_FALSE(solve.report().reached);
  EXPECT_EQ(solve.report().obstacle, AccuracyObstacle::stalled);
}

TEST(AccuracyPlan, ContinuesWhereSixteenTimesTheDirectionsHelp) {
  PlannedSolve solve(one_percent_rms());
  const int first = solve.directions();
  while (solve.directions() < 16 * first) {
    ASSERT_EQ(solve.end_stage(0.5), AccuracyPlan::Next::stage);
  }
  EXPECT_EQ(solve.end_stage(0.44), AccuracyPlan::Next::stage);
}

TEST(AccuracyPlan, FindsNoLightWhereAllReplicasAreDark) {
  PlannedSolve solve(one_percent_rms());
  solve.meet_no_light();
  EXPECT_EQ(solve.end_stage(0), AccuracyPlan::Next::done);
  EXPECT_FALSE(solve.report().reached);
  EXPECT_FALSE(solve.report().trusted);
  EXPECT_EQ(solve.report().obstacle, AccuracyObstacle::no_light);
}

/// The error falls by half at each stage: too little for the goal, too much to stall.
TEST(AccuracyPlan, EndsWithTheLargestNumberOfDirections) {
  AccuracyGoal goal = one_percent_rms();
  goal.accuracy = 1e-12;
  PlannedSolve solve(goal);
  double error = 0.5;
  int stages = 0;
  while (solve.end_stage(error) != AccuracyPlan::Next::done) {
    ASSERT_LT(++stages, 100);
    error *= 0.5;
  }
  EXPECT_EQ(solve.report().obstacle, AccuracyObstacle::directions);
  EXPECT_GT(solve.directions(), max_directions / 2);
  EXPECT_LE(solve.directions(), max_directions);
}

TEST(AccuracyPlan, EndsWithThePassesOfTheGoal) {
  AccuracyGoal goal = one_percent_rms();
  goal.passes = 300;
  PlannedSolve solve(goal);
  const int first = solve.directions();
  while (solve.end_stage(0.5) != AccuracyPlan::Next::done) {
    ASSERT_LE(solve.report().passes_made, 300);
  }
  EXPECT_LE(solve.report().passes_made, 300);
  EXPECT_GT(solve.directions(), first);
  EXPECT_EQ(solve.report().obstacle, AccuracyObstacle::passes);
}

/// A stage takes 0.1 s: the time is over, or leaves none for a larger stage.
TEST(AccuracyPlan, EndsWithItsTime) {
  for (const double seconds : {0.05, 0.15}) {
    AccuracyGoal goal = one_percent_rms();
    goal.seconds = seconds;
    PlannedSolve solve(goal);
    ASSERT_EQ(solve.end_stage(0.5), AccuracyPlan::Next::done) << seconds;
    EXPECT_EQ(solve.report().obstacle, AccuracyObstacle::seconds);
  }
}

}  // namespace
}  // namespace transillum::accuracy_plan_test
