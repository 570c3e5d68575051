// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves to an accuracy: the goal is reached, the reported limits contain the true error about as
// often as stated, also when the solve stops by them, and little is wasted. Errors are computed
// here, against B by pairs of patches, without directions.
#include "session/accuracy_plan.h"
#include "transillum/solve_session.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/form_factor_solve.h"
#include "transillum/study.h"

namespace transillum::accuracy_test {
namespace {

using ScenePtr = std::shared_ptr<const Scene>;

ScenePtr box_in_a_room() {
  testing::Sketch sketch("box in a room");
  const int walls = sketch.material(0.6, 0), light = sketch.material(0, 10);
  sketch.box({0, 0, 0}, {4, 4, 3}, true, walls);
  sketch.box({1, 1, 0}, {2, 2.5, 1.2}, false, walls);
  sketch.face({{1, 1, 2.9}, {1, 3, 2.9}, {3, 3, 2.9}, {3, 1, 2.9}}, light);
  return sketch.scene({.max_patch_area = 0.5});
}

/// A room with a lamp, and apart from it a bright box of 10 cm in which light is reflected most
/// often: the light that the iteration omits in the box exceeds the light in the room.
ScenePtr bright_box_beside_a_room() {
  testing::Sketch sketch("bright box");
  const int lamp = sketch.material(0, 1), small_lamp = sketch.material(0, 1e6);
  sketch.box({0, 0, 0}, {4, 4, 3}, true, sketch.material(0.5, 0));
  sketch.face({{1, 1, 2.9}, {1, 3, 2.9}, {3, 3, 2.9}, {3, 1, 2.9}}, lamp);
  sketch.box({5, 0, 0}, {5.1, 0.1, 0.1}, true, sketch.material(0.95, 0));
  sketch.face({{5.02, 0.02, 0.09}, {5.02, 0.08, 0.09}, {5.08, 0.08, 0.09}, {5.08, 0.02, 0.09}},
              small_lamp);
  return sketch.scene({.max_patch_area = 1});
}

/// B of engine pairs.
std::vector<Rgb> truth_by_pairs(const ScenePtr& scene, int points) {
  SolveOptions options{.engine = Engine::pairs, .tolerance = 1e-10};
  options.engine_options.points = points;
  return solve_by_form_factors(scene, options).radiosity;
}

/// The RMS of the error of B divided by the RMS of B - E, over channels and the patches that do not
/// emit; over all patches where all emit.
double error_of(const Scene& scene, const std::vector<Rgb>& b, const std::vector<Rgb>& truth) {
  double errors[2] = {}, values[2] = {};
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb off = at(b, i) - at(truth, i), reflected = at(truth, i) - scene.exitance(i);
    for (int all = max_abs(scene.exitance(i)) > 0 ? 1 : 0; all < 2; ++all) {
      errors[all] += off.r * off.r + off.g * off.g + off.b * off.b;
      values[all] +=
          reflected.r * reflected.r + reflected.g * reflected.g + reflected.b * reflected.b;
    }
  }
  const int all = values[0] > 0 ? 0 : 1;
  return std::sqrt(errors[all] / values[all]);
}

/// The fraction of this number of runs that is exceeded in 99 % of all cases, if each run holds in
/// 95 %.
double least_fraction(int runs) { return 0.95 - 2.33 * std::sqrt(0.95 * 0.05 / runs); }

/// Fractions of runs and of values.
struct Coverage {
  double limit = 0;      ///< runs whose RMS error is at most its limit
  double intervals = 0;  ///< values of B in their 95 % interval
  double above = 0;      ///< trusted runs whose RMS error is above the goal
  double passes = 0;     ///< mean over runs
};

/// Compares runs with a reference.
class CoverageCount {
 public:
  /// @param most the error by which two references, by pairs and by passes, may differ; if it is 0,
  /// the reference by passes is used
  CoverageCount(ScenePtr scene, const SolveOptions& options, int reference_passes, double most = 0)
      : scene_(std::move(scene)),
        tree_(std::make_shared<const BspTree>(*scene_)),
        options_(options) {
    SolveOptions reference = reference_options(reference_passes);
    reference.first_shot = options.first_shot;
    RadiositySolver solver(scene_, reference, {.tree = tree_});
    solver.advance(RadiositySolver::Until::finished);
    shot_ = solver.direct_light();
    truth_ = solver.radiosity();
    if (most > 0) {
      truth_ = truth_by_pairs(scene_, 64);
      EXPECT_LE(error_of(*scene_, solver.radiosity(), truth_), most);
    }
  }

  /// @param runs with different rotations; with a goal if it is set, else with the options'
  /// directions.
  Coverage of(int runs, const AccuracyGoal& goal) {
    Coverage coverage;
    for (int run = 0; run < runs; ++run) {
      SolveOptions options = options_;
      options.goal = goal;
      options.goal.of = AccuracyOf::rms;
      options.seed = 1000 * static_cast<std::uint64_t>(run + 1);
      const Solution solution = goal.is_set() ? solved_to_accuracy(options) : solved(options);
      const double error = error_of(*scene_, solution.radiosity, truth_);
      coverage.limit += (error <= solution.error.rms_limit) / double(runs);
      coverage.above +=
          (goal.is_set() && solution.accuracy->trusted && error > goal.accuracy) / double(runs);
      coverage.intervals += fraction_within(solution) / runs;
      coverage.passes +=
          double(goal.is_set() ? solution.accuracy->passes_made : options.directions) / runs;
    }
    return coverage;
  }

 private:
  Solution solved_to_accuracy(const SolveOptions& options) {
    SolveSession session({.scene = scene_, .options = options, .tree = tree_, .shot = shot_});
    session.advance(SolveSession::Until::finished);
    return session.solution();
  }
  Solution solved(const SolveOptions& options) {
    RadiositySolver solver(scene_, options, {.tree = tree_, .shot = shot_});
    solver.advance(RadiositySolver::Until::finished);
    return solver.solution();
  }

  /// Sources, whose B is E, have no error and do not count.
  double fraction_within(const Solution& solution) const {
    double within = 0, all = 0;
    const auto count = [&](double value, double truth, double standard_error) {
      if (standard_error > 1e-12 * std::abs(truth)) {
        all += 1;
        within += std::abs(value - truth) <= solution.error.quantile * standard_error;
      }
    };
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const Rgb &b = solution.radiosity[i], &t = truth_[i], &e = solution.error.standard_error[i];
      count(b.r, t.r, e.r);
      count(b.g, t.g, e.g);
      count(b.b, t.b, e.b);
    }
    return within / all;
  }

  ScenePtr scene_;
  std::shared_ptr<const BspTree> tree_;
  SolveOptions options_;
  std::shared_ptr<const DirectLight> shot_;
  std::vector<Rgb> truth_;
};

TEST(Accuracy, IsReachedAndReported) {
  const ScenePtr scene = box_in_a_room();
  SolveOptions options;
  options.goal.accuracy = 0.01;
  const Solution solution = solve(scene, options);
  ASSERT_TRUE(solution.accuracy);
  const AccuracyReport& report = *solution.accuracy;
  EXPECT_TRUE(solution.complete);
  EXPECT_TRUE(report.reached);
  EXPECT_LE(report.error, 0.01);
  EXPECT_EQ(report.error, solution.error.surfaces.limit);
  EXPECT_EQ(report.error, report.stages.back().error);
  EXPECT_EQ(solution.statistics.passes, report.stages.back().directions);
  EXPECT_GE(report.passes_made, report.stages.back().directions);
  EXPECT_LE(error_of(*scene, solution.radiosity, truth_by_pairs(scene, 64)), 0.01);
}

/// The changes of other channels, over what is just lit, made an RMS error of 39 %.
TEST(Accuracy, OfAChannelWithoutLightIsNoError) {
  testing::Sketch sketch("room");
  const int walls = sketch.material(0.6, 0), lamp = sketch.material(0, 1);
  sketch.box({0, 0, 0}, {4, 4, 3}, true, walls);
  sketch.face({{1, 1, 2.9}, {1, 3, 2.9}, {3, 3, 2.9}, {3, 1, 2.9}}, lamp);
  SceneDescription description = sketch.description();
  SolveOptions options{.directions = 128, .replicas = 4, .tolerance = 1e-4};
  std::vector<ErrorEstimate> errors;
  for (const Rgb& exitance : {Rgb{1, 1, 1}, Rgb{1, 1, 0}, Rgb{1, 1, 1e-9}}) {
    description.materials[static_cast<std::size_t>(lamp)].exitance = exitance;
    const auto scene =
        std::make_shared<const Scene>(description, SceneOptions{.max_patch_area = 0.5});
    errors.push_back(solve(scene, options).error);
  }
  EXPECT_GT(errors[0].rms, 0);
  for (const ErrorEstimate& error : errors) {
    EXPECT_NEAR(error.rms, errors[0].rms, 1e-12);
    EXPECT_NEAR(error.surfaces.limit, errors[0].surfaces.limit, 1e-9);
  }
}

/// The last stage is what `directions` and `replicas` give, if no replica was added.
TEST(Accuracy, ResultIsThatOfTheLastStageAlone) {
  const ScenePtr scene = box_in_a_room();
  SolveOptions options;
  options.goal.accuracy = 0.02;
  const Solution solution = solve(scene, options);
  SolveOptions alone;
  alone.directions = solution.accuracy->stages.back().directions;
  alone.replicas = solution.accuracy->stages.back().replicas;
  alone.tolerance = 1e-10;
  const Solution direct = solve(scene, alone);
  EXPECT_LT(radiosity_error(*scene, solution.radiosity, direct.radiosity).max, 1e-5);
}

TEST(Accuracy, OfThreadsDependsNothing) {
  SolveOptions options;
  options.goal.accuracy = 0.02;
  options.first_shot = first_shot_where_it_pays;
  options.threads = 1;
  const Solution one = solve(box_in_a_room(), options);
  options.threads = 3;
  const Solution three = solve(box_in_a_room(), options);
  EXPECT_EQ(one.radiosity, three.radiosity);
  EXPECT_EQ(one.accuracy->passes_made, three.accuracy->passes_made);
}

TEST(Accuracy, OfOtherErrors) {
  const ScenePtr scene = box_in_a_room();
  for (const char* name : {"rms", "max", "patch:3", "mean", "irradiance"}) {
    SolveOptions options;
    options.goal = accuracy_of_from_name(name);
    options.goal.accuracy = 0.01;
    const Solution solution = solve(scene, options);
    EXPECT_TRUE(solution.accuracy->reached) << name;
    EXPECT_LE(error_for(options.goal, *scene, solution.radiosity, solution.error), 0.01) << name;
  }
  SolveOptions options;
  options.goal = accuracy_of_from_name("patch:100000");
  options.goal.accuracy = 0.01;
  EXPECT_THROW(solve(scene, options), InputError);
}

/// The error of a patch in the room requires more iterations than the error of all patches. Once,
/// more and more passes were made instead: 3,768 for 744 %, then ten times as many.
TEST(Accuracy, OfADarkPatchAddsIterationsNotPasses) {
  const ScenePtr scene = bright_box_beside_a_room();
  SolveOptions options;
  options.goal = {.accuracy = 0.02, .of = AccuracyOf::patch, .patch = 0};
  const Solution solution = solve(scene, options);
  EXPECT_TRUE(solution.accuracy->reached);
  EXPECT_LE(solution.accuracy->passes_made, 2500);
  EXPECT_NEAR(solution.radiosity[0].r / truth_by_pairs(scene, 64)[0].r, 1, 0.02);
}

/// Hardly any direction brings the light of one star to another: all replicas miss this light in
/// the same way, and their spread does not show it. At most 40 % of the patches that emit had B in
/// their interval.
TEST(Accuracy, NamesPatchesWhoseErrorsCannotBeTrusted) {
  const ScenePtr scene = load_scene("stars:n=3");
  SolveOptions options{.directions = 4096, .first_shot = {}, .replicas = 8};
  const Solution solution = solve(scene, options);
  options.first_shot = 0;
  const Solution shot = solve(scene, options);
  EXPECT_TRUE(uncertain_patches(shot).empty());
  const std::vector<PatchId> uncertain = uncertain_patches(solution);
  // Fractions of the patches, named or not, whose B is outside of its interval.
  double outside[2] = {}, count[2] = {};
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const double error = max_abs(at(solution.radiosity, i) - at(shot.radiosity, i));
    const double interval = solution.error.quantile * max_abs(at(solution.error.standard_error, i));
    const int named = std::binary_search(uncertain.begin(), uncertain.end(), i) ? 1 : 0;
    if (interval > 0) {
      count[named] += 1;
      outside[named] += error > interval ? 1 : 0;
    }
  }
  EXPECT_GE(outside[1], 0.3 * count[1]) << count[1];
  EXPECT_LE(outside[0], 0.1 * count[0]) << count[0];
}

/// The scene has 96 small sources. When the measure contained E, 6 of 30 runs exceeded their limit,
/// 5 of them trusted.
TEST(Accuracy, OfStarsHoldsWhereItIsTrusted) {
  const ScenePtr scene = load_scene("stars");
  SolveOptions options{.directions = 2048, .first_shot = 0};
  const std::vector<Rgb> truth = solve(scene, options).radiosity;
  constexpr int runs = 30;
  int trusted = 0, held = 0;
  options = {};
  options.first_shot.reset();
  options.goal.accuracy = 0.05;
  options.goal.of = AccuracyOf::rms;
  for (int run = 0; run < runs; ++run) {
    options.seed = static_cast<std::uint64_t>(run + 1);
    const Solution solution = solve(scene, options);
    const double error = error_of(*scene, solution.radiosity, truth);
    trusted += solution.accuracy->trusted ? 1 : 0;
    held += solution.accuracy->trusted && error <= solution.error.rms_limit ? 1 : 0;
  }
  EXPECT_GE(trusted, runs / 2);
  EXPECT_GE(held, least_fraction(trusted) * trusted);
}

/// A time limit ends a solve that could continue; a solve that has reached its accuracy ends
/// before.
TEST(Accuracy, EndsWithTheTime) {
  SolveOptions options;
  options.goal.seconds = 0.5;
  const Solution solution = solve(box_in_a_room(), options);
  EXPECT_TRUE(solution.complete);
  EXPECT_FALSE(solution.accuracy->reached);
  EXPECT_GE(solution.accuracy->stages.size(), 1U);
  EXPECT_TRUE(std::isfinite(solution.accuracy->error));
}

TEST(Accuracy, IsRefusedWhereReplicasDoNotShowTheError) {
  SolveOptions options;
  options.goal.accuracy = 0.01;
  for (const auto& set :
       {+[](SolveOptions& o) { o.engine = Engine::zbuffer; },
        +[](SolveOptions& o) { o.scheme = Scheme::semi_iterative; },
        +[](SolveOptions& o) { o.iterations = 3; }, +[](SolveOptions& o) { o.goal.accuracy = 1; },
        +[](SolveOptions& o) { o.goal.seconds = -1; }}) {
    SolveOptions bad = options;
    set(bad);
    EXPECT_THROW(bad.validate(), InputError);
  }
}

/// A run with one replica added equals the run that had it from the start, up to the order of the
/// sums.
TEST(Accuracy, AddedReplicaIsAsOneFromTheStart) {
  const ScenePtr scene = box_in_a_room();
  std::vector<SolveOptions> all(3, {.directions = 64, .replicas = 4, .tolerance = 1e-12});
  all[1].scheme = Scheme::conjugate_gradients;
  all[2].normalize = Normalization::rows;
  all[2].sky.exitance = {1, 2, 3};
  for (SolveOptions options : all) {
    RadiositySolver solver(scene, options);
    EXPECT_THROW(solver.add_replica(), std::logic_error);
    solver.advance(RadiositySolver::Until::finished);
    solver.add_replica();
    EXPECT_EQ(solver.options().directions, 80);
    const std::size_t before = solver.statistics().iteration_records.size();
    EXPECT_TRUE(solver.advance(RadiositySolver::Until::iteration));
    // The change of such an iteration does not measure the contraction, so it does not bound the
    // remaining error.
    EXPECT_EQ(solver.statistics().iteration_records.at(before).contraction, 0);
    EXPECT_TRUE(std::isfinite(solver.error_estimate().rms));
    EXPECT_FALSE(solver.advance(RadiositySolver::Until::finished));
    EXPECT_EQ(solver.statistics().passes_made, 80);
    options.directions = 80;
    options.replicas = 5;
    const Solution whole = solve(scene, options);
    EXPECT_LT(radiosity_error(*scene, solver.radiosity(), whole.radiosity).max, 1e-10);
    EXPECT_NEAR(solver.error_estimate().rms / whole.error.rms, 1, 1e-6);
  }
}

/// A lamp of 4 cm in a room of 10 m: 64 directions meet it from hardly any patch.
TEST(Accuracy, IsNotTrustedWhereSourcesAreHardlyMet) {
  testing::Sketch sketch("small lamp");
  const int walls = sketch.material(0.5, 0), lamp = sketch.material(0, 1e4);
  sketch.box({0, 0, 0}, {10, 10, 10}, true, walls);
  sketch.box({5, 5, 5}, {5.04, 5.04, 5.04}, false, lamp);
  const ScenePtr scene = sketch.scene({.max_patch_area = 1});
  SolveOptions options{.directions = 64, .first_shot = {}, .replicas = 4};
  const Solution few = solve(scene, options);
  EXPECT_LT(few.statistics.light_directions / 4, least_light_directions);
  // If the lamp is shot first, the directions no longer matter.
  options.first_shot = first_shot_where_it_pays;
  const Solution shot = solve(scene, options);
  EXPECT_EQ(shot.statistics.shot_sources, 6);
  EXPECT_EQ(shot.statistics.light_directions, 0);
}

/// With few directions, B can grow without bound where hardly any light is absorbed.
TEST(Accuracy, IsReachedWhereFewDirectionsDiverge) {
  testing::Sketch sketch("bright room");
  const int walls = sketch.material(0.97, 0.1);
  sketch.box({0, 0, 0}, {1, 1, 1}, true, walls);
  const ScenePtr scene = sketch.scene({.max_patch_area = 0.3});
  SolveOptions options{.directions = 2, .replicas = 2};
  const auto diverges = [&] {
    try {
      solve(scene, options);
      return false;
    } catch (const NotConvergent&) {
      return true;
    }
  };
  while (!diverges()) {
    ASSERT_LT(++options.seed, 100U);
  }
  options.goal.accuracy = 0.05;
  const Solution solution = solve(scene, options);
  EXPECT_TRUE(solution.accuracy->reached);
  EXPECT_GE(solution.accuracy->stages.front().directions, 8);
  double mean = 0;
  for (const Rgb& b : solution.radiosity) {
    mean += b.r / static_cast<double>(solution.radiosity.size());
  }
  EXPECT_NEAR(mean, 0.1 / 0.03, 0.05 * 0.1 / 0.03);
}

TEST(Accuracy, IsCanceledAtOnce) {
  SolveOptions options;
  options.goal.accuracy = 1e-4;
  const Cancellation cancellation;
  int passes = 0;
  const auto observer = [&](const SolveSession&) {
    if (++passes == 40) {
      cancellation.cancel();
    }
    return true;
  };
  const Solution solution = solve(box_in_a_room(), options, observer, cancellation);
  EXPECT_FALSE(solution.complete);
  EXPECT_FALSE(solution.accuracy->reached);
  EXPECT_THROW(solve(box_in_a_room(), options, {}, cancellation), Canceled);
}

/// A first shot saves work for a ceiling lamp, but not where all walls emit.
TEST(Accuracy, FirstShotIsTakenWhereItPays) {
  const Scene box(describe_scene("cornell-box"), {.max_patch_area = 0.01});
  EXPECT_EQ(first_shot_sources(box, first_shot_where_it_pays, 128), find_small_sources(box, 0));
  EXPECT_TRUE(find_small_sources(box).empty());
  const Scene furnace(describe_scene("furnace"), {});
  EXPECT_TRUE(first_shot_sources(furnace, first_shot_where_it_pays, 128).empty());
  // Linear terms cost a shot more than passes, so it pays from more directions on.
  const auto least_directions = [&box](Basis basis) {
    int directions = 1;
    while (first_shot_sources(box, first_shot_where_it_pays, directions, basis).empty()) {
      ++directions;
    }
    return directions;
  };
  EXPECT_GT(least_directions(Basis::linear), 1.1 * least_directions(Basis::constant));
}

TEST(Accuracy, LimitsHoldAsOftenAsStated) {
  constexpr int runs = 60;
  CoverageCount count(box_in_a_room(), {.directions = 96, .first_shot = {}, .replicas = 4}, 8192,
                      1e-3);
  const Coverage fixed = count.of(runs, {});
  EXPECT_GE(fixed.limit, least_fraction(runs));
  EXPECT_GE(fixed.intervals, 0.91);  // decision 30: 92 % with 24 directions per replica
  EXPECT_LE(fixed.intervals, 0.98);
  // Stopping when the error looks small must not make it look smaller than it is.
  const Coverage stopped = count.of(runs, {.accuracy = 0.01});
  EXPECT_GE(stopped.limit, least_fraction(runs));
  EXPECT_GE(stopped.intervals, 0.91);
  EXPECT_LE(stopped.above, 1 - least_fraction(runs));
}

struct CoverageCase {
  const char* spec;
  double max_patch_area;  ///< m²; 0 for no limit
  double accuracy;
  bool shot;
};

/// The table of RESULTS.md: 60 runs by accuracy, and 60 of as many directions.
class NightlyAccuracy : public ::testing::TestWithParam<CoverageCase> {};
TEST_P(NightlyAccuracy, Coverage) {
  const CoverageCase& of = GetParam();
  const auto scene = load_scene(of.spec, {.max_patch_area = of.max_patch_area});
  SolveOptions options;
  if (!of.shot) {
    options.first_shot.reset();
  }
  CoverageCount count(scene, options, 8192);
  const Coverage stopped = count.of(60, {.accuracy = of.accuracy});
  options.replicas = 4;
  options.directions = 4 * static_cast<int>(stopped.passes / 5);  // about as many as in the last
                                                                  // stage
  const Coverage fixed = CoverageCount(scene, options, 8192).of(60, {});
  fmt::print(
      "{}{}, {} %: {:.0f} passes, limits {:.1f} % ({:.1f} % without stopping), intervals "
      "{:.1f} % ({:.1f} %)\n",
      of.spec, of.shot ? ", first shot" : "", 100 * of.accuracy, stopped.passes,
      100 * stopped.limit, 100 * fixed.limit, 100 * stopped.intervals, 100 * fixed.intervals);
  EXPECT_GE(stopped.intervals, 0.91);
  EXPECT_GE(fixed.intervals, 0.91);
  EXPECT_GE(stopped.limit, least_fraction(60));
}
INSTANTIATE_TEST_SUITE_P(EightScenes, NightlyAccuracy,
                         ::testing::Values(CoverageCase{"rooms", 0, 0.01, false},
                                           CoverageCase{"cornell-box", 0.01, 0.01, false},
                                           CoverageCase{"sphere-flake:levels=1", 0, 0.01, false},
                                           CoverageCase{"boards", 0, 0.01, false},
                                           CoverageCase{"furnace", 0.1, 0.005, false},
                                           CoverageCase{"rooms", 0, 0.0005, true},
                                           CoverageCase{"cornell-box", 0.01, 0.0005, true},
                                           CoverageCase{"boards", 0, 0.0005, true}));

}  // namespace
}  // namespace transillum::accuracy_test
