// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/reports/summaries.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "cli/arguments/scene_options.h"
#include "cli/messages.h"
#include "cli/reports/report_text.h"
#include "radiosity/analysis/power_table.h"
#include "scene/build/patch_count.h"
#include "transillum/at.h"

namespace transillum::cli {
namespace {

/// Smallest, area-weighted mean and largest B over patches, per channel.
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

std::string radiosity_text(const Rgb& b) { return rgb_text(b, 5); }

double peak_memory_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Relative to reflected light.
std::string remainder_text(const IterationRecord& last) {
  if (!std::isfinite(std::max(last.remainder, last.remainder_dimmest))) {
    return "not bounded";
  }
  return fmt::format(
      "at most {:.2e} of the reflected light, {:.2e} in the dimmest tenth of the area",
      last.remainder, last.remainder_dimmest);
}

std::string convergence_text(const SolveStatistics& statistics) {
  if (statistics.iteration_records.empty()) {
    return "none finished";
  }
  const IterationRecord& last = statistics.iteration_records.back();
  const std::string result =
      last.error ? fmt::format("{} in the mean, estimated error of the mean {:.2e}",
                               statistics.iterations - statistics.burn_in, *last.error)
                 : fmt::format("light not yet propagated {}", remainder_text(last));
  return fmt::format("{}, {}{}", statistics.iterations, result,
                     statistics.converged ? ", converged" : "");
}

std::string passes_text(const SolveStatistics& s) {
  if (s.hemicubes > 0) {
    return report_row("hemicubes", fmt::format("{} of {} pixels each, {} threads", s.hemicubes,
                                               s.directions, s.threads));
  }
  if (s.pairs > 0) {
    return report_row(
        "pairs", fmt::format("{}, by {} points where something is between, {} threads", s.pairs,
                             s.directions, s.threads));
  }
  if (s.directions == 0) {
    return report_row("form factors",
                      fmt::format("{} given, {} threads", s.form_factors, s.threads));
  }
  return report_row("passes", fmt::format("{} per iteration, {} directions, {} threads", s.passes,
                                          s.directions, s.threads));
}

std::string error_text(const ErrorEstimate& error) {
  const Rgb half = error.quantile * error.mean_standard_error;
  std::string worst;
  if (error.surfaces.worst >= 0) {
    const SurfaceError& surface = at(error.surfaces.surfaces, error.surfaces.worst);
    worst = report_row(
        "worst surface",
        fmt::format("{}: {:.2g} % RMS{}; no surface above {:.2g} % (95 % confidence)", surface.name,
                    100 * surface.rms, dark_text(surface.is_dark), 100 * error.surfaces.limit));
  }
  return report_row("error of B",
                    fmt::format("{:.2g} % RMS, at most {:.2g} % (95 % confidence), estimated from "
                                "{} replicas",
                                100 * error.rms, 100 * error.rms_limit, error.replicas)) +
         worst +
         report_row("B mean, error",
                    fmt::format("+- {} W/m2 (95 % confidence)", radiosity_text(half)));
}

/// Which error a report is about.
std::string error_name(const AccuracyReport& report) {
  return report.surface.empty()
             ? name_of_accuracy(report.goal) + " error"
             : fmt::format("error{} of the worst surface, {},",
                           report.goal.of == AccuracyOf::irradiance ? " of H" : "", report.surface);
}

std::string obstacle_text(const AccuracyReport& report) {
  switch (report.obstacle) {
    case AccuracyObstacle::none:
      return "";
    case AccuracyObstacle::seconds:
      return " in the time given";
    case AccuracyObstacle::passes:
      return fmt::format(" with at most {} passes", report.goal.passes);
    case AccuracyObstacle::directions:
      return fmt::format(" with as many {} as are possible",
                         report.passes_made == 0 ? "points" : "directions");
    case AccuracyObstacle::first_shot:
      return " because the first shot is less accurate than asked where lamps are partly hidden";
    case AccuracyObstacle::stalled:
      return " because more directions do not decrease the error";
    case AccuracyObstacle::no_light:
      return " because no direction has brought light to what reflects";
  }
  return "";
}

std::string accuracy_text(const AccuracyReport& report) {
  const AccuracyGoal& goal = report.goal;
  const std::string asked = goal.accuracy > 0 ? fmt::format("{:.3g} % asked", 100 * goal.accuracy)
                                              : "within the time given";
  const bool is_late = goal.accuracy == 0 && (report.obstacle == AccuracyObstacle::seconds ||
                                              report.obstacle == AccuracyObstacle::none);
  const std::string reached =
      report.reached ? "reached"
      : is_late      ? "time is up"
                     : (goal.accuracy > 0 ? "not reached" : "ended") + obstacle_text(report);
  if (report.passes_made == 0) {  // engine pairs
    return report_row("accuracy",
                      fmt::format("{}, {}: estimated error {:.2g} %, {} points", asked, reached,
                                  100 * report.error, report.stages.back().directions));
  }
  return report_row(
      "accuracy", fmt::format("{}, {}: {} at most {:.3g} %{}; {} passes in {} stages", asked,
                              reached, error_name(report), 100 * report.error,
                              dark_text(report.is_dark), report.passes_made, report.stages.size()));
}

std::string glossy_text(const GlossyStatistics& counted) {
  constexpr double mebibyte = 1 << 20;
  return report_row(
      "lobes",
      fmt::format("on {} patches, {} orientations; sums over directions off by {:.1e} "
                  "before scaling, {:.0e} after; {:.3g} MiB by direction, {:.3g} MiB of "
                  "transfers kept",
                  counted.patches, counted.lobes, counted.sum_error, counted.sum_defect,
                  static_cast<double>(counted.radiance_bytes + counted.lobe_bytes) / mebibyte,
                  static_cast<double>(counted.transfer_bytes) / mebibyte));
}

/// Patches on which the mean of B or H is below 0, as only linear functions can make it.
std::int64_t patches_below_zero(const Solution& solution) {
  const auto is_below = [](const Rgb& value) { return std::min({value.r, value.g, value.b}) < 0; };
  std::int64_t count = 0;
  for (std::size_t i = 0; i < solution.linear_terms.size(); ++i) {
    count += is_below(solution.radiosity[i]) || is_below(solution.irradiance[i]) ? 1 : 0;
  }
  return count;
}

/// Where a scene is open, the largest defect belongs to the patch that is most open, and says
/// nothing about errors: there the row says what escapes.
std::string closure_text(const Solution& solution) {
  const SolveStatistics& s = solution.statistics;
  const std::string open = fraction_text(s.escaped) + " of the projected area sees no patch";
  if (is_open(s) && (s.iterations == 0 || solution.sky_fractions.empty())) {
    return report_row("open", open + ": light escapes there");
  }
  if (is_open(s)) {
    const double fraction = escaped_share(power_table(solution, SurfaceKind::group).total);
    return report_row("open",
                      fmt::format("{} of the light escapes; {}", fraction_text(fraction), open));
  }
  if (has_two_sided_faces(*solution.scene)) {
    return report_row("closed", open + ", outer sides of two-sided faces omitted");
  }
  return report_row("closure defect", fmt::format("{:.1e}; {}", s.closure_defect_max, open));
}

}  // namespace

std::string solve_summary(const Solution& solution) {
  const SolveStatistics& s = solution.statistics;
  const RadiosityRange b = radiosity_range(solution);
  std::string text = report_row("scene", solution.scene->name());
  text += report_row("patches", fmt::format("{}, {} fragments", s.patches, s.fragments));
  text += passes_text(s);
  if (s.pairs > 0) {
    text += report_row("time per pair", fmt::format("{:.3g} us", 1e6 * s.seconds_transfers /
                                                                     static_cast<double>(s.pairs)));
  } else if (s.passes_made > 0) {
    text += report_row(s.hemicubes > 0 ? "time per hemicube" : "time per pass",
                       fmt::format("{:.3g} ms, {} in total",
                                   1000 * s.seconds_transfers / static_cast<double>(s.passes_made),
                                   s.passes_made));
  }
  if (s.shot_sources > 0) {
    text +=
        report_row("first shot", fmt::format("{} patches, {} of the emitted power, {}",
                                             s.shot_sources, fraction_text(s.shot_power_fraction),
                                             time_text(s.seconds_first_shot)));
  }
  if (s.glossy.patches > 0) {
    text += glossy_text(s.glossy);
  }
  text += report_row("iterations", convergence_text(s));
  if (!s.iteration_records.empty() && s.iteration_records.back().unlit_area > 0) {
    text +=
        report_row("unlit", fmt::format("{} of the area: below 1e-6 of the largest reflected light",
                                        fraction_text(s.iteration_records.back().unlit_area)));
  }
  text += closure_text(solution);
  if (!s.iteration_records.empty()) {
    text += report_row("energy defect", fmt::format("{:.1e}", s.energy_defect));
  }
  text += report_row("B min, W/m2", radiosity_text(b.low));
  text += report_row("B mean, W/m2", radiosity_text(b.mean));
  text += report_row("B max, W/m2", radiosity_text(b.high));
  if (solution.error.replicas > 0) {
    text += error_text(solution.error);
  }
  if (solution.accuracy && !solution.accuracy->stages.empty()) {
    text += accuracy_text(*solution.accuracy);
  }
  text += report_row("time", fmt::format("{} (loading {}, BSP tree {}, passes {}, iteration {})",
                                         time_text(s.seconds_total), time_text(s.seconds_load),
                                         time_text(s.seconds_bsp), time_text(s.seconds_transfers),
                                         time_text(s.seconds_iterate)));
  text += report_row("peak memory", fmt::format("{:.0f} MiB", peak_memory_mebibytes()));
  return text;
}

namespace {

/// Whether a sky or sun gives light, but no lit side of a face sees it.
bool is_sky_lost(const Solution& solution) {
  return solution.sky.is_set() && !solution.sky_irradiance.empty() &&
         std::all_of(solution.sky_irradiance.begin(), solution.sky_irradiance.end(),
                     [](const Rgb& h) { return max_abs(h) == 0; });
}

}  // namespace

std::vector<std::string> solve_warnings(const Solution& solution) {
  const SolveStatistics& s = solution.statistics;
  std::vector<std::string> warnings;
  if (s.iteration_records.empty()) {
    if (!solution.complete) {
      warnings.push_back(fmt::format(
          "interrupted in the first iteration, after {} passes: B lacks light that is reflected "
          "more than once",
          s.passes_made));
    }
    return warnings;
  }
  if (!solution.complete && !s.iteration_records.back().error) {
    warnings.push_back(
        fmt::format("interrupted after {} iterations: B lacks the light not yet propagated, {}",
                    s.iterations, remainder_text(s.iteration_records.back())));
  }
  const auto is_dark = [](const Rgb& value) { return max_abs(value) == 0; };
  const bool emits = std::any_of(solution.radiosity.begin(), solution.radiosity.end(),
                                 [&](const Rgb& b) { return !is_dark(b); });
  if (emits && std::all_of(solution.irradiance.begin(), solution.irradiance.end(), is_dark)) {
    warnings.push_back("no patch receives light from another: B = E" +
                       remedy_hint(Remedy::directions));
  }
  if (is_sky_lost(solution)) {
    warnings.push_back(
        "the sky lights no face: backs of faces absorb all light of sky and sun (try "
        "--two-sided, or --orient auto or keep)");
  }
  // Halfway between rho_max (the limit for exact form factors of a closed scene) and 1.
  const auto is_slow = [&](const IterationRecord& r) {
    return r.change > 1e-12 && r.contraction > (1 + s.rho_max) / 2;
  };
  constexpr std::ptrdiff_t least = 8;
  if (std::ssize(s.iteration_records) >= least &&
      std::all_of(s.iteration_records.end() - least / 2, s.iteration_records.end(), is_slow)) {
    warnings.push_back(
        fmt::format("the changes decrease by a factor of only {:.6g} per iteration, although no "
                    "reflectance exceeds {:.3g}: form factors and B are too large",
                    s.iteration_records.back().contraction, s.rho_max) +
        remedy_hint(Remedy::directions_or_row_normalization));
  }
  if (s.shot_disagreement > 1) {
    warnings.push_back(fmt::format(
        "the first shot and the passes disagree about the light of its sources{}, by {:.2g} times "
        "what their errors explain: one of them is wrong. Compare with --first-shot none",
        s.shot_disagreement_patch < 0 ? std::string()
                                      : fmt::format(" on patch {}", s.shot_disagreement_patch),
        s.shot_disagreement));
  }
  if (const std::int64_t below = patches_below_zero(solution); below > 0) {
    warnings.push_back(
        fmt::format("the mean of B or H is below 0 on {} patches, which receive from parts of "
                    "others where linear functions fall below 0",
                    below) +
        remedy_hint(Remedy::directions));
  }
  const int replicas = std::max(solution.error.replicas, 1);
  const double met = s.light_directions / replicas;
  if (solution.error.replicas > 0 && met > 0 && met < least_light_directions) {
    warnings.push_back(
        fmt::format("the error estimate cannot be trusted: in a replica, a patch is lit directly "
                    "along only {:.2g} directions, as an average by light; {} are needed. {}",
                    met, least_light_directions,
                    solution.linear_terms.empty()
                        ? "--first-shot 0 treats the sources separately; or give more --directions"
                        : "Give more --directions"));
  } else if (const std::size_t count = uncertain_patches(solution).size(); count > 0) {
    warnings.push_back(fmt::format(
        "the standard errors of {} patches cannot be trusted: fewer than {} directions per replica "
        "are expected to bring them light of small sources. --first-shot 0 treats these separately",
        count, least_light_directions));
  }
  return warnings;
}

}  // namespace transillum::cli
