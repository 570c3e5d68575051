// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve_summary.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <limits>

#include "progress_display.h"
#include "transillum/at.h"

namespace transillum::cli {
namespace {

/// Smallest, area-weighted mean and largest B, over patches, a channel.
struct RadiosityRange {
  Rgb low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  Rgb mean;
  Rgb high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

RadiosityRange radiosity_range(const Solution& solution) {
  RadiosityRange range;
  double area = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const Rgb& b = at(solution.radiosity, i);
    range.low = {std::min(range.low.r, b.r), std::min(range.low.g, b.g),
                 std::min(range.low.b, b.b)};
    range.high = {std::max(range.high.r, b.r), std::max(range.high.g, b.g),
                  std::max(range.high.b, b.b)};
    range.mean += solution.scene->patch(i).area * b;
    area += solution.scene->patch(i).area;
  }
  if (area > 0) {
    range.mean = (1 / area) * range.mean;
  }
  return range;
}

std::string row(const std::string& name, const std::string& value) {
  return fmt::format("{:<16} {}\n", name, value);
}

std::string color_text(const Rgb& b) { return fmt::format("{:.5g} {:.5g} {:.5g}", b.r, b.g, b.b); }

double peak_memory_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string convergence_text(const SolveStatistics& statistics) {
  if (statistics.iteration_records.empty()) {
    return "none finished";
  }
  return fmt::format("{}, last change {:.2e}{}", statistics.iterations,
                     statistics.iteration_records.back().change,
                     statistics.converged ? ", converged" : "");
}

std::string passes_text(const SolveStatistics& s) {
  if (s.hemicubes > 0) {
    return row("hemicubes",
               fmt::format("{} of {} pixels, {} threads", s.hemicubes, s.directions, s.threads));
  }
  return row("passes", fmt::format("{} a step, {} directions, {} threads", s.passes, s.directions,
                                   s.threads));
}

std::string error_text(const ErrorEstimate& error) {
  const Rgb half = error.quantile * error.mean_standard_error;
  return row("error of B", fmt::format("{:.2g} % RMS, estimated from {} replicas", 100 * error.rms,
                                       error.replicas)) +
         row("B mean is within",
             fmt::format("+- {} of that above, in 95 of 100 runs", color_text(half)));
}

}  // namespace

std::string solve_summary(const Solution& solution) {
  const SolveStatistics& s = solution.statistics;
  const RadiosityRange b = radiosity_range(solution);
  std::string text = row("scene", solution.scene->name());
  text += row("patches", fmt::format("{}, {} fragments", s.patches, s.fragments));
  text += passes_text(s);
  if (s.passes_made > 0) {
    text += row(s.hemicubes > 0 ? "time a cube" : "time a pass",
                fmt::format("{:.3g} ms, {} made",
                            1000 * s.seconds_transfers / static_cast<double>(s.passes_made),
                            s.passes_made));
  }
  if (s.shot_sources > 0) {
    text += row("first shot",
                fmt::format("{} patches, {:.3g} % of the power emitted, in {}", s.shot_sources,
                            100 * s.shot_power_share, time_text(s.seconds_first_shot)));
  }
  text += row("iterations", convergence_text(s));
  text += row("closure defect", fmt::format("{:.1e}, {:.2g} % of what is seen is open",
                                            s.closure_defect_max, 100 * s.escaped));
  if (!s.iteration_records.empty()) {
    text += row("energy defect", fmt::format("{:.1e}", s.energy_defect));
  }
  text += row("B min, W/m2", color_text(b.low));
  text += row("B mean, W/m2", color_text(b.mean));
  text += row("B max, W/m2", color_text(b.high));
  if (solution.error.replicas > 0) {
    text += error_text(solution.error);
  }
  text += row("time", fmt::format("{} (load {}, sorting {}, passes {}, iteration {})",
                                  time_text(s.seconds_total), time_text(s.seconds_load),
                                  time_text(s.seconds_bsp), time_text(s.seconds_transfers),
                                  time_text(s.seconds_iterate)));
  text += row("peak memory", fmt::format("{:.0f} MiB", peak_memory_megabytes()));
  return text;
}

}  // namespace transillum::cli
