// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first shot compared with the light that passes find from its sources: no false alarm on sound
// shots, and an alarm where light is missing.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::shot_check_test {
namespace {

using testing::Sketch;

/// One iteration with `light`, or with the scene's own shot.
SolveStatistics checked(const std::shared_ptr<const Scene>& scene, SolveOptions options,
                        std::shared_ptr<const DirectLight> light = nullptr) {
  options.first_shot = 0;
  options.iterations = 1;
  RadiositySolver solver(scene, options, {.shot = std::move(light)});
  solver.advance(RadiositySolver::Until::finished);
  return solver.statistics();
}

/// If all patches of a closed scene emit, the shot takes minutes.
constexpr std::size_t most_pairs = 40'000;

void expect_no_alarm(const std::string& name, const std::vector<int>& directions) {
  const auto scene = load_scene(name);
  const std::vector<PatchId> sources = find_small_sources(*scene, 0);
  if (sources.empty() || sources.size() * scene->patches().size() > most_pairs) {
    return;
  }
  const auto light = std::make_shared<const DirectLight>(shoot(*scene, sources));
  for (const int count : directions) {
    for (const Sampling sampling :
         {Sampling::antipodal, Sampling::hammersley, Sampling::sobol, Sampling::random}) {
      for (const bool two_way : {true, false}) {
        const SolveStatistics s = checked(
            scene, {.directions = count, .sampling = sampling, .rotation = 7, .two_way = two_way},
            light);
        EXPECT_LT(s.shot_disagreement, 1)
            << name << ", " << count << " directions, " << name_of(sampling) << ", patch "
            << s.shot_disagreement_patch;
        EXPECT_GT(s.shot_disagreement, 0) << name;
      }
    }
  }
}

TEST(ShotCheck, IsSilentOnSoundShots) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    expect_no_alarm(scene.name, {24, 200});
  }
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(TRANSILLUM_DATA_DIR) + "/scenes")) {
    if (file.path().extension() == ".obj") {
      expect_no_alarm(file.path().string(), {24, 200});
    }
  }
}

/// Patch 635 sees a lamp through a gap that one of these directions meets.
TEST(ShotCheck, IsSilentWhereADirectionMeetsANarrowGap) {
  const auto scene = load_scene("rooms:n=200");
  EXPECT_LT(checked(scene, {.directions = 300}).shot_disagreement, 1);
}

TEST(NightlyShotCheck, IsSilentOnSoundShotsForAnyNumberOfDirections) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    expect_no_alarm(scene.name, {1, 2, 6, 12, 48, 96, 512, 2048, 8192});
  }
  for (const char* folder : {"/scenes", "/corpus"}) {
    for (const auto& file :
         std::filesystem::directory_iterator(std::string(TRANSILLUM_DATA_DIR) + folder)) {
      if (file.path().extension() == ".obj") {
        expect_no_alarm(file.path().string(), {6, 96, 1024});
      }
    }
  }
}

/// A room with a lamp of four corners, one of them `bend` off its plane, and two bent shelves.
std::shared_ptr<const Scene> room(double bend) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0.5, 100);
  sketch.box({0, 0, 0}, {5, 4, 3}, true, gray);
  sketch.face(
      {{2.013, 2, 2.531}, {2.021, 2.31, 2.53}, {2.377, 2.31, 2.53}, {2.377, 2, 2.531 + bend}},
      lamp);
  sketch.face({{1.5, 1.2, 1}, {3.5, 1.2, 1}, {3.5, 2.9, 1}, {1.5, 2.9, 1 + bend}}, gray);
  return sketch.scene({.two_sided = true});
}

/// Most of the light is missing with few directions, a tenth with many, or the light of one patch
/// near the lamp.
TEST(ShotCheck, FindsMissingLight) {
  const auto scene = room(1e-7);
  const std::vector<PatchId> sources = find_small_sources(*scene, 0);
  const DirectLight sound = shoot(*scene, sources);
  for (const auto& [directions, left] : {std::pair{48, 0.3}, {2048, 0.9}}) {
    EXPECT_LT(checked(scene, {.directions = directions}, std::make_shared<DirectLight>(sound))
                  .shot_disagreement,
              1);
    auto lossy = std::make_shared<DirectLight>(sound);
    for (Rgb& irradiance : lossy->irradiance) {
      irradiance = left * irradiance;
    }
    const SolveStatistics s = checked(scene, {.directions = directions}, lossy);
    EXPECT_GT(s.shot_disagreement, 1) << directions;
  }
  auto one = std::make_shared<DirectLight>(sound);
  PatchId brightest = 0;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    brightest = sound.irradiance[static_cast<std::size_t>(i)].g > at(sound.irradiance, brightest).g
                    ? i
                    : brightest;
  }
  at(one->irradiance, brightest) = {};
  const SolveStatistics s = checked(scene, {.directions = 2048}, one);
  EXPECT_GT(s.shot_disagreement, 1);
  EXPECT_EQ(s.shot_disagreement_patch, brightest);
}

/// Two quads of which one hid itself: one of 24 directions meets both, which six deviations of its
/// light explain.
TEST(ShotCheck, FindsByOneDirectionThatAPatchGetsNothing) {
  Sketch sketch;
  sketch.face({{-.35, 1.04, 1.33}, {-.31, 1.042, 1.37}, {-.05, 1.042, 1.37}, {-.01, 1.04, 1.33}},
              sketch.material(0.5, 100));
  sketch.face({{-.17, 1.18, 1.45}, {-.17, 1.18, 1.43}, {-.17, 1.08, 1.43}, {-.17, 1.08, 1.45}},
              sketch.material(0.7, 0));
  const auto scene = sketch.scene();
  auto light = std::make_shared<DirectLight>(shoot(*scene, find_small_sources(*scene, 0)));
  EXPECT_LT(checked(scene, {.directions = 24}, light).shot_disagreement, 1);
  for (const double left : {1e-7, 0.0}) {
    light = std::make_shared<DirectLight>(*light);
    at(light->irradiance, 1) = left * at(light->irradiance, 1);
    const SolveStatistics s = checked(scene, {.directions = 24}, light);
    EXPECT_GT(s.shot_disagreement, 1) << left;
    EXPECT_EQ(s.shot_disagreement_patch, 1) << left;
  }
}

/// The fault for which the check was made: it found the bent lamp that hid itself.
TEST(ShotCheck, FindsThatABentLampHidesItself) {
  for (const double bend : {1e-6, 1e-7, 1e-8, -1e-7}) {
    const SolveStatistics s = checked(room(bend), {.directions = 96});
    EXPECT_LT(s.shot_disagreement, 1) << bend;
    EXPECT_EQ(s.shot_sources, 2);
  }
}

TEST(ShotCheck, LeavesOutInexactEngines) {
  const SolveStatistics s =
      checked(load_scene("cornell-box"), {.directions = 24, .engine = Engine::corrected});
  EXPECT_EQ(s.shot_disagreement, 0);
  EXPECT_EQ(s.shot_disagreement_patch, -1);
}

}  // namespace
}  // namespace transillum::shot_check_test
