// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Accuracy by surface: the claim about the worst surface holds as often as stated, for all surfaces
// together and also when the solve stops by it, and is not much larger than the error. Scenes are
// made to fool it. Errors are computed here, against B of many passes, which is compared with B by
// pairs of patches.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/form_factor_solve.h"
#include "transillum/solve_session.h"

namespace transillum::surface_accuracy_test {
namespace {

using ScenePtr = std::shared_ptr<const Scene>;

/// Rooms whose faces are in groups.
class Rooms {
 public:
  explicit Rooms(const std::string& name) { description_.name = name; }

  int material(double reflectance, double exitance = 0) {
    Material material;
    material.name = fmt::format("m{}", description_.materials.size());
    material.reflectance = {reflectance, reflectance, 0.5 * reflectance};
    material.exitance = {exitance, exitance, exitance};
    description_.materials.push_back(material);
    return static_cast<int>(description_.materials.size()) - 1;
  }
  void face(const std::string& group, int material, const std::vector<Vec3>& outline) {
    const auto [place, is_new] =
        groups_.try_emplace(group, static_cast<int>(description_.groups.size()));
    if (is_new) {
      description_.groups.push_back(group);
    }
    std::vector<PointId> corners;
    for (const Vec3& point : outline) {
      corners.push_back(static_cast<PointId>(description_.points.size()));
      description_.points.push_back(point);
    }
    description_.add_face(corners, material, 0, place->second);
  }
  /// A box; its sides are groups of their own if `inward`, and x = high is omitted if `open`.
  void box(const std::string& name, int material, const Vec3& a, const Vec3& b, bool inward,
           const std::string& omitted = {}) {
    const std::pair<const char*, std::vector<Vec3>> sides[] = {
        {"floor", {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}}},
        {"ceiling", {{a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}}},
        {"south", {{a.x, a.y, a.z}, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}}},
        {"north", {{a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}},
        {"west", {{a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {a.x, a.y, b.z}}},
        {"east", {{b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}}}};
    for (auto [side, outline] : sides) {
      if (!inward) {
        std::reverse(outline.begin(), outline.end());
      }
      if (side != omitted) {
        face(inward ? name + side : name, material, outline);
      }
    }
  }
  /// A wall in the plane of x, with a gap from the floor up to `height`; it faces +x or -x.
  void wall_with_gap(const std::string& group, int material, double x, bool forward,
                     double gap_from, double gap_to, double height) {
    const double y[][2] = {{0, gap_from}, {gap_to, 4}, {gap_from, gap_to}};
    const double bottom[] = {0, 0, height};
    for (int k = 0; k < 3; ++k) {
      std::vector<Vec3> outline{
          {x, y[k][0], bottom[k]}, {x, y[k][1], bottom[k]}, {x, y[k][1], 3}, {x, y[k][0], 3}};
      if (!forward) {
        std::reverse(outline.begin(), outline.end());
      }
      face(group, material, outline);
    }
  }
  ScenePtr scene(double max_patch_area) const {
    return std::make_shared<const Scene>(description_,
                                         SceneOptions{.max_patch_area = max_patch_area});
  }

 private:
  SceneDescription description_;
  std::map<std::string, int> groups_;
};

/// A lamp that stands 5 cm from a wall.
ScenePtr lamp_near_a_wall() {
  Rooms rooms("lamp near a wall");
  const int white = rooms.material(0.7), lamp = rooms.material(0.1, 100);
  rooms.box("", white, {0, 0, 0}, {5, 4, 3}, true);
  rooms.box("lamp", lamp, {4.9, 1.5, 2}, {4.95, 2.5, 2.3}, false);
  rooms.box("table", rooms.material(0.2), {1, 1, 0.5}, {2, 2.5, 0.8}, false);
  return rooms.scene(0.4);
}

/// A window of 40 cm behind a cupboard.
ScenePtr small_window() {
  Rooms rooms("small window");
  const int white = rooms.material(0.7), light = rooms.material(0, 100);
  rooms.box("", white, {0, 0, 0}, {6, 4, 3}, true);
  rooms.face("window", light,
             {{0.01, 1.8, 1.5}, {0.01, 2.2, 1.5}, {0.01, 2.2, 1.9}, {0.01, 1.8, 1.9}});
  rooms.box("cupboard", rooms.material(0.4), {2, 0.2, 0.01}, {2.6, 3, 2}, false);
  return rooms.scene(0.5);
}

/// Boxes of 16 groups under a ceiling lamp.
ScenePtr many_groups() {
  Rooms rooms("many groups");
  const int white = rooms.material(0.7), lamp = rooms.material(0, 30);
  rooms.box("", white, {0, 0, 0}, {8, 8, 3}, true);
  rooms.face("lamp", lamp, {{3, 3, 2.95}, {3, 5, 2.95}, {5, 5, 2.95}, {5, 3, 2.95}});
  for (int k = 0; k < 16; ++k) {
    const int column = k % 4, row = k / 4;
    const double x = 0.4 + 1.9 * column, y = 0.4 + 1.9 * row;
    rooms.box(fmt::format("box {}", k), rooms.material(0.1 + 0.05 * k), {x, y, 0.01},
              {x + 0.5 + 0.03 * k, y + 1, 0.4 + 0.14 * k}, false);
  }
  return rooms.scene(1);
}

/// A lit room and another one behind a door ajar: a gap of `width`.
ScenePtr door_ajar(double width) {
  Rooms rooms("door ajar");
  const int white = rooms.material(0.7), lamp = rooms.material(0, 50);
  const double from = 1.9, to = 1.9 + width, height = 2;
  rooms.box("lit ", white, {0, 0, 0}, {4, 4, 3}, true, "east");
  rooms.box("far ", white, {4.1, 0, 0}, {8, 4, 3}, true, "west");
  rooms.wall_with_gap("lit east", white, 4, false, from, to, height);
  rooms.wall_with_gap("far west", white, 4.1, true, from, to, height);
  rooms.face("frame", white,
             {{4, from, 0}, {4.1, from, 0}, {4.1, from, height}, {4, from, height}});
  rooms.face("frame", white, {{4, to, 0}, {4, to, height}, {4.1, to, height}, {4.1, to, 0}});
  rooms.face("frame", white,
             {{4, from, height}, {4.1, from, height}, {4.1, to, height}, {4, to, height}});
  rooms.face("frame", white, {{4, from, 0}, {4, to, 0}, {4.1, to, 0}, {4.1, from, 0}});
  rooms.face("lamp", lamp, {{1, 1.5, 2.95}, {1, 2.5, 2.95}, {2, 2.5, 2.95}, {2, 1.5, 2.95}});
  return rooms.scene(1);
}

/// A lamp of 2 cm.
ScenePtr tiny_lamp() {
  Rooms rooms("tiny lamp");
  const int white = rooms.material(0.7), lamp = rooms.material(0, 40000);
  rooms.box("", white, {0, 0, 0}, {5, 4, 3}, true);
  rooms.box("table", rooms.material(0.3), {1, 1, 0.5}, {2, 2.5, 0.8}, false);
  rooms.face("lamp", lamp, {{2, 2, 2.9}, {2, 2.02, 2.9}, {2.02, 2.02, 2.9}, {2.02, 2, 2.9}});
  return rooms.scene(0.4);
}

/// A room with a ceiling lamp and one group that differs from all others.
struct OddGroup {
  Rooms rooms;
  int white;

  explicit OddGroup(const std::string& name) : rooms(name), white(rooms.material(0.6)) {
    rooms.box("", white, {0, 0, 0}, {5, 4, 3}, true);
    rooms.face("lamp", rooms.material(0, 60), {{2, 1, 2.9}, {2, 2, 2.9}, {3, 2, 2.9}, {3, 1, 2.9}});
  }
  ScenePtr scene() const { return rooms.scene(0.4); }
};

/// A black cupboard: 1/200 of the light of the walls.
ScenePtr dark_group() {
  OddGroup odd("dark group");
  odd.rooms.box("cupboard", odd.rooms.material(0.004), {0.3, 0.5, 0.01}, {1, 2.5, 2}, false);
  return odd.scene();
}

/// A panel 3 cm in front of a lamp of its own: 100 times the light of the walls.
ScenePtr bright_group() {
  OddGroup odd("bright group");
  odd.rooms.box("panel", odd.rooms.material(0.8), {0.5, 1, 1}, {0.6, 2, 2}, false);
  odd.rooms.face("strip", odd.rooms.material(0, 3000),
                 {{0.63, 1.4, 1.4}, {0.63, 1.4, 1.6}, {0.63, 1.6, 1.6}, {0.63, 1.6, 1.4}});
  return odd.scene();
}

/// A box of rho 0.99 on the floor, open to one side: what enters is reflected many times.
ScenePtr white_group() {
  OddGroup odd("white group");
  odd.rooms.box("case ", odd.rooms.material(0.99), {0.5, 0.5, 0.02}, {1.7, 1.7, 1.2}, true, "east");
  odd.rooms.box("cover", odd.white, {0.49, 0.49, 0.01}, {1.71, 1.71, 1.21}, false, "east");
  return odd.scene();
}

/// One patch of 1 % of the area, in the shadow's edge of a bar above it.
ScenePtr small_group() {
  OddGroup odd("small group");
  odd.rooms.face("plate", odd.rooms.material(0.7),
                 {{2.2, 2.2, 0.4}, {3.2, 2.2, 0.4}, {3.2, 3.2, 0.4}, {2.2, 3.2, 0.4}});
  odd.rooms.box("bar", odd.rooms.material(0.3), {2, 2, 0.6}, {3.4, 2.7, 0.7}, false);
  return odd.rooms.scene(1.05);
}

/// The RMS error of the worst surface over the larger of its level and a thousandth of the largest
/// level. Surfaces are the groups, or the
/// materials where there are no groups; small ones count together.
double error_of_worst(const Scene& scene, const std::vector<Rgb>& b,
                      const std::vector<Rgb>& truth) {
  struct Sums {
    double errors = 0, values = 0, area = 0;
    int patches = 0;
  };
  const auto squares = [](const Rgb& v) { return v.r * v.r + v.g * v.g + v.b * v.b; };
  std::map<std::int32_t, Sums> groups;
  double area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (max_abs(scene.exitance(i)) > 0 || !(max_abs(scene.reflectance(i)) > 0)) {
      continue;
    }
    const Patch& patch = scene.patch(i);
    Sums& sums = groups[scene.groups().size() > 1 ? patch.group : patch.material];
    sums.errors += squares(at(b, i) - at(truth, i));
    sums.values += squares(at(truth, i));
    sums.area += scene.patch(i).area;
    ++sums.patches;
    area += scene.patch(i).area;
  }
  Sums others;
  for (auto& [group, sums] : groups) {
    if (sums.area < 0.01 * area) {
      others.errors += sums.errors;
      others.values += sums.values;
      others.patches += sums.patches;
      sums = {};
    }
  }
  groups[-2] = others;
  double brightest = 0, worst = 0;
  for (const auto& [group, sums] : groups) {
    brightest = std::max(brightest, sums.patches > 0 ? sums.values / sums.patches : 0);
  }
  for (const auto& [group, sums] : groups) {
    if (sums.patches > 0) {
      const double unit = std::max(sums.values / sums.patches, 1e-6 * brightest);
      worst = std::max(worst, std::sqrt(sums.errors / sums.patches / unit));
    }
  }
  return worst;
}

/// B by passes. The first shot has more points than by default, with which it alone is off by
/// 0.24 % in `rooms`; with these, by 0.001 %.
std::vector<Rgb> truth_by_passes(const ScenePtr& scene, int passes) {
  SolveOptions options{.directions = passes, .seed = 77, .tolerance = 1e-9};
  options.engine_options.points = 128;
  return solve(scene, options).radiosity;
}

std::vector<Rgb> truth_by_pairs(const ScenePtr& scene) {
  SolveOptions options{.engine = Engine::pairs, .tolerance = 1e-9};
  options.engine_options.points = 32;
  return solve_by_form_factors(scene, options).radiosity;
}

Solution solve_to(const ScenePtr& scene, double accuracy, std::uint64_t seed) {
  SolveOptions options{.seed = seed};
  options.goal.accuracy = accuracy;
  return solve(scene, options);
}

TEST(SurfaceAccuracy, NamesTheWorstSurface) {
  const ScenePtr scene = lamp_near_a_wall();
  const Solution solution = solve_to(scene, 0.03, 1);
  const AccuracyReport& report = *solution.accuracy;
  const SurfaceErrors& errors = solution.error.surfaces;
  EXPECT_TRUE(report.reached);
  EXPECT_EQ(report.error, errors.limit);
  EXPECT_EQ(report.surface, at(errors.surfaces, errors.worst).name);
  for (const SurfaceError& surface : errors.surfaces) {
    EXPECT_LE(surface.limit, errors.limit);
    EXPECT_NE(surface.name, "lamp");
  }
  EXPECT_LE(error_of_worst(*scene, solution.radiosity, truth_by_pairs(scene)), 0.03);
}

/// A lamp and the ceiling beside it made "at most 0.889 %" of a floor that was off by 7.4 %.
TEST(SurfaceAccuracy, HoldsOnFloorAndWallsOfARoom) {
  const ScenePtr scene = small_window();
  const std::vector<Rgb> truth = truth_by_pairs(scene);
  int above = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Solution solution = solve_to(scene, 0.03, seed);
    above += error_of_worst(*scene, solution.radiosity, truth) > solution.accuracy->error ? 1 : 0;
  }
  EXPECT_LE(above, 1);
}

TEST(SurfaceAccuracy, HoldsWhereOneGroupDiffersFromAllOthers) {
  int above = 0;
  for (const ScenePtr& scene : {dark_group(), bright_group(), white_group(), small_group()}) {
    const std::vector<Rgb> truth = truth_by_pairs(scene);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Solution solution = solve_to(scene, 0.04, seed);
      const double error = error_of_worst(*scene, solution.radiosity, truth);
      above += error > solution.accuracy->error ? 1 : 0;
      EXPECT_LE(error, 0.06) << scene->name() << ", seed " << seed;
    }
  }
  EXPECT_LE(above, 3);  // 24 claims, each wrong with a probability of at most 5 %
}

/// Light through a gap is a thousandth of the light of the lit room, and counts by itself.
TEST(SurfaceAccuracy, CountsTheRoomBehindTheDoor) {
  const ScenePtr scene = door_ajar(0.4);
  const Solution all = solve_to(scene, 0.1, 3);
  EXPECT_NE(all.accuracy->surface.substr(0, 3), "lit");
  const auto largest_of = [&](const char* room) {
    double largest = 0;
    for (const SurfaceError& surface : all.error.surfaces.surfaces) {
      largest = surface.name.starts_with(room) ? std::max(largest, surface.limit) : largest;
    }
    return largest;
  };
  EXPECT_GT(largest_of("far"), 10 * largest_of("lit"));
  SolveOptions options;
  options.goal = accuracy_of_from_name("groups:lit floor,lit north");
  options.goal.accuracy = 0.1;
  const Solution lit = solve(scene, options);
  EXPECT_EQ(lit.accuracy->surface.substr(0, 3), "lit");
  EXPECT_LT(lit.accuracy->passes_made, all.accuracy->passes_made);
  options.goal.surfaces = {"lit floor", "roof"};
  EXPECT_THROW(solve(scene, options), InputError);
}

TEST(SurfaceAccuracy, OfIrradianceCountsWhatReflectsNothing) {
  Rooms rooms("sensor");
  rooms.box("", rooms.material(0.7), {0, 0, 0}, {5, 4, 3}, true);
  rooms.face("lamp", rooms.material(0, 50), {{2, 1, 2.9}, {2, 3, 2.9}, {3, 3, 2.9}, {3, 1, 2.9}});
  rooms.box("black", rooms.material(0), {1, 1, 0.5}, {2, 2, 1}, false);
  const ScenePtr scene = rooms.scene(0.5);
  SolveOptions options;
  options.goal = accuracy_of_from_name("irradiance");
  options.goal.accuracy = 0.05;
  const Solution solution = solve(scene, options);
  EXPECT_TRUE(solution.accuracy->reached);
  const auto has = [](const SurfaceErrors& errors, const char* name) {
    return std::any_of(errors.surfaces.begin(), errors.surfaces.end(),
                       [&](const SurfaceError& surface) { return surface.name == name; });
  };
  EXPECT_TRUE(has(solution.error.irradiance, "black"));
  EXPECT_FALSE(has(solution.error.surfaces, "black"));
}

/// By its usual points, the first shot of `rooms` is off by more than a goal of 0.2 % allows. It
/// takes more for the patches that need them.
TEST(SurfaceAccuracy, IsReachedByAFirstShotThatIsRefined) {
  const ScenePtr scene = load_scene("rooms");
  SolveOptions options{.first_shot = 0};
  options.goal.accuracy = 0.002;
  const Solution solution = solve(scene, options);
  const std::vector<AccuracyStage>& stages = solution.accuracy->stages;
  EXPECT_TRUE(solution.accuracy->reached);
  EXPECT_EQ(solution.accuracy->obstacle, AccuracyObstacle::none);
  ASSERT_GE(stages.size(), 2U);
  EXPECT_EQ(stages[0].directions, stages[1].directions);
  EXPECT_LE(error_of_worst(*scene, solution.radiosity, truth_by_pairs(scene)), 0.003);
}

/// No number of directions makes up for the error of the first shot past a turned box.
TEST(SurfaceAccuracy, EndsWhereTheFirstShotIsNotAsAccurate) {
  SolveOptions options{.first_shot = 0};
  options.goal.accuracy = 1e-8;
  const Solution solution = solve(load_scene("cornell-box"), options);
  EXPECT_FALSE(solution.accuracy->reached);
  EXPECT_EQ(solution.accuracy->obstacle, AccuracyObstacle::first_shot);
  EXPECT_LE(solution.accuracy->passes_made, 500);
}

TEST(SurfaceAccuracy, EndsWithThePasses) {
  SolveOptions options;
  options.goal.accuracy = 1e-5;
  options.goal.passes = 500;
  const Solution solution = solve(lamp_near_a_wall(), options);
  EXPECT_FALSE(solution.accuracy->reached);
  EXPECT_EQ(solution.accuracy->obstacle, AccuracyObstacle::passes);
  EXPECT_LE(solution.accuracy->passes_made, 500);
  EXPECT_GT(solution.accuracy->passes_made, 250);
}

/// Claims about one scene, and truth over claim of each that is trusted.
struct Claims {
  double passes = 0;  ///< mean over all solves
  std::vector<double> ratios;

  int held() const {
    return static_cast<int>(
        std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio <= 1; }));
  }
  double median() {
    std::sort(ratios.begin(), ratios.end());
    return ratios.empty() ? 0 : ratios[ratios.size() / 2];
  }
};

Claims claims_of(const ScenePtr& scene, double accuracy, const std::vector<Rgb>& truth) {
  constexpr int rotations = 24;
  Claims claims;
  for (int r = 0; r < rotations; ++r) {
    const Solution solution = solve_to(scene, accuracy, 1000 * static_cast<std::uint64_t>(r + 1));
    if (solution.accuracy->trusted) {
      claims.ratios.push_back(error_of_worst(*scene, solution.radiosity, truth) /
                              solution.accuracy->error);
    }
    claims.passes += static_cast<double>(solution.accuracy->passes_made) / rotations;
  }
  return claims;
}

/// The table of decision 84: claims over 24 rotations, pooled.
TEST(NightlySurfaceAccuracy, ClaimsHoldTogether) {
  const std::pair<ScenePtr, std::vector<double>> cases[] = {
      {lamp_near_a_wall(), {0.05, 0.02}},
      {small_window(), {0.05, 0.02}},
      {many_groups(), {0.05, 0.02}},
      {door_ajar(0.9), {0.05}},
      {door_ajar(0.4), {0.05}},
      {door_ajar(0.08), {0.2, 0.1}},
      {tiny_lamp(), {0.05, 0.01}},
      {dark_group(), {0.05, 0.02}},
      {bright_group(), {0.05, 0.02}},
      {white_group(), {0.05, 0.02}},
      {small_group(), {0.05, 0.02}},
      {load_scene("rooms"), {0.05, 0.01}},
      {load_scene("cornell-box", {.max_patch_area = 0.02}), {0.05, 0.01}},
      {load_scene("boards"), {0.02}}};
  Claims all;
  for (const auto& [scene, accuracies] : cases) {
    const std::vector<Rgb> truth = truth_by_passes(scene, 32768);
    EXPECT_LE(error_of_worst(*scene, truth, truth_by_pairs(scene)), 0.25 * accuracies.back())
        << scene->name();
    for (const double accuracy : accuracies) {
      Claims claims = claims_of(scene, accuracy, truth);
      fmt::print("{}, {} %: {:.0f} passes, {} of {} hold, median of truth over claim {:.2f}\n",
                 scene->name(), 100 * accuracy, claims.passes, claims.held(), claims.ratios.size(),
                 claims.median());
      std::fflush(stdout);
      all.ratios.insert(all.ratios.end(), claims.ratios.begin(), claims.ratios.end());
    }
  }
  EXPECT_GE(all.ratios.size(), 400U);
  EXPECT_GE(all.held(), 0.94 * static_cast<double>(all.ratios.size()));
  EXPECT_GE(all.median(), 1.0 / 3);
}

}  // namespace
}  // namespace transillum::surface_accuracy_test
