// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve that continues from any of its states has the bits of a solve that was not interrupted,
// and files that are not its checkpoint are refused.
#include "transillum/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "io/runs/study_checkpoint.h"
#include "session/total_plan.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace transillum::checkpoint_test {
namespace {

using test::refusal;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using Until = RadiositySolver::Until;

std::shared_ptr<const Scene> box() { return load_scene("cornell-box"); }

/// All results of a finished solve, except times.
void expect_same(const RadiositySolver& a, const RadiositySolver& b) {
  EXPECT_TRUE(a.radiosity() == b.radiosity());
  EXPECT_TRUE(a.irradiance() == b.irradiance());
  EXPECT_TRUE(a.sky_irradiance() == b.sky_irradiance());
  EXPECT_TRUE(a.error_estimate().standard_error == b.error_estimate().standard_error);
  EXPECT_EQ(a.error_estimate().rms_limit, b.error_estimate().rms_limit);
  EXPECT_EQ(a.form_factor_sums(), b.form_factor_sums());
  EXPECT_EQ(a.sky_fractions(), b.sky_fractions());
  EXPECT_EQ(a.back_seen_fractions(), b.back_seen_fractions());
  EXPECT_EQ(a.quadrature_errors(), b.quadrature_errors());
  const SolveStatistics s = a.statistics(), t = b.statistics();
  EXPECT_EQ(s.passes_made, t.passes_made);
  EXPECT_EQ(s.iterations, t.iterations);
  EXPECT_EQ(s.burn_in, t.burn_in);
  EXPECT_EQ(s.transfers, t.transfers);
  EXPECT_EQ(s.kept_form_factors, t.kept_form_factors);
  EXPECT_EQ(s.energy_defect, t.energy_defect);
  EXPECT_EQ(s.light_directions, t.light_directions);
  EXPECT_EQ(s.escaped, t.escaped);
  EXPECT_EQ(s.closure_defect_max, t.closure_defect_max);
  EXPECT_EQ(s.counts.cuts, t.counts.cuts);
  ASSERT_EQ(s.iteration_records.size(), t.iteration_records.size());
  for (std::size_t n = 0; n < s.iteration_records.size(); ++n) {
    EXPECT_EQ(s.iteration_records[n].change, t.iteration_records[n].change);
    EXPECT_EQ(s.iteration_records[n].remainder, t.iteration_records[n].remainder);
    EXPECT_EQ(s.iteration_records[n].error, t.iteration_records[n].error);
  }
  if (s.kept_form_factors) {
    EXPECT_EQ(a.form_factors().value, b.form_factors().value);
    EXPECT_EQ(a.form_factors().source, b.form_factors().source);
  }
}

/// Solves, keeps the state after every `every`-th pass or iteration, and continues from each of
/// them with another number of threads.
void expect_all_states_lead_to_the_same(const std::shared_ptr<const Scene>& scene,
                                        SolveOptions options, int every = 7) {
  options.threads = 2;
  std::vector<std::string> states;
  int events = 0;
  RadiositySolver whole(scene, options);
  whole.advance(Until::finished, [&](const RadiositySolver& watched) {
    if (events++ % every == 0 || watched.progress().direction == 0) {
      std::ostringstream out;
      watched.save(out);
      states.push_back(out.str());
    }
    return true;
  });
  ASSERT_GT(states.size(), 3u);
  for (std::size_t k = 0; k < states.size(); k += 1 + states.size() / 12) {
    SCOPED_TRACE(k);
    options.threads = static_cast<int>(1 + k % 3);
    RadiositySolver resumed(scene, options,
                            {.tree = whole.shared_tree(), .shot = whole.direct_light()});
    std::istringstream in(states[k]);
    resumed.restore(in, states[k].size());
    // The solve first advances by passes, like in a viewer.
    for (int pass = 0; pass < 3; ++pass) {
      resumed.advance(Until::direction);
    }
    resumed.advance(Until::finished);
    expect_same(whole, resumed);
  }
}

TEST(Checkpoint, EveryStateLeadsToTheSameBits) {
  expect_all_states_lead_to_the_same(box(), {.directions = 40});
  expect_all_states_lead_to_the_same(
      box(), {.directions = 40, .two_way = false, .normalize = Normalization::rows});
  expect_all_states_lead_to_the_same(box(), {.directions = 40, .first_shot = 0, .replicas = 4});
  expect_all_states_lead_to_the_same(
      load_scene("boards"),
      {.directions = 40, .engine = Engine::local, .sky = {.exitance = {10, 20, 30}}});
}

TEST(Checkpoint, EveryStateOfEverySchemeLeadsToTheSameBits) {
  expect_all_states_lead_to_the_same(box(), {.directions = 40, .scheme = Scheme::growing});
  expect_all_states_lead_to_the_same(box(), {.directions = 40,
                                             .normalize = Normalization::symmetric,
                                             .scheme = Scheme::conjugate_gradients});
  expect_all_states_lead_to_the_same(
      box(),
      {.directions = 5, .scheme = Scheme::semi_iterative, .replicas = 2, .averaged_iterations = 40},
      11);
  // Form factors are not kept: every iteration makes the passes again.
  expect_all_states_lead_to_the_same(box(), {.directions = 10, .tolerance = 1e-3, .memory = 1});
}

/// The sums exceed the memory limit in the middle: exactly when they do depends on what is stored.
TEST(Checkpoint, DropsSumsWhereTheUnbrokenSolveDoes) {
  SolveOptions options{.directions = 60, .tolerance = 1e-2};
  const auto scene = load_scene("cornell-box", SceneOptions{.max_patch_area = 0.05});
  RadiositySolver unlimited(scene, options);
  unlimited.advance(Until::iteration);
  options.memory = static_cast<std::uint64_t>(unlimited.statistics().form_factors) * 30;
  RadiositySolver limited(scene, options);
  limited.advance(Until::iteration);
  ASSERT_FALSE(limited.statistics().kept_form_factors);
  expect_all_states_lead_to_the_same(scene, options, 13);
}

TEST(Checkpoint, AddedReplicasGoOnToo) {
  SolveOptions options{.directions = 32, .normalize = Normalization::rows, .replicas = 4};
  options.sky.exitance = {5, 5, 5};
  const auto with_one_more = [&](bool interrupted) {
    RadiositySolver solver(box(), options);
    solver.advance(Until::finished);
    solver.add_replica();
    solver.advance(Until::direction);
    if (!interrupted) {
      solver.advance(Until::finished);
      return solver;
    }
    std::stringstream state;
    solver.save(state);
    RadiositySolver resumed(box(), options);
    resumed.restore(state, state.str().size());
    EXPECT_EQ(resumed.options().directions, 40);
    resumed.advance(Until::finished);
    return resumed;
  };
  expect_same(with_one_more(false), with_one_more(true));
}

/// A solve with a goal, interrupted after `events`, and continued from its file.
Solution interrupted_solve(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                           int events, const std::string& file) {
  int count = 0;
  Checkpoint checkpoint(file, *scene, options);
  solve(scene, options, [&](const SolveSession& session) {
    if (++count < events) {
      return true;
    }
    checkpoint.save(session);
    return false;
  });
  SolveSession resumed({.scene = scene, .options = options});
  checkpoint.resume(resumed);
  resumed.advance(SolveSession::Until::finished);
  return resumed.solution();
}

TEST(Checkpoint, AnAccuracyIsReachedByTheSameStages) {
  SolveOptions options;
  options.goal.accuracy = 0.05;
  const Solution whole = solve(box(), options);
  ASSERT_TRUE(whole.accuracy->reached);
  const TemporaryFolder folder;
  for (const int events : {1, 10, 24, 40, 90, 150}) {
    SCOPED_TRACE(events);
    const Solution resumed = interrupted_solve(box(), options, events, folder.path() / "a.tck");
    EXPECT_TRUE(whole.radiosity == resumed.radiosity);
    EXPECT_EQ(whole.accuracy->error, resumed.accuracy->error);
    EXPECT_EQ(whole.accuracy->passes_made, resumed.accuracy->passes_made);
    EXPECT_EQ(whole.accuracy->stages.size(), resumed.accuracy->stages.size());
    EXPECT_TRUE(resumed.complete);
  }
}

/// The first shot is refined where it is not accurate enough: a stage is made again.
TEST(Checkpoint, AnAccuracyThatRefinesTheFirstShotIsReachedByTheSameStages) {
  SolveOptions options{.first_shot = 0};
  options.goal.accuracy = 0.002;
  const auto scene = load_scene("rooms");
  const Solution whole = solve(scene, options);
  const auto& stages = whole.accuracy->stages;
  ASSERT_GE(stages.size(), 2U);
  ASSERT_EQ(stages[0].directions, stages[1].directions) << "the shot is to be refined";
  const TemporaryFolder folder;
  for (const int events : {2, 30, 150}) {
    SCOPED_TRACE(events);
    const Solution resumed = interrupted_solve(scene, options, events, folder.path() / "a.tck");
    EXPECT_TRUE(whole.radiosity == resumed.radiosity);
    EXPECT_EQ(whole.accuracy->error, resumed.accuracy->error);
    EXPECT_EQ(whole.accuracy->passes_made, resumed.accuracy->passes_made);
  }
}

/// A solve to a total error; where it is interrupted, it is continued from its file.
/// @param events of each stage after which it is interrupted; 0 disables that
TotalSolve total_solve(int events, const std::string& file) {
  SolveOptions options;
  options.goal.accuracy = 0.3;
  const TotalGoal goal{.total = options.goal.accuracy};
  const SolveRequest request{.scene = box(), .options = options};
  TotalPlan plan(request, goal);
  Checkpoint checkpoint(file, *request.scene, options, true);
  while (!plan.finished()) {
    SolveSession session(plan.stage());
    int count = 0;
    const bool paused = session.advance(SolveSession::Until::finished,
                                        [&](const SolveSession&) { return ++count != events; });
    if (paused) {
      std::stringstream state;
      plan.save(state);
      checkpoint.set_total_plan(state.str());
      checkpoint.save(session);
      std::istringstream saved(checkpoint.total_plan());
      plan = TotalPlan(request, goal);
      plan.restore(saved, saved.str().size());
      session = SolveSession(plan.stage());
      checkpoint.resume(session);
      session.advance(SolveSession::Until::finished);
    }
    plan.assess(session);
  }
  return plan.outcome();
}

TEST(Checkpoint, ATotalErrorIsReachedByTheSameStages) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "t.tck";
  const TotalSolve whole = total_solve(0, file);
  ASSERT_EQ(whole.end, TotalEnd::reached);
  ASSERT_GE(whole.stages.size(), 3U);
  for (const int events : {1, 30}) {
    SCOPED_TRACE(events);
    const TotalSolve resumed = total_solve(events, file);
    EXPECT_TRUE(whole.solve.solution.radiosity == resumed.solve.solution.radiosity);
    EXPECT_EQ(whole.report.total(), resumed.report.total());
    ASSERT_EQ(whole.stages.size(), resumed.stages.size());
    for (std::size_t k = 0; k < whole.stages.size(); ++k) {
      EXPECT_EQ(whole.stages[k].patches, resumed.stages[k].patches);
      EXPECT_EQ(whole.stages[k].surface, resumed.stages[k].surface);
      EXPECT_EQ(whole.stages[k].errors.total(), resumed.stages[k].errors.total());
    }
  }
}

/// A file with the state in the middle of a solve.
class CheckpointFile : public ::testing::Test {
 protected:
  CheckpointFile() {
    SolveSession session({.scene = scene_, .options = options_});
    for (int pass = 0; pass < 5; ++pass) {
      session.advance(SolveSession::Until::direction);
    }
    Checkpoint(file_, *scene_, options_).save(session);
    content_ = test::read_file(file_);
  }
  std::string refusal_of(const std::string& content) {
    test::write_text(file_, content);
    return refusal([&] { resume(scene_, options_); });
  }
  void resume(const std::shared_ptr<const Scene>& scene, const SolveOptions& options) const {
    SolveSession session({.scene = scene, .options = options});
    Checkpoint(file_, *scene, options).resume(session);
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.path() / "run.tck";
  std::shared_ptr<const Scene> scene_ = box();
  SolveOptions options_{.directions = 12};
  std::string content_;
};

TEST_F(CheckpointFile, IsRefusedWhereverItIsCutOff) {
  ASSERT_EQ(refusal_of(content_), "");
  for (std::size_t size = 0; size < content_.size(); size += 1 + content_.size() / 300) {
    EXPECT_THAT(refusal_of(content_.substr(0, size)), HasSubstr("run.tck: it is ")) << size;
  }
  EXPECT_THAT(refusal_of(content_ + "x"), HasSubstr("damaged or cut off"));
}

TEST_F(CheckpointFile, IsRefusedWhereverABitIsWrong) {
  std::mt19937 random(1);
  for (int k = 0; k < 400; ++k) {
    std::string changed = content_;
    changed[random() % changed.size()] ^= static_cast<char>(1u << (random() % 8));
    EXPECT_THAT(refusal_of(changed), HasSubstr("run.tck: it")) << k;
  }
}

TEST_F(CheckpointFile, IsRefusedByAnotherSolveWhichNamesTheDifference) {
  const auto refused = [this](const SolveOptions& o) {
    return refusal([&] { resume(scene_, o); });
  };
  const auto refused_scene = [this](const SceneDescription& d) {
    return refusal([&] { resume(std::make_shared<const Scene>(d), options_); });
  };
  SolveOptions other = options_;
  other.directions = 13;
  EXPECT_THAT(refused(other), HasSubstr("directions is 12 there and 13 here"));
  other = options_;
  other.engine = Engine::local;
  EXPECT_THAT(refused(other), HasSubstr("engine is \"fast\" there and \"local\" here"));
  other = options_;
  other.sky.exitance = {1, 1, 1};
  EXPECT_THAT(refused(other), HasSubstr("sky is not given there and 1 here"));
  other = options_;
  other.goal.accuracy = 0.1;
  EXPECT_THAT(refused(other), HasSubstr("accuracy is not given there and 0.1 here"));
  EXPECT_THAT(refusal([&] { Checkpoint(file_, *scene_, options_, true).total_plan(); }),
              HasSubstr("total is false there and true here"));
  EXPECT_THAT(refused_scene(describe_scene("furnace")),
              HasSubstr("of another scene: \"cornell-box\" has 27 patches, this one has"));
  SceneDescription description = describe_scene("cornell-box");
  description.materials.front().reflectance.r += 1e-9;
  EXPECT_THAT(refused_scene(description), HasSubstr("its reflectances or exitances differ"));
  description = describe_scene("cornell-box");
  description.points.front().x += 1e-9;
  EXPECT_THAT(refused_scene(description), HasSubstr("its polygons differ"));
  // Memory and threads may differ.
  other = options_;
  other.threads = 3;
  other.memory = 1u << 30;
  EXPECT_EQ(refused(other), "");
}

TEST_F(CheckpointFile, OfAnotherKindOrPlaceIsRefused) {
  EXPECT_THAT(refusal_of("face,patch\n0,0\n"), HasSubstr("it is not a checkpoint of transillum"));
  EXPECT_THAT(refusal_of("transillum checkpoint 9\n{}\n00000000"),
              HasSubstr("it is a checkpoint of another version of transillum"));
  file_ = folder_.path() / "none.tck";
  EXPECT_THAT(refusal([&] { resume(scene_, options_); }), HasSubstr("there is no such file"));
  file_ = folder_.path();
  EXPECT_THAT(refusal([&] { resume(scene_, options_); }), HasSubstr("not a regular file"));
}

/// A write that fails leaves the previous file.
TEST_F(CheckpointFile, StaysWhereItsSuccessorCannotBeWritten) {
  SolveSession session({.scene = scene_, .options = options_});
  session.advance(SolveSession::Until::direction);
  Checkpoint full("/dev/full", *scene_, options_);
  EXPECT_THROW(full.save(session), std::runtime_error);
  EXPECT_EQ(full.cost().times, 0);
  EXPECT_EQ(refusal([&] { resume(scene_, options_); }), "");
}

TEST_F(CheckpointFile, IsSavedWhenItIsDueAndSaysItsCost) {
  SolveSession session({.scene = scene_, .options = options_});
  session.prepare();
  Checkpoint checkpoint(folder_.path() / "due.tck", *scene_, options_);
  EXPECT_FALSE(checkpoint.save_if_due(session, 3600));
  EXPECT_TRUE(checkpoint.save_if_due(session, 0));
  EXPECT_TRUE(checkpoint.save_if_due(session, 0));
  EXPECT_EQ(checkpoint.cost().times, 2);
  EXPECT_GT(checkpoint.cost().seconds, 0);
  EXPECT_EQ(checkpoint.cost().bytes, std::filesystem::file_size(checkpoint.file()));
}

/// Points of a study that stopped after each of its points in turn.
TEST(StudyCheckpointFile, AStudyGoesOnAfterAnyPoint) {
  const auto scene = box();
  const auto tree = std::make_shared<const BspTree>(*scene);
  StudyOptions options;
  options.series = {{.sampling = Sampling::fibonacci},
                    {.sampling = Sampling::random, .normalize = Normalization::rows}};
  options.directions = {8, 32, 16};
  const SolveOptions reference_options = options.reference();
  const auto reference = solve_reference(scene, tree, reference_options);
  const TemporaryFolder folder;
  const std::string file = folder.path() / "study.tck";
  const StudyCheckpoint checkpoint(file, *scene, options, reference_options);
  std::vector<std::vector<StudyPoint>> stages;
  const Study whole = run_study(scene, tree, options, {reference}, [&](const StudyProgress& now) {
    if (now.points.size() > stages.size()) {
      stages.emplace_back(now.points.begin(), now.points.end());
    }
  });
  ASSERT_EQ(stages.size(), 6u);
  for (const std::vector<StudyPoint>& points : stages) {
    checkpoint.save(points);
    std::size_t solved = 0;
    const std::vector<StudyPoint> done = checkpoint.resume();
    const Study rest =
        run_study(scene, tree, options, {reference, done},
                  [&](const StudyProgress& now) { solved = now.points.size() - points.size(); });
    EXPECT_EQ(solved, 6 - points.size());
    ASSERT_EQ(rest.points.size(), whole.points.size());
    for (std::size_t k = 0; k < whole.points.size(); ++k) {
      EXPECT_EQ(rest.points[k].passes, whole.points[k].passes);
      EXPECT_EQ(rest.points[k].rms_error, whole.points[k].rms_error);
      EXPECT_EQ(rest.points[k].max_error, whole.points[k].max_error);
    }
  }
  StudyOptions other = options;
  other.rotations = 2;
  EXPECT_THAT(refusal([&] { StudyCheckpoint(file, *scene, other, reference_options).resume(); }),
              HasSubstr("rotations is 1 there and 2 here"));
  other = options;
  other.series.back().normalize = Normalization::none;
  EXPECT_THAT(refusal([&] { StudyCheckpoint(file, *scene, other, reference_options).resume(); }),
              HasSubstr("it is of a study with other options: series 2 is {"));
}

}  // namespace
}  // namespace transillum::checkpoint_test
