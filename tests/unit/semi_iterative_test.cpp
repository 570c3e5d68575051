// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The semi-iterative scheme at high reflectance, where the start has an effect for many iterations:
// its B, its error estimates and its stopping rule against known answers. Scenes: closed cubes,
// whose form factors are known; furnaces, B = E / (1 - rho); built-ins with raised reflectance,
// against 4,096 passes.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"
#include "transillum/study.h"

namespace transillum::semi_iterative_test {
namespace {

using ::testing::Each;
using transillum::testing::Sketch;
using Until = RadiositySolver::Until;

/// A scene and its B, W/m².
struct Known {
  std::string name;
  std::shared_ptr<const Scene> scene;
  std::vector<Rgb> b;
};

using SixNumbers = std::array<double, 6>;

/// The unit cube from inside: B from the form factors of opposite and adjacent faces.
Known cube(const std::string& name, const SixNumbers& rho, const SixNumbers& exitance) {
  Sketch outlines;
  outlines.box({0, 0, 0}, {1, 1, 1}, true, outlines.material(0.5, 0));
  Sketch sketch;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto first = outlines.description().points.begin() + 4 * static_cast<int>(face);
    sketch.face({first, first + 4}, sketch.material(rho[face], exitance[face]));
  }
  SixNumbers b = exitance;
  for (int n = 0; n < 10'000; ++n) {
    SixNumbers next = exitance;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const double f = i == j ? 0 : i / 2 == j / 2 ? 0.1998248957 : 0.2000437761;
        next[i] += rho[i] * f * b[j];
      }
    }
    b = next;
  }
  Known known{name, sketch.scene(), {}};
  for (const double value : b) {
    known.b.push_back({value, value, value});
  }
  return known;
}

Known furnace(double rho) {
  SceneDescription description = describe_scene("furnace");
  for (Material& material : description.materials) {
    material.reflectance = {rho, rho, rho};
    material.exitance = {1, 1, 1};
  }
  Known known{"furnace", std::make_shared<const Scene>(description), {}};
  const double b = 1 / (1 - rho);
  known.b.assign(known.scene->patches().size(), {b, b, b});
  return known;
}

/// A built-in scene whose reflectances are raised toward 1 by a power; B by many passes.
Known brighter(const std::string& name, double power) {
  SceneDescription description = describe_scene(name);
  const auto raised = [power](double rho) { return std::pow(rho, power); };
  for (Material& material : description.materials) {
    const Rgb& rho = material.reflectance;
    material.reflectance = {raised(rho.r), raised(rho.g), raised(rho.b)};
  }
  Known known{name, std::make_shared<const Scene>(description), {}};
  SolveOptions options = reference_options(4096);
  known.b = solve(known.scene, options).radiosity;
  return known;
}

const std::vector<Known>& known_scenes() {
  static const std::vector<Known> all{
      cube("lamp in a cube, 0.9", {0.9, 0.9, 0.9, 0.9, 0.9, 0.9}, {1, 0, 0, 0, 0, 0}),
      cube("one black wall, 0.98", {0.98, 0.98, 0.98, 0, 0.98, 0.98}, {0, 0, 1, 0, 0, 0}),
      cube("unequal walls", {0.95, 0.2, 0.97, 0.9, 0.5, 0.98}, {0, 3, 0, 0, 0.1, 0}),
      cube("dark cube", {0.2, 0.3, 0.1, 0.2, 0.3, 0.2}, {1, 0, 0, 0, 0, 0}),
      furnace(0.9),
      furnace(0.95),
      brighter("cornell-box", 0.25),
      brighter("rooms:n=2", 0.3)};
  return all;
}

/// The solve uses one thread: passes of six patches are shorter than the time to distribute them.
SolveOptions semi_iterative(int directions) {
  return {.directions = directions, .scheme = Scheme::semi_iterative, .threads = 1};
}

/// The mean of B over the area, red channel.
double mean_over_area(const Scene& scene, const std::vector<Rgb>& b) {
  double power = 0, area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    power += scene.patch(i).area * at(b, i).r;
    area += scene.patch(i).area;
  }
  return power / area;
}

/// The start, B = E, has an error of 90 % at rho = 0.9: its remaining effect must not be visible.
/// The differences between sets of 128 directions are below 1 %.
TEST(SemiIterative, ForgetsItsStartAtAnyReflectance) {
  for (const Known& known : known_scenes()) {
    SolveOptions options = semi_iterative(128);
    options.averaged_iterations = default_averaged_iterations;
    const Solution solution = solve(known.scene, options);
    EXPECT_TRUE(solution.complete);
    EXPECT_LT(radiosity_error(*known.scene, solution.radiosity, known.b).rms, 0.01) << known.name;
    EXPECT_EQ(solution.statistics.iterations,
              solution.statistics.burn_in + default_averaged_iterations);
  }
}

/// At a factor of at most rho_max per iteration, and no further than to a tenth of the tolerance.
TEST(SemiIterative, BurnsInNoLongerThanTheReflectanceDemands) {
  for (const Known& known : known_scenes()) {
    SolveOptions options = semi_iterative(32);
    options.averaged_iterations = 1;
    options.tolerance = 1e-4;
    const SolveStatistics s = solve(known.scene, options).statistics;
    // The bound of what is left starts at most 1 / (1 - rho_max) times as high as B.
    const double most = std::log(0.1 * options.tolerance * (1 - s.rho_max)) / std::log(s.rho_max);
    EXPECT_LE(s.burn_in, 1.1 * most + 2) << known.name;
  }
  SolveOptions options = semi_iterative(128);
  options.averaged_iterations = 1;
  for (const char* dark : {"furnace", "cornell-box", "stars"}) {
    EXPECT_LT(solve(load_scene(dark), options).statistics.burn_in, 20) << dark;
  }
}

TEST(SemiIterative, ReplicasIncludeWhatIsLeftOfTheStart) {
  for (const Known& known : known_scenes()) {
    // The burn-in is automatic, and deliberately too short.
    for (const std::optional<int> burn_in : {std::optional<int>(), {8}}) {
      SolveOptions options = semi_iterative(128);
      options.burn_in = burn_in;
      options.replicas = 8;
      options.averaged_iterations = default_averaged_iterations;
      RadiositySolver solver(known.scene, options);
      solver.advance(Until::finished);
      const ErrorEstimate error = solver.error_estimate();
      const double off = std::abs(mean_over_area(*known.scene, solver.radiosity()) -
                                  mean_over_area(*known.scene, known.b));
      // 99.9 %: there are 16 intervals.
      EXPECT_LE(off, 5.4 * error.mean_standard_error.r)
          << known.name << ' ' << burn_in.value_or(-1);
      const double rms = radiosity_error(*known.scene, solver.radiosity(), known.b).rms;
      EXPECT_LE(rms, 3 * error.rms) << known.name << ' ' << burn_in.value_or(-1);
    }
  }
}

TEST(SemiIterative, HasConvergedWhereItSaysSo) {
  for (const Known& known : known_scenes()) {
    for (const double tolerance : {3e-2, 1e-2}) {
      SolveOptions options = semi_iterative(128);
      options.tolerance = tolerance;
      const Solution solution = solve(known.scene, options);
      EXPECT_TRUE(solution.statistics.converged);
      const double error = *solution.statistics.iteration_records.back().error;
      EXPECT_LE(error, tolerance);
      EXPECT_LE(radiosity_error(*known.scene, solution.radiosity, known.b).max, tolerance)
          << known.name;
    }
  }
}

/// With a few directions per set, most of the error comes from the directions. The test has other
/// samplings and seeds.
TEST(SemiIterative, HasConvergedWhereItSaysSoWithFewDirections) {
  for (const Sampling sampling :
       {Sampling::fibonacci, Sampling::random, Sampling::sobol, Sampling::halton}) {
    for (std::size_t scene = 0; scene < 3; ++scene) {
      const Known& known = known_scenes()[scene];
      int held = 0;
      constexpr int runs = 6;
      for (int seed = 1; seed <= runs; ++seed) {
        SolveOptions options = semi_iterative(24);
        options.sampling = sampling;
        options.seed = static_cast<std::uint64_t>(seed);
        options.tolerance = 0.02;
        const Solution solution = solve(known.scene, options);
        EXPECT_TRUE(solution.statistics.converged);
        held += radiosity_error(*known.scene, solution.radiosity, known.b).max <= options.tolerance
                    ? 1
                    : 0;
      }
      EXPECT_GE(held, runs - 1) << known.name << ' ' << name_of(sampling);
    }
  }
}

/// If the rows of an enclosure sum to 1, a furnace has no error of directions, only the error of
/// the start.
TEST(SemiIterative, IsExactInAFurnaceWithNormalizedRows) {
  const Known known = furnace(0.9);
  SolveOptions options = semi_iterative(16);
  options.normalize = Normalization::rows;
  options.tolerance = 1e-9;
  const Solution solution = solve(known.scene, options);
  EXPECT_TRUE(solution.statistics.converged);
  EXPECT_LT(radiosity_error(*known.scene, solution.radiosity, known.b).max, 1e-9);
}

TEST(SemiIterative, IsNotConvergedWhenItsIterationsAreUsedUp) {
  const Known known = furnace(0.9);
  SolveOptions options = semi_iterative(64);
  options.iterations = 20;
  options.tolerance = 1e-3;
  RadiositySolver solver(known.scene, options);
  solver.advance(Until::finished);
  const SolveStatistics s = solver.statistics();
  EXPECT_FALSE(s.converged);
  EXPECT_EQ(s.iterations, 20);
  EXPECT_EQ(s.burn_in, 10);
  const double error = radiosity_error(*known.scene, solver.radiosity(), known.b).max;
  EXPECT_GT(error, 0.1);
  EXPECT_GE(*s.iteration_records.back().error, error);
  // Two thirds of the light is missing in every replica alike.
  options.replicas = 4;
  options.iterations = 4;
  const Solution early = solve(known.scene, options);
  EXPECT_GE(early.error.rms, radiosity_error(*known.scene, early.radiosity, known.b).rms);
}

/// Hammersley's points are the same in every iteration: iterations agree, and all have the same
/// error.
TEST(SemiIterative, HasNotConvergedWithEqualSets) {
  const Known known = furnace(0.9);
  for (const Sampling sampling : {Sampling::hammersley, Sampling::centered_hammersley}) {
    SolveOptions options = semi_iterative(64);
    options.sampling = sampling;
    options.tolerance = 1e-3;
    const Solution solution = solve(known.scene, options);
    EXPECT_TRUE(solution.complete);
    EXPECT_FALSE(solution.statistics.converged);
    EXPECT_FALSE(solution.statistics.iteration_records.back().error);
  }
}

/// A single direction may miss every lamp: nothing is gathered, but much light is missing.
TEST(SemiIterative, BurnsInWhereTheFirstDirectionsMissTheLight) {
  const Known known = cube("lamp", {0.9, 0.9, 0.9, 0.9, 0.9, 0.9}, {1, 0, 0, 0, 0, 0});
  for (std::uint64_t rotation = 0; rotation < 6; ++rotation) {
    SolveOptions options = semi_iterative(1);
    options.rotation = rotation;
    options.two_way = false;
    options.normalize = Normalization::rows;
    options.averaged_iterations = 1;
    EXPECT_GT(solve(known.scene, options).statistics.burn_in, 1);
  }
}

TEST(SemiIterative, OfADarkSceneHasConverged) {
  const Known known = cube("dark", {0.9, 0.9, 0.9, 0.9, 0.9, 0.9}, {0, 0, 0, 0, 0, 0});
  const Solution solution = solve(known.scene, semi_iterative(4));
  EXPECT_TRUE(solution.statistics.converged);
  EXPECT_THAT(solution.radiosity, Each(Rgb{}));
}

/// An explicit burn-in is not changed.
TEST(SemiIterative, StudiesCountTheIterationsOfTheBurnIn) {
  const Known known = furnace(0.9);
  const auto tree = std::make_shared<const BspTree>(*known.scene);
  StudyOptions options;
  options.series = {{Sampling::fibonacci, true, Normalization::none, Scheme::semi_iterative}};
  options.directions = {64, 256};
  const auto points = [&] { return run_study(known.scene, tree, options, {known.b}).points; };
  const auto automatic = points();
  for (std::size_t k = 0; k < 2; ++k) {
    const StudyPoint& point = automatic.at(k);
    EXPECT_LT(point.rms_error, 0.02);
    EXPECT_GT(point.passes, (30 + default_averaged_iterations) * options.directions[k]);
    EXPECT_EQ(point.passes % options.directions[k], 0);
    EXPECT_EQ(point.directions, 2 * point.passes);
  }
  options.solve.burn_in = 8;
  EXPECT_EQ(points()[0].passes, 64 * (8 + default_averaged_iterations));
  EXPECT_GT(points()[0].rms_error, 0.1);
}

}  // namespace
}  // namespace transillum::semi_iterative_test
