// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report_text.h"
#include "transillum/bounds.h"

namespace transillum::cli {
namespace {

constexpr std::size_t column = 8;

std::string percent_text(double share) {
  if (!std::isfinite(share)) {
    return "-";
  }
  return fmt::format("{:.{}g}", 100 * share, share >= 1 ? 3 : 2);
}

std::string cost_text(const std::optional<StudyCost>& cost) {
  if (!cost) {
    return "-";
  }
  return fmt::format("{}{:.0f}, {}", cost->at_most ? "<= " : "", cost->passes,
                     time_text(cost->seconds));
}

/// The row of a hemicube series: one solve, without passes.
std::string hemicubes_text(const std::string& name, std::size_t width,
                           const std::vector<StudyPoint>& points, ErrorMeasure error) {
  if (points.empty()) {
    return {};
  }
  const StudyPoint& point = points.front();
  return fmt::format("{:<{}}  {} % by {} hemicubes of {} pixels, {}\n", name, width,
                     percent_text(point.error(error)), point.passes, point.directions,
                     time_text(point.seconds));
}

}  // namespace

std::string study_summary(const Scene& scene, const StudyOptions& options, const Study& study,
                          ErrorMeasure error) {
  const std::vector<std::string> names = names_of(options.series);
  std::map<std::int64_t, double> bounds;
  for (const StudyPoint& point : study.points) {
    if (takes_directions(options.series[point.series].engine)) {
      bounds[point.passes] = point.bound;
    }
  }

  std::size_t width = std::string("bound (eq. 37)").size();
  for (const std::string& name : names) {
    width = std::max(width, name.size());
  }
  std::string text = fmt::format("{} error of B in %{}, by number of passes\n{:<{}}",
                                 error == ErrorMeasure::rms ? "RMS" : "Largest",
                                 options.without_sources ? ", without sources" : "", "", width);
  for (const auto& [passes, bound] : bounds) {
    text += fmt::format("{:>{}}", passes, column);
  }
  text += fmt::format("{:>{}}{:>16}{:>16}\n", "slope", column, "to 1 %", "to 0.1 %");

  for (std::size_t series = 0; series < names.size(); ++series) {
    const auto points = points_of(study, series);
    if (!takes_directions(options.series[series].engine)) {
      text += hemicubes_text(names[series], width, points, error);
      continue;
    }
    text += fmt::format("{:<{}}", names[series], width);
    for (const auto& [passes, bound] : bounds) {
      const auto at = std::find_if(points.begin(), points.end(),
                                   [m = passes](auto& point) { return point.passes == m; });
      text +=
          fmt::format("{:>{}}", at == points.end() ? "" : percent_text(at->error(error)), column);
    }
    const auto law = fitted_power_law(points, error);
    text += fmt::format("{:>{}}{:>16}{:>16}\n", law ? fmt::format("{:.2f}", law->slope) : "-",
                        column, cost_text(cost_of(points, 0.01, error)),
                        cost_text(cost_of(points, 0.001, error)));
  }
  text += fmt::format("{:<{}}", "bound (eq. 37)", width);
  for (const auto& [passes, bound] : bounds) {
    text += fmt::format("{:>{}}", percent_text(bound), column);
  }

  const SceneMeasures measures = measure(scene);
  if (bounds.empty()) {
    return text + '\n';
  }
  const auto most = static_cast<double>(bounds.rbegin()->first);
  text += fmt::format(
      "\nGuaranteed error of {2:.0f} directions in any environment (eq. 43; rho {0:.3g}, R2/A "
      "{1:.3g}): "
      "{3:.2g} %\n",
      measures.rho_max, measures.size_ratio, most,
      100 * heterogeneous_error_bound(measures.rho_max, measures.size_ratio,
                                      star_discrepancy_bound(most)));
  return text;
}

}  // namespace transillum::cli
