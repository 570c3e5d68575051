// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/reports/summaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/reports/report_text.h"
#include "transillum/bounds.h"

namespace transillum::cli {
namespace {

constexpr std::size_t column = 8;

std::string percentage_text(double fraction) {
  if (!std::isfinite(fraction)) {
    return "-";
  }
  return fmt::format("{:.{}g}", 100 * fraction, fraction >= 1 ? 3 : 2);
}

std::string cost_text(const std::optional<StudyCost>& cost) {
  if (!cost) {
    return "-";
  }
  return fmt::format("{}{:.0f}, {}", cost->at_most ? "<= " : "", cost->passes,
                     time_text(cost->seconds));
}

/// The row of a series without passes: one solve.
std::string single_solve_text(const std::string& name, Engine engine, std::size_t width,
                              const std::vector<StudyPoint>& points, ErrorMeasure error) {
  if (points.empty()) {
    return {};
  }
  const StudyPoint& point = points.front();
  const std::string means =
      traits_of(engine).takes_resolution
          ? fmt::format("{} hemicubes of {} pixels", point.passes, point.directions)
          : fmt::format("the pairs of {} patches, {} points", point.passes, point.directions);
  return fmt::format("{:<{}}  {} % by {}, {}\n", name, width, percentage_text(point.error(error)),
                     means, time_text(point.seconds));
}

/// M and bound of every number of passes studied.
using BoundsByPasses = std::map<std::int64_t, double>;

BoundsByPasses bounds_by_passes(const StudyOptions& options, const Study& study) {
  BoundsByPasses bounds;
  for (const StudyPoint& point : study.points) {
    if (takes_directions(options.series[point.series].engine)) {
      bounds[point.passes] = point.bound;
    }
  }
  return bounds;
}

/// The columns of a series after its name: errors, slope, costs.
std::string series_text(const std::vector<StudyPoint>& points, const BoundsByPasses& bounds,
                        ErrorMeasure error) {
  std::string text;
  for (const auto& [passes, bound] : bounds) {
    const auto found = std::find_if(points.begin(), points.end(),
                                    [m = passes](auto& point) { return point.passes == m; });
    text += fmt::format("{:>{}}", found == points.end() ? "" : percentage_text(found->error(error)),
                        column);
  }
  const auto law = fitted_power_law(points, error);
  return text + fmt::format("{:>{}}{:>16}{:>16}\n", law ? fmt::format("{:.2f}", law->slope) : "-",
                            column, cost_text(cost_of(points, 0.01, error)),
                            cost_text(cost_of(points, 0.001, error)));
}

/// The error that `passes` directions guarantee in any environment.
std::string guarantee_text(const Scene& scene, std::int64_t passes) {
  const SceneMeasures measures = measure(scene);
  const auto m = static_cast<double>(passes);
  return fmt::format(
      "\nGuaranteed error of {:.0f} directions in any environment (eq. 43; rho {:.3g}, R2/A "
      "{:.3g}): "
      "{:.2g} %\n",
      m, measures.rho_max, measures.size_ratio,
      100 * heterogeneous_error_bound(measures.rho_max, measures.size_ratio,
                                      star_discrepancy_bound(m)));
}

}  // namespace

std::string study_summary(const Scene& scene, const StudyOptions& options, const Study& study,
                          ErrorMeasure error) {
  const std::string bound_name = "bound (eq. 37)";
  const std::vector<std::string> names = names_of(options.series);
  const BoundsByPasses bounds = bounds_by_passes(options, study);
  std::size_t width = bound_name.size();
  for (const std::string& name : names) {
    width = std::max(width, name.size());
  }

  std::string text = fmt::format("{} error of B in %, by number of passes\n{:<{}}",
                                 error == ErrorMeasure::rms ? "RMS" : "Largest", "", width);
  for (const auto& [passes, bound] : bounds) {
    text += fmt::format("{:>{}}", passes, column);
  }
  text += fmt::format("{:>{}}{:>16}{:>16}\n", "slope", column, "to 1 %", "to 0.1 %");

  for (std::size_t series = 0; series < names.size(); ++series) {
    const auto points = points_of(study, series);
    text +=
        takes_directions(options.series[series].engine)
            ? fmt::format("{:<{}}", names[series], width) + series_text(points, bounds, error)
            : single_solve_text(names[series], options.series[series].engine, width, points, error);
  }

  text += fmt::format("{:<{}}", bound_name, width);
  for (const auto& [passes, bound] : bounds) {
    text += fmt::format("{:>{}}", percentage_text(bound), column);
  }
  return text + (bounds.empty() ? "\n" : guarantee_text(scene, bounds.rbegin()->first));
}

}  // namespace transillum::cli
