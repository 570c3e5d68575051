// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Time to accuracy of B on one core: passes of the fast engine, with and without a first shot,
// cosine-weighted rays by Embree with Jacobi iteration, and form factors pair by pair. Every method
// runs with increasing effort on the same scene, trees and iteration included; errors are RMS over
// patches, relative to the RMS of B, against a reference by another method or by a rotated set of
// directions. Prints all runs and a table; draws the runs if TRANSILLUM_BENCHMARK_PLOT names a .svg
// or .png file.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "io/drawing/line_chart.h"
#include "measure.h"
#include "support/scenes.h"
#include "transillum/form_factor_solve.h"
#include "transillum/form_factors.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"
#include "transillum/study.h"

namespace transillum::benchmarks {
namespace {

constexpr double tolerance = 1e-6;

using Radiosity = std::vector<Rgb>;

std::shared_ptr<const Scene> gray_flake() {
  SceneDescription flake = describe_scene("sphere-flake");
  for (Material& material : flake.materials) {
    material.reflectance = {0.6, 0.6, 0.6};
  }
  return std::make_shared<const Scene>(flake);
}

/// One way of computing B.
struct Method {
  const char* name;
  const char* unit;  ///< unit of the effort
  int first;         ///< effort of the first run; doubled from run to run
  int repeats;       ///< runs of one effort, with other rotations or seeds
  std::function<Radiosity(const std::shared_ptr<const Scene>&, int effort, int repeat)> radiosity;
};

Method passes(int repeats, std::optional<double> first_shot) {
  return {first_shot ? "passes, first shot" : "passes", "passes", 16, repeats,
          [first_shot](const auto& scene, int directions, int repeat) {
            SolveOptions options{.directions = directions,
                                 .first_shot = first_shot,
                                 .tolerance = tolerance,
                                 .threads = 1};
            if (repeat > 0) {
              options.rotation = static_cast<std::uint64_t>(repeat);
            }
            return solve(scene, options).radiosity;
          }};
}

Method rays(int repeats) {
  return {"cosine gather", "rays per patch", 64, repeats,
          [](const auto& scene, int count, int repeat) {
            const FormFactors f =
                gather_form_factors(*scene, {.rays_per_patch = count,
                                             .seed = static_cast<std::uint64_t>(1 + repeat),
                                             .threads = 1});
            return solve_radiosity(*scene, f, tolerance);
          }};
}

Radiosity by_pairs(const std::shared_ptr<const Scene>& scene, int points) {
  SolveOptions options{.engine = Engine::pairs, .tolerance = tolerance, .threads = 1};
  options.engine_options.points = points;
  return solve_by_form_factors(scene, options).radiosity;
}

Method pairs() {
  return {"pairs", "points", 1, 1,
          [](const auto& scene, int points, int) { return by_pairs(scene, points); }};
}

/// A scene, and the measurements that are made on it.
struct Case {
  std::string name;
  std::shared_ptr<const Scene> scene;
  std::vector<double> targets;
  double longest;            ///< CPU time of one run, s; methods stop before they exceed it
  int reference_directions;  ///< passes of the reference
  int reference_points;      ///< points of a second reference, by pairs; may be 0
  int repeats;
};

std::vector<Case> cases() {
  const std::vector<double> coarse{1e-2, 1e-3, 1e-4};
  return {
      {"cornell-box, 290 patches", load_scene("cornell-box", {.max_patch_area = 0.01}), coarse, 4,
       32768, 128, 2},
      {"rooms, 254 patches", load_scene("rooms"), coarse, 4, 32768, 128, 2},
      {"box in a cube, 480 patches", testing::box_in_cube().scene(), coarse, 4, 32768, 128, 2},
      {"box turned in a cube, 480 patches",
       testing::box_in_cube(8, 4, testing::random_rotation_about({0.5, 0.5, 0.5}, 4)).scene(),
       coarse, 4, 32768, 128, 2},
      {"sphere-flake, 19976 patches", gray_flake(), {1e-2, 2e-3, 1e-3}, 30, 4096, 0, 1},
  };
}

struct Run {
  double seconds, error;
};

/// The time at which the line through two runs, on logarithmic axes, reaches `error`.
double seconds_at(double error, const Run& a, const Run& b) {
  const double t = std::log(error / a.error) / std::log(b.error / a.error);
  return a.seconds * std::pow(b.seconds / a.seconds, t);
}

struct Time {
  double seconds = 0;
  bool extrapolated = false;  ///< beyond the last run, by the fitted slope
};

/// The time that a method takes to an accuracy; empty if it does not get better with effort.
std::optional<Time> time_to(double target, const std::vector<Run>& runs) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].error <= target) {
      return Time{k > 0 ? seconds_at(target, runs[k - 1], runs[k]) : runs[k].seconds};
    }
  }
  std::vector<double> seconds, errors;
  for (const Run& run : runs) {
    seconds.push_back(run.seconds);
    errors.push_back(run.error);
  }
  const double slope = fitted_exponent(seconds, errors);
  if (runs.size() < 3 || slope > -0.1) {
    return std::nullopt;
  }
  return Time{seconds.back() * std::pow(target / errors.back(), 1 / slope), true};
}

std::string time_text(const std::optional<Time>& time) {
  return time ? fmt::format("{}{:.3g}", time->extrapolated ? "~" : "", time->seconds) : "-";
}

/// Runs a method with increasing effort until its error is below the last target; prints each.
std::vector<Run> measure(const Method& method, const Case& of, const Radiosity& reference) {
  std::vector<Run> runs;
  for (int effort = method.first; effort <= 1 << 22; effort *= 2) {
    double squares = 0, seconds = 0;
    for (int repeat = 0; repeat < method.repeats; ++repeat) {
      Radiosity b;
      // The CPU time of the whole process is the work of one core, whatever thread does it.
      seconds += seconds_of(CLOCK_PROCESS_CPUTIME_ID,
                            [&] { b = method.radiosity(of.scene, effort, repeat); });
      const double error = radiosity_error(*of.scene, b, reference).rms;
      squares += error * error;
    }
    runs.push_back({seconds / method.repeats, std::sqrt(squares / method.repeats)});
    fmt::print("{}: {} {}: {:.3f} s, RMS error {:.4f} %\n", of.name, effort, method.unit,
               runs.back().seconds, 100 * runs.back().error);
    std::fflush(stdout);
    if (runs.back().error <= of.targets.back() || 2 * runs.back().seconds > of.longest) {
      break;
    }
  }
  return runs;
}

ChartAxis logarithmic(const char* title, double low, double high, double unit) {
  ChartAxis axis{title, low, high, true, true, {}};
  for (double power = 1e-7; power <= 1e4; power *= 10) {
    axis.ticks.push_back({power, fmt::format("{:g}", power * unit), false});
  }
  return axis;
}

LineChart chart_of(const Case& of,
                   const std::vector<std::pair<std::string, std::vector<Run>>>& all) {
  constexpr ChartColor colors[] = {{0, 115, 179}, {214, 94, 0}, {0, 140, 107}, {120, 94, 240}};
  constexpr ChartMarker markers[] = {ChartMarker::circle, ChartMarker::square,
                                     ChartMarker::triangle, ChartMarker::diamond};
  LineChart chart;
  chart.title = "Error of B: " + of.name;
  double shortest = 1e9, longest = 0, smallest = 1;
  for (std::size_t k = 0; k < all.size(); ++k) {
    ChartSeries series;
    series.name = all[k].first;
    series.color = colors[k];
    series.marker = markers[k];
    for (const Run& run : all[k].second) {
      series.points.push_back({run.seconds, run.error});
      shortest = std::min(shortest, run.seconds);
      longest = std::max(longest, run.seconds);
      smallest = std::min(smallest, run.error);
    }
    chart.series.push_back(series);
  }
  chart.x = logarithmic("seconds of one core", 0.7 * shortest, 1.4 * longest, 1);
  chart.y = logarithmic("RMS error of B, %", 0.7 * smallest, 0.2, 100);
  return chart;
}

struct CaseResult {
  std::vector<std::pair<std::string, std::vector<Run>>> runs;
};

/// Passes and rays are compared with a reference by pairs if there is one, and pairs with passes:
/// no method is compared with itself.
CaseResult measure(const Case& of) {
  SolveOptions fine = reference_options(of.reference_directions);
  fine.tolerance = 1e-8;
  const Radiosity by_passes = solve(of.scene, fine).radiosity;
  Radiosity other = by_passes;
  if (of.reference_points > 0) {
    other = by_pairs(of.scene, of.reference_points);
    fmt::print("{}: references ({} passes, pairs of {} points) differ by {:.1e}\n", of.name,
               of.reference_directions, of.reference_points,
               radiosity_error(*of.scene, other, by_passes).rms);
  }
  CaseResult result;
  for (const Method& method : {passes(of.repeats, {}), rays(of.repeats)}) {
    result.runs.emplace_back(method.name, measure(method, of, other));
  }
  if (of.reference_points > 0) {
    result.runs.emplace_back(pairs().name, measure(pairs(), of, by_passes));
    const Method shot = passes(of.repeats, first_shot_where_it_pays);
    result.runs.emplace_back(shot.name, measure(shot, of, other));
  }
  return result;
}

/// Prints a row per target, and adds the ratios to the counters.
void report(const Case& of, const CaseResult& result, benchmark::State& state) {
  for (const double target : of.targets) {
    const auto ours = time_to(target, result.runs[0].second);
    std::string row = fmt::format("| {} | {:g} %", of.name, 100 * target);
    for (const auto& [name, runs] : result.runs) {
      row += fmt::format(" | {} {}", name, time_text(time_to(target, runs)));
    }
    for (std::size_t k = 1; k < result.runs.size(); ++k) {
      const auto theirs = time_to(target, result.runs[k].second);
      if (!ours || !theirs) {
        continue;
      }
      const double ratio = theirs->seconds / ours->seconds;
      const bool extrapolated = ours->extrapolated || theirs->extrapolated;
      row += fmt::format(" | {} / passes = {}{:.2g}", result.runs[k].first, extrapolated ? "~" : "",
                         ratio);
      state.counters[fmt::format("{}, {} at {:g}%{}", of.name.substr(0, of.name.find(',')),
                                 result.runs[k].first, 100 * target,
                                 extrapolated ? ", extrapolated" : "")] = ratio;
    }
    fmt::print("{} |\n", row);
  }
  std::fflush(stdout);
}

void TimeToAccuracyOfB(benchmark::State& state) {
  std::vector<LineChart> charts;
  for (auto _ : state) {
    for (const Case& of : cases()) {
      const CaseResult result = measure(of);
      report(of, result, state);
      charts.push_back(chart_of(of, result.runs));
    }
  }
  if (const char* file = std::getenv("TRANSILLUM_BENCHMARK_PLOT")) {
    write_charts(file, charts,
                 {.width = 640, .height = 320.0 * static_cast<double>(charts.size()), .scale = 1});
  }
}
BENCHMARK(TimeToAccuracyOfB)->Name("Accuracy")->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace transillum::benchmarks
