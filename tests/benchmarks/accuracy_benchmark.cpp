// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Time to accuracy of B on one core: passes of the fast engine compared with cosine-weighted rays
// by Embree and Jacobi iteration. Scene: the sphere flake, reflectance 0.6 everywhere; errors are
// RMS over patches, relative to the RMS of B, against a run of 4096 other directions.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "measure.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity.h"

namespace transillum::benchmarks {
namespace {

SceneDescription gray_flake() {
  SceneDescription flake = describe_scene("sphere-flake");
  for (Material& material : flake.materials) {
    material.reflectance = {0.6, 0.6, 0.6};
  }
  return flake;
}

/// The scene under a rotation, so that the same sequence gives other directions relative to it.
SceneDescription turned(SceneDescription description) {
  const Vec3 x = normalized({1, 2, 3}), y = normalized(cross({3, 1, 1}, x)), z = cross(x, y);
  for (Vec3& p : description.points) {
    p = p.x * x + p.y * y + p.z * z;
  }
  return description;
}

const std::vector<Rgb>& reference() {
  static const std::vector<Rgb> radiosity = [] {
    const auto scene = std::make_shared<const Scene>(turned(gray_flake()));
    return solve(scene, {.directions = 4096, .tolerance = 1e-7}).radiosity;
  }();
  return radiosity;
}

double rms_error(const std::vector<Rgb>& b) {
  const auto dot = [](const Rgb& x) { return x.r * x.r + x.g * x.g + x.b * x.b; };
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    error += dot(b[i] - reference()[i]);
    norm += dot(reference()[i]);
  }
  return std::sqrt(error / norm);
}

struct Run {
  double seconds, error;
};

/// The effort at which the line through two runs, on logarithmic axes, reaches `error`.
double seconds_at(double error, const Run& a, const Run& b) {
  const double t = std::log(error / a.error) / std::log(b.error / a.error);
  return a.seconds * std::pow(b.seconds / a.seconds, t);
}

struct TimeToAccuracy {
  double to_1_percent = 0, to_0_2_percent = 0;
};

/// Increases the effort until the error is below 0.2 %; prints each run.
TimeToAccuracy measure(const char* name, int effort, int largest,
                       const std::function<std::vector<Rgb>(int)>& radiosity) {
  TimeToAccuracy times;
  std::optional<Run> before;
  for (; effort <= largest; effort *= 2) {
    std::vector<Rgb> b;
    Run run{};
    // CPU time of the whole process is the work of one core, whichever thread does it.
    run.seconds = seconds_of(CLOCK_PROCESS_CPUTIME_ID, [&] { b = radiosity(effort); });
    run.error = rms_error(b);
    fmt::print("{} {}: {:.2f} s, RMS error {:.3f} %\n", name, effort, run.seconds, 100 * run.error);
    std::fflush(stdout);
    for (auto [target, time] :
         {std::pair{1e-2, &times.to_1_percent}, std::pair{2e-3, &times.to_0_2_percent}}) {
      if (*time == 0 && run.error <= target) {
        *time = before ? seconds_at(target, *before, run) : run.seconds;
      }
    }
    if (times.to_0_2_percent > 0) {
      break;
    }
    before = run;
  }
  return times;
}

void TimeToAccuracyOfB(benchmark::State& state) {
  TimeToAccuracy passes, gather;
  const auto scene = std::make_shared<const Scene>(gray_flake());
  reference();
  for (auto _ : state) {
    passes = measure("passes", 16, 4096, [&](int directions) {
      return solve(scene, {.directions = directions, .tolerance = 1e-5, .threads = 1}).radiosity;
    });
    gather = measure("rays a patch", 64, 1 << 17, [&](int rays) {
      const FormFactors f = gather_form_factors(*scene, {.rays_per_patch = rays, .threads = 1});
      return solve_radiosity(*scene, f, 1e-5);
    });
  }
  const auto print = [&](const char* accuracy, const char* counter, double ours, double theirs) {
    fmt::print("accuracy {}: passes {:.2f} s, cosine gather {:.2f} s, gather/passes = {:.1f}\n",
               accuracy, ours, theirs, theirs / ours);
    state.counters[counter] = theirs / ours;
  };
  print("1 %", "gain_at_1_percent", passes.to_1_percent, gather.to_1_percent);
  print("0.2 %", "gain_at_0.2_percent", passes.to_0_2_percent, gather.to_0_2_percent);
}
BENCHMARK(TimeToAccuracyOfB)->Name("Accuracy")->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace transillum::benchmarks
