// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/reports/direction_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "cli/reports/report_text.h"
#include "transillum/bounds.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Number of normals that represent all directions if there is no scene.
constexpr int spread_normal_count = 2048;

std::vector<Vec3> normals_of(const Scene& scene) {
  std::vector<Vec3> normals;
  for (const Patch& patch : scene.patches()) {
    normals.push_back(patch.normal);
  }
  return normals;
}

std::string errors_text(const DirectionStatistics& s, const std::vector<double>& errors) {
  const QuadratureErrors summary = summary_of(errors);
  std::string text = fmt::format("{:.2e} RMS, {:.2e} largest", summary.rms, summary.max);
  if (s.scene) {
    const auto worst = std::max_element(
        errors.begin(), errors.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    text += fmt::format(", patch {}", worst - errors.begin());
  }
  return text;
}

OrderedJson errors_json(const DirectionStatistics& s, const std::vector<double>& errors) {
  const QuadratureErrors summary = summary_of(errors);
  OrderedJson json{{"rms", summary.rms}, {"max", summary.max}};
  if (s.scene) {
    json["patches"] = errors;
  }
  return json;
}

}  // namespace

DirectionStatistics measure_directions(const SolveOptions& set,
                                       const std::vector<DirectionSample>& samples,
                                       std::shared_ptr<const Scene> scene,
                                       const Cancellation& cancellation) {
  DirectionStatistics s;
  s.set = set;
  s.star = star_discrepancy(samples, cancellation);
  s.cap = cap_discrepancy(samples, cancellation);
  const auto both = with_opposites(samples);
  s.star_two_way = star_discrepancy(both, cancellation);
  s.cap_two_way = cap_discrepancy(both, cancellation);
  const std::vector<Vec3> normals =
      scene ? normals_of(*scene) : spread_normals(spread_normal_count);
  s.one_way = quadrature_errors(normals, samples, false, cancellation);
  s.two_way = quadrature_errors(normals, samples, true, cancellation);
  s.scene = std::move(scene);
  return s;
}

std::string text_of(const DirectionStatistics& s) {
  const int m = s.set.directions;
  std::string text =
      report_row("directions", fmt::format("{}, {}{}", m, name_of(s.set.used_sampling()),
                                           s.set.rotation ? ", rotated" : ""));
  text += report_row("star discrepancy",
                     fmt::format("{:.3e} on the unit square, exact (eq. 3)", s.star));
  text += report_row(
      "", fmt::format("at most {:.3e} for hammersley (eq. 20)", star_discrepancy_bound(m)));
  text += report_row("", fmt::format("{:.3e} with the opposites", s.star_two_way));
  text += report_row("cap discrepancy", fmt::format("{:.3e} on the sphere, {}", s.cap.value,
                                                    s.cap.exact ? "exact" : "a lower bound"));
  text += report_row("", fmt::format("{:.3e} with the opposites, {}", s.cap_two_way.value,
                                     s.cap_two_way.exact ? "exact" : "a lower bound"));
  text += fmt::format(
      "\nQuadrature error eps(M) of the integral of the cosine, exact value pi (eq. 17), over {} "
      "{}:\n",
      s.one_way.size(),
      s.scene ? "patches of " + s.scene->name() : std::string("normals over the sphere"));
  text += report_row("  one-way", errors_text(s, s.one_way));
  text += report_row("  two-way", errors_text(s, s.two_way));
  text += report_row(
      "  bound", fmt::format("{:.2e} for hammersley, one-way (eq. 21)", quadrature_error_bound(m)));
  return text;
}

void write_direction_statistics(const std::string& path, const DirectionStatistics& s) {
  OrderedJson json;
  json["program"] = "transillum " TRANSILLUM_VERSION;
  json["directions"] = s.set.directions;
  json["sampling"] = name_of(s.set.used_sampling());
  json["seed"] = s.set.seed;
  json["rotation"] = s.set.rotation ? OrderedJson(*s.set.rotation) : OrderedJson();
  json["star_discrepancy"] = {{"value", s.star},
                              {"two_way", s.star_two_way},
                              {"bound", star_discrepancy_bound(s.set.directions)}};
  json["cap_discrepancy"] = {{"value", s.cap.value},
                             {"exact", s.cap.exact},
                             {"two_way", s.cap_two_way.value},
                             {"two_way_exact", s.cap_two_way.exact}};
  json["scene"] = s.scene ? OrderedJson(s.scene->name()) : OrderedJson();
  json["eps"] = {{"normals", s.one_way.size()},
                 {"bound", quadrature_error_bound(s.set.directions)},
                 {"one_way", errors_json(s, s.one_way)},
                 {"two_way", errors_json(s, s.two_way)}};
  const std::string text = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
  write_file_whole(path, [&](std::ostream& out) { out << text << '\n'; });
}

}  // namespace transillum::cli
