// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first shot of solves with lobes, which reflect its light by the direction from which it comes
// (ALGORITHM.md, oracle 6c).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/glossy_scenes.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/first_shot.h"
#include "transillum/glossy.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::glossy_first_shot_test {
namespace {

using testing::box_scene;
using testing::box_with_weak_lobes;
using testing::glossy_box;
using testing::glossy_box_description;
using testing::glossy_options;
using testing::largest_difference;
using testing::phong;
using testing::relative_error;

constexpr double pi = std::numbers::pi;

/// All sources are shot.
SolveOptions shot_options(int directions) {
  SolveOptions options = glossy_options(directions);
  options.first_shot = 0;
  return options;
}

/// A room of 2 m with a lamp of 10 cm below the ceiling; the floor has a lobe.
std::shared_ptr<const Scene> room_with_small_lamp() {
  testing::Sketch sketch("small lamp");
  const int walls = sketch.material(0.5, 0), lamp = sketch.material(0, 1000);
  const int floor = sketch.material(0.2, 0);
  sketch.box({0, 0, 0}, {2, 2, 2}, true, walls);
  sketch.face({{0.7, 0.8, 1.9}, {0.7, 0.9, 1.9}, {0.8, 0.9, 1.9}, {0.8, 0.8, 1.9}}, lamp);
  sketch.box({1.2, 0.5, 0}, {1.6, 0.9, 0.7}, false, floor);
  SceneDescription description = sketch.description();
  at(description.materials, floor).lobe = phong(0.6, 6);
  return std::make_shared<const Scene>(description, SceneOptions{.max_patch_area = 0.7});
}

/// Lobes that reflect next to nothing.
TEST(GlossyFirstShot, WeakLobesGiveTheDiffuseSolution) {
  const auto plain = box_scene([](std::size_t, Material&) {}), weak = box_with_weak_lobes();
  const Solution diffuse = solve(plain, shot_options(48)), glossy = solve(weak, shot_options(48));
  ASSERT_NE(glossy.glossy, nullptr);
  ASSERT_GT(glossy.statistics.shot_sources, 0);
  EXPECT_EQ(glossy.statistics.shot_sources, diffuse.statistics.shot_sources);
  EXPECT_EQ(glossy.statistics.shot_power_fraction, 1);
  EXPECT_EQ(glossy.statistics.light_directions, 0);
  EXPECT_LE(largest_difference(glossy.radiosity, diffuse.radiosity), 1e-12);
  EXPECT_LE(largest_difference(glossy.irradiance, diffuse.irradiance), 1e-12);
  EXPECT_NEAR(glossy.statistics.energy_balance, diffuse.statistics.energy_balance, 1e-12);
  EXPECT_NEAR(glossy.statistics.shot_disagreement, diffuse.statistics.shot_disagreement, 1e-12);
  for (PatchId i = 0; i < plain->patch_count(); ++i) {
    const Vec3 toward = plain->patch(i).normal;
    EXPECT_NEAR(glossy.glossy->radiance(i, toward).r, at(diffuse.radiosity, i).r / pi, 1e-12);
  }
}

/// A patch reflects its fraction of the light of the shot, whatever the set: received is sent.
TEST(GlossyFirstShot, KeepsEnergy) {
  for (const int directions : {16, 128}) {
    SolveOptions options = shot_options(directions);
    options.replicas = 2;
    const Solution solution = solve(glossy_box(), options);
    ASSERT_GT(solution.statistics.shot_sources, 0);
    EXPECT_LE(solution.statistics.energy_defect, 1e-13);
    EXPECT_NEAR(solution.statistics.energy_balance, 1, directions < 100 ? 0.05 : 0.01);
    EXPECT_LT(solution.statistics.shot_disagreement, 1);
    EXPECT_TRUE(solution.statistics.converged);
  }
}

/// E = 1 and rho + k = 0.5 everywhere: B = 2. All light but the reflected one is shot; lobes send
/// it on evenly within the error of the set.
TEST(GlossyFirstShot, FurnaceHasTheSameRadiosityEverywhere) {
  const auto scene = box_scene([](std::size_t f, Material& m) {
    m.exitance = {1, 1, 1};
    m.reflectance = f % 2 == 0 ? Rgb{0.2, 0.2, 0.2} : Rgb{0.5, 0.5, 0.5};
    m.lobe = phong(f % 2 == 0 ? 0.3 : 0.0, 6);
  });
  SolveOptions options = shot_options(128);
  options.normalize = Normalization::rows;
  const Solution solution = solve(scene, options);
  ASSERT_EQ(solution.statistics.shot_sources, scene->patch_count());
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_NEAR(at(solution.radiosity, i).r, 2, 0.01) << i;
    EXPECT_NEAR(solution.glossy->radiance(i, scene->patch(i).normal).r, 2 / pi, 0.03) << i;
  }
}

TEST(GlossyFirstShot, BitsDependOnNoThreads) {
  SolveOptions options = shot_options(50);
  options.replicas = 2;
  options.threads = 1;
  const Solution one = solve(glossy_box(), options);
  options.threads = 3;
  const Solution more = solve(glossy_box(), options);
  EXPECT_EQ(more.radiosity, one.radiosity);
  EXPECT_EQ(more.error.standard_error, one.error.standard_error);
  const Vec3 eye{0.4, 0.3, 0.2};
  EXPECT_EQ(more.glossy->radiance_toward(eye), one.glossy->radiance_toward(eye));
}

/// Many directions without a shot give the same as few with it, within the error that these state,
/// and few without it do not.
TEST(GlossyFirstShot, AgreesWithManyDirections) {
  const auto scene = room_with_small_lamp();
  SolveOptions many = glossy_options(16384);
  many.tolerance = 1e-6;
  many.rotation = 5;
  const Solution truth = solve(scene, many);
  SolveOptions few = shot_options(1024);
  few.tolerance = 1e-6;
  few.replicas = 4;
  const Solution shot = solve(scene, few);
  EXPECT_EQ(shot.statistics.shot_sources, 1);
  EXPECT_LT(shot.statistics.shot_disagreement, 1);
  few.first_shot.reset();
  const Solution without = solve(scene, few);
  const double error = relative_error(*scene, shot.radiosity, truth.radiosity);
  RecordProperty("shot", std::to_string(error));
  RecordProperty("limit", std::to_string(shot.error.rms_limit));
  RecordProperty("without",
                 std::to_string(relative_error(*scene, without.radiosity, truth.radiosity)));
  // The directions of `truth` have an error of their own.
  EXPECT_LE(error, shot.error.rms_limit + 0.001);
  EXPECT_GT(relative_error(*scene, without.radiosity, truth.radiosity), 10 * error);
  // So does the radiance toward a point, which has the image of the lamp.
  const Vec3 eye{0.3, 0.4, 1.2};
  std::vector<Rgb> a = shot.glossy->radiance_toward(eye), b = truth.glossy->radiance_toward(eye);
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    if (max_abs(scene->exitance(i)) > 0) {
      EXPECT_NEAR(at(a, i).r, at(b, i).r, 1e-3 * at(b, i).r);
      at(a, i) = at(b, i) = {};
    }
  }
  RecordProperty("toward a point", std::to_string(largest_difference(a, b)));
  EXPECT_LE(largest_difference(a, b), 0.02);
}

/// The emission of a lamp changes, and patches get lobes that had none.
TEST(GlossyFirstShot, FollowsOtherMaterials) {
  const auto scene = glossy_box();
  GlossySolver solver(scene, shot_options(40));
  EXPECT_TRUE(solver.solve());
  const Solution first = solver.solution();
  std::vector<Material> other = scene->materials();
  for (Material& m : other) {
    m.exitance = 3 * m.exitance;
  }
  solver.set_materials(other);
  EXPECT_TRUE(solver.solve());
  EXPECT_EQ(solver.solution().statistics.passes_made, 40);
  std::vector<Rgb> dimmed;
  for (const Rgb& b : solver.solution().radiosity) {
    dimmed.push_back(1.0 / 3 * b);
  }
  EXPECT_LE(largest_difference(dimmed, first.radiosity), 1e-12);
  for (Material& m : other) {
    m.lobe = phong(0.2, 20);
  }
  solver.set_materials(other, {}, GlossySolver::Start::current);
  EXPECT_TRUE(solver.solve());
  SceneDescription description = glossy_box_description();
  for (Material& m : description.materials) {
    m.exitance = 3 * m.exitance;
    m.lobe = phong(0.2, 20);
  }
  const Solution direct = solve(std::make_shared<const Scene>(description), shot_options(40));
  EXPECT_LE(largest_difference(solver.solution().radiosity, direct.radiosity), 1e-11);
  solver.set_materials(scene->materials());
  EXPECT_TRUE(solver.solve());
  EXPECT_LE(largest_difference(solver.solution().radiosity, first.radiosity), 1e-12);
}

/// The pairs add up to the light of all sources.
TEST(GlossyFirstShot, PairsAddUpToTheShot) {
  const Scene scene(glossy_box_description());
  const std::vector<PatchId> sources = find_small_sources(scene, 0);
  const std::vector<PatchId> glossy = patches_with_lobes(scene);
  ASSERT_FALSE(sources.empty());
  ASSERT_FALSE(glossy.empty());
  const DirectLight light = shoot(scene, sources);
  std::vector<Rgb> sums(light.irradiance.size());
  PatchId last = 0;
  for (const DirectLight::Pair& pair : shoot_pairs(scene, sources, glossy, {.threads = 2})) {
    EXPECT_GE(pair.receiver, last);
    EXPECT_GT(pair.irradiance, 0);
    at(sums, pair.receiver) += pair.irradiance * scene.exitance(pair.source);
    last = pair.receiver;
  }
  for (const PatchId i : glossy) {
    EXPECT_NEAR(at(sums, i).r, at(light.irradiance, i).r, 1e-13 * max_abs(at(sums, i))) << i;
  }
}

}  // namespace
}  // namespace transillum::glossy_first_shot_test
