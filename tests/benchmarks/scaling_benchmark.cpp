// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Time of a pass of the fast engine against scene size, and the speedup by a second thread.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "measure.h"
#include "transillum/engine.h"
#include "transillum/radiosity_solver.h"

namespace transillum::benchmarks {
namespace {

using Scenes = std::vector<std::function<std::shared_ptr<const Scene>()>>;

/// Milliseconds per pass: mean over a few directions, best of three rounds.
double pass_milliseconds(const std::shared_ptr<const Scene>& scene) {
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(Engine::fast, scene, tree);
  const auto directions = some_directions(8);
  double best = HUGE_VAL;
  for (int trial = 0; trial < 3; ++trial) {
    const double seconds = seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
      for (const Vec3& omega : directions) {
        engine(omega, {});
      }
    });
    best = std::min(best, 1e3 * seconds / static_cast<double>(directions.size()));
  }
  return best;
}

void measure_scaling(benchmark::State& state, const char* family, const Scenes& scenes) {
  std::vector<double> patches, milliseconds;
  for (auto _ : state) {
    for (const auto& make : scenes) {
      const auto scene = make();
      patches.push_back(scene->patch_count());
      milliseconds.push_back(pass_milliseconds(scene));
      fmt::print("{}: {} patches, {:.2f} ms a pass, {:.2f} us a patch\n", family, patches.back(),
                 milliseconds.back(), 1e3 * milliseconds.back() / patches.back());
      std::fflush(stdout);
    }
  }
  const double exponent = fitted_exponent(patches, milliseconds);
  fmt::print("{} exponent = {:.2f}\n", family, exponent);
  state.counters["exponent"] = exponent;
}

Scenes specs(const std::vector<std::string>& names) {
  Scenes scenes;
  for (const std::string& name : names) {
    scenes.emplace_back([name] { return load_scene(name); });
  }
  return scenes;
}

void FlakeScaling(benchmark::State& state) {
  std::vector<std::string> names{
      "sphere-flake:slices=8,stacks=4", "sphere-flake:slices=17,stacks=8",
      "sphere-flake:slices=34,stacks=16", "sphere-flake:slices=68,stacks=32"};
  if (std::getenv("TRANSILLUM_BENCHMARK_HUGE")) {
    names.emplace_back("sphere-flake:slices=121,stacks=57");
  }
  measure_scaling(state, "flake", specs(names));
}
BENCHMARK(FlakeScaling)->Name("Scaling/flake")->Iterations(1)->Unit(benchmark::kSecond);

void RoomsScaling(benchmark::State& state) {
  measure_scaling(state, "rooms", specs({"rooms:n=500", "rooms:n=2000", "rooms:n=8000"}));
}
BENCHMARK(RoomsScaling)->Name("Scaling/rooms")->Iterations(1)->Unit(benchmark::kSecond);

void RefinedStarsScaling(benchmark::State& state) {
  Scenes scenes;
  for (const double area : {0.01, 0.0025, 0.000625}) {
    scenes.emplace_back([area] { return load_scene("stars", {.max_patch_area = area}); });
  }
  measure_scaling(state, "refined stars", scenes);
}
BENCHMARK(RefinedStarsScaling)->Name("Scaling/stars")->Iterations(1)->Unit(benchmark::kSecond);

/// A floor of small squares with gaps between them, under one huge square.
std::shared_ptr<const Scene> huge_over_small(int side) {
  SceneDescription description;
  description.name = "huge over small";
  description.materials.push_back({"gray", {0.5, 0.5, 0.5}, {1, 1, 1}});
  const auto add = [&](double x, double y, double z, double width, bool up) {
    std::vector<PointId> ids;
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      ids.push_back(static_cast<PointId>(description.points.size()));
      description.points.push_back({x + i * width, y + j * width, z});
    }
    if (!up) {
      std::reverse(ids.begin(), ids.end());
    }
    description.add_face(ids, 0);
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      add(1.0 * i / side, 1.0 * j / side, 0, 0.9 / side, true);
    }
  }
  add(-1, -1, 0.5, 3, false);
  return std::make_shared<const Scene>(description);
}

void HugeScaling(benchmark::State& state) {
  Scenes scenes;
  for (const int side : {70, 140, 280}) {
    scenes.emplace_back([side] { return huge_over_small(side); });
  }
  measure_scaling(state, "one huge over many small", scenes);
}
BENCHMARK(HugeScaling)->Name("Scaling/huge")->Iterations(1)->Unit(benchmark::kSecond);

void TwoThreads(benchmark::State& state) {
  const auto scene = load_scene("sphere-flake");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const auto wall = [&](int threads) {
    return seconds_of(CLOCK_MONOTONIC, [&] {
      RadiositySolver solver(scene, {.directions = 128, .iterations = 1, .threads = threads},
                             {.tree = tree});
      solver.advance(RadiositySolver::Until::finished);
    });
  };
  double one = HUGE_VAL, two = HUGE_VAL;
  for (auto _ : state) {
    for (int trial = 0; trial < 3; ++trial) {
      one = std::min(one, wall(1));
      two = std::min(two, wall(2));
    }
  }
  fmt::print("two-thread speed-up = {:.2f}: {:.2f} s on one, {:.2f} s on two\n", one / two, one,
             two);
  state.counters["speed_up"] = one / two;
}
BENCHMARK(TwoThreads)->Name("Threads")->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace transillum::benchmarks
