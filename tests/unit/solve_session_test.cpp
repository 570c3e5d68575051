// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A session advanced in any steps, paused or prepared again gives the bits of one call.
#include "transillum/solve_session.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "session/divisions.h"
#include "transillum/errors.h"

namespace transillum::solve_session_test {
namespace {

using Until = SolveSession::Until;

std::shared_ptr<const Scene> box() { return load_scene("cornell-box"); }

/// A box of which one wall has a lobe.
std::shared_ptr<const Scene> box_with_a_lobe() {
  SceneDescription description = describe_scene("cornell-box");
  Material& material = description.materials.back();
  material.reflectance = {0.3, 0.3, 0.3};
  material.lobe.reflectance = {0.4, 0.4, 0.4};
  material.lobe.exponent = 5;
  return std::make_shared<const Scene>(description);
}

struct Case {
  const char* name;
  SolveRequest request;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"plain", {.scene = box(), .options = {.directions = 24}}});
  all.push_back({"accuracy", {.scene = box()}});
  all.back().request.options.goal.accuracy = 0.05;
  all.push_back({"rounds",
                 {.scene = box(),
                  .options = {.directions = 16},
                  .refine = RefineOptions{.by = RefineBy::jump, .patches = 80}}});
  all.push_back({"rounds by error with an accuracy",
                 {.scene = box(), .refine = RefineOptions{.by = RefineBy::error, .patches = 60}}});
  all.back().request.options.goal.accuracy = 0.02;
  all.push_back({"lobes", {.scene = box_with_a_lobe(), .options = {.directions = 24}}});
  all.back().request.options.glossy = true;
  return all;
}

Solution solved(const SolveRequest& request) {
  SolveSession session(request);
  EXPECT_FALSE(session.advance(Until::finished));
  return session.solution();
}

void expect_same_light(const Solution& a, const Solution& b) {
  EXPECT_EQ(a.radiosity, b.radiosity);
  EXPECT_EQ(a.irradiance, b.irradiance);
  EXPECT_EQ(a.error.rms_limit, b.error.rms_limit);
}

void expect_same(const Solution& a, const Solution& b) {
  expect_same_light(a, b);
  EXPECT_EQ(a.complete, b.complete);
  EXPECT_EQ(a.scene->patch_count(), b.scene->patch_count());
  EXPECT_EQ(a.statistics.refinement.size(), b.statistics.refinement.size());
  ASSERT_EQ(a.accuracy.has_value(), b.accuracy.has_value());
  if (a.accuracy) {
    EXPECT_EQ(a.accuracy->stages.size(), b.accuracy->stages.size());
    EXPECT_EQ(a.accuracy->passes_made, b.accuracy->passes_made);
  }
}

TEST(SolveSession, InAnyStepsHasTheBitsOfOneCall) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const Solution whole = solved(one.request);
    EXPECT_TRUE(whole.complete);
    for (const Until until : {Until::direction, Until::iteration, Until::stage}) {
      SolveSession session(one.request);
      while (session.advance(until)) {
      }
      EXPECT_TRUE(session.finished());
      expect_same(session.solution(), whole);
    }
  }
}

TEST(SolveSession, PausedByItsObserverGoesOnToTheSameBits) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    SolveSession session(one.request);
    int calls = 0;
    while (session.advance(Until::finished, [&](const SolveSession& watched) {
      EXPECT_TRUE(watched.is_prepared());
      return ++calls % 7 != 0;
    })) {
    }
    EXPECT_GT(calls, 7);
    expect_same(session.solution(), solved(one.request));
  }
}

TEST(SolveSession, IsWhatSolveAndRefineDo) {
  const std::vector<Case> all = cases();
  expect_same(solve(all[0].request.scene, all[0].request.options), solved(all[0].request));
  expect_same(solve(all[1].request.scene, all[1].request.options), solved(all[1].request));
  expect_same(solve(all[4].request.scene, all[4].request.options), solved(all[4].request));
  const SolveRequest& rounds = all[2].request;
  const Refinement refined = refine(rounds.scene, rounds.options, *rounds.refine);
  EXPECT_EQ(solve(refined.scene, rounds.options).radiosity, solved(rounds).radiosity);
  EXPECT_EQ(refined.rounds.size(), solved(rounds).statistics.refinement.size());
}

TEST(SolveSession, StopsAfterAnExactNumberOfPassesOfTheLastRound) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    SolveSession session(one.request);
    for (const std::int64_t passes : {3, 4, 11}) {
      EXPECT_TRUE(session.advance_to(passes));
      EXPECT_FALSE(session.in_rounds());
      EXPECT_EQ(session.passes_done(), passes);
    }
    session.advance(Until::finished);
    expect_same(session.solution(), solved(one.request));
  }
}

/// The first preparation is canceled in the middle; a session that is prepared twice makes nothing
/// twice.
TEST(SolveSession, MayBePreparedAgain) {
  SolveRequest request{.scene = box(), .options = {.directions = 24}};
  int begun = 0;
  bool fails = true;
  request.preparing = [&](Preparation preparation, double fraction) {
    begun += preparation == Preparation::tree && fraction == 0 ? 1 : 0;
    if (fails) {
      throw std::runtime_error("no");
    }
  };
  SolveSession session(request);
  EXPECT_THROW(session.prepare(), std::runtime_error);
  EXPECT_FALSE(session.is_prepared());
  EXPECT_FALSE(session.has_result());
  fails = false;
  session.prepare();
  const auto tree = session.tree();
  const int before = begun;
  session.prepare();
  EXPECT_EQ(begun, before);
  EXPECT_EQ(session.tree(), tree);
  session.advance(Until::finished);
  request.preparing = {};
  expect_same(session.solution(), solved(request));
}

/// A session that a time limit ends in the middle of a stage has the result of the previous stage.
TEST(SolveSession, EndsWithTheTimeInTheMiddleOfAStage) {
  SolveRequest request{.scene = box()};
  request.options.goal.seconds = 1e-6;
  SolveSession session(request);
  // The plan always makes a first stage, and no other stage within this time.
  EXPECT_FALSE(session.advance(Until::finished));
  const Solution solution = session.solution();
  EXPECT_TRUE(solution.complete);
  EXPECT_EQ(solution.accuracy->stages.size(), 1U);
  EXPECT_EQ(solution.statistics.passes, solution.accuracy->stages.back().directions);
}

TEST(SolveSession, ShowsItsRoundsAndStages) {
  SolveRequest request = cases()[3].request;
  SolveSession session(request);
  std::size_t stages = 0, rounds = 0;
  while (session.in_rounds()) {
    const auto scene = session.scene();
    session.advance(Until::stage);
    if (session.rounds().size() > rounds) {
      rounds = session.rounds().size();
      EXPECT_NE(session.scene(), scene);
      EXPECT_TRUE(session.accuracy()->stages.empty());  // stages of the next round
    } else {
      EXPECT_EQ(session.scene(), scene);
      EXPECT_GT(session.accuracy()->stages.size(), 0U);
    }
    ++stages;
  }
  EXPECT_GT(rounds, 0U);
  EXPECT_GT(stages, rounds);
  EXPECT_EQ(session.scene(), session.refined_scene());
}

/// The corners of all patches, in order.
std::vector<Vec3> corners_of(const Scene& scene) {
  std::vector<Vec3> corners;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      corners.push_back(scene.point(p));
    }
  }
  return corners;
}

TEST(SolveSession, NamesTheDivisionsOfItsRounds) {
  for (const std::size_t k : {2U, 3U}) {
    const SolveRequest request = cases()[k].request;
    SolveSession session(request);
    while (session.in_rounds()) {
      const auto again = divided_scene(request.scene, session.divisions());
      EXPECT_EQ(corners_of(*again), corners_of(*session.scene()));
      session.advance(Until::stage);
    }
    session.advance(Until::finished);
    EXPECT_GT(session.divisions().size(), 0U);
    const auto again = divided_scene(request.scene, session.divisions());
    EXPECT_GT(again->patch_count(), request.scene->patch_count());
    expect_same_light(solve(again, request.options), session.solution());
  }
}

TEST(SolveSession, RelightsSolvesWithLobesOnly) {
  SolveSession diffuse(cases()[0].request);
  diffuse.prepare();
  EXPECT_THROW(diffuse.relight(diffuse.scene()->materials()), std::logic_error);
  SolveSession session(cases()[4].request);
  session.advance(Until::finished);
  const std::vector<Rgb> before = session.radiosity();
  std::vector<Material> materials = session.scene()->materials();
  for (Material& material : materials) {
    material.exitance = 2 * material.exitance;
  }
  session.relight(materials);
  EXPECT_FALSE(session.finished());
  session.advance(Until::finished);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(session.radiosity()[i].g, 2 * before[i].g, 1e-4 * before[i].g + 1e-9);
  }
}

TEST(SolveSession, RefusesWhatHasNoPasses) {
  EXPECT_THROW(SolveSession({.scene = box(), .options = {.engine = Engine::pairs}}), InputError);
  EXPECT_THROW(SolveSession({.scene = box(), .options = {.directions = 0}}), InputError);
}

}  // namespace
}  // namespace transillum::solve_session_test
