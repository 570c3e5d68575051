// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/reports/bounds_report.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string count_text(double m) {
  return m < 1e6 ? fmt::format("{:.0f}", m) : fmt::format("{:.2e}", m);
}

template <class Number>
std::string count_text(const std::optional<Number>& m, const char* none) {
  return m ? count_text(static_cast<double>(*m)) : none;
}

std::string percent_text(double fraction) {
  return fraction > 1 ? std::string("> 100 %") : fmt::format("{:.3g} %", 100 * fraction);
}

std::string table_row(const std::string& rho, const std::string& paper, const std::string& formula,
                      const std::string& actual) {
  return fmt::format("  {:>8} {:>12} {:>12} {:>22}\n", rho, paper, formula, actual);
}

std::string prediction_row(const std::string& name, const std::string& bound,
                           const std::string& measured) {
  return fmt::format("  {:<36} {:>14} {:>14}\n", name, bound, measured);
}

std::string rho_text(double rho) { return fmt::format("{:.6g}", rho); }

std::string tables_text(const BoundsReport& report) {
  const BoundsOptions& options = report.options;
  const std::string set =
      name_of(options.sets.sampling) + (options.sets.two_way ? "" : ", one-way");
  const std::string accuracy = percent_text(options.accuracy);
  std::string text = "Table 1: number of directions M for convergence of the iteration (eq. 24)\n";
  text += table_row("rho", "paper", "formula", set);
  for (const BoundsRow& r : report.rows) {
    text += table_row(rho_text(r.rho), count_text(r.paper_contract, "-"), count_text(r.contract),
                      count_text(r.actual_contract, "> 65536"));
  }
  text += fmt::format(
      "\nTable 2: M for an error of {} in a nearly homogeneous environment (eq. 37)\n", accuracy);
  text += table_row("rho", "paper", "formula", set);
  for (const BoundsRow& r : report.rows) {
    text += table_row(rho_text(r.rho), count_text(r.paper_homogeneous, "-"),
                      count_text(r.homogeneous), count_text(r.actual_homogeneous, "> 65536"));
  }
  text +=
      fmt::format("\nTable 3: M for an error of {} in any environment, R2/A = {:.4g} (eq. 43)\n",
                  accuracy, report.size_ratio);
  text += table_row("rho", "paper", "formula", set + ", estimated");
  for (const BoundsRow& r : report.rows) {
    text += table_row(rho_text(r.rho), count_text(r.paper_heterogeneous, "-"),
                      count_text(r.heterogeneous), count_text(r.estimated_heterogeneous, "-"));
  }
  text += fmt::format(
      "\npaper: values printed in the paper. formula: the equations with the bounds for "
      "Hammersley points\n(eq. 20 and 21). {}: the equations with the measured errors of "
      "such directions{}: eps(M)\nover all normals; star discrepancy of the points, "
      "extrapolated to larger M.\n",
      name_of(options.sets.sampling), options.sets.two_way ? " and their opposites" : "");
  if (options.sets.sampling == Sampling::antipodal) {
    text +=
        "Table 3 is not estimated for antipodal sets: they are evenly spread on the sphere, not on "
        "the unit square,\nwhere the star discrepancy is measured.\n";
  }
  return text;
}

std::string prediction_text(const BoundsReport& report) {
  const BoundsPrediction& p = *report.prediction;
  const BoundsOptions& options = report.options;
  std::string text =
      fmt::format("\nPrediction for rho = {:.6g} and M = {}\n", p.rho, options.directions);
  text += prediction_row("", "guaranteed", name_of(options.sets.sampling));
  text += prediction_row("eps(M)  (eq. 21, 17)", fmt::format("{:.3g}", p.eps_bound),
                         fmt::format("{:.3g}", p.eps));
  text += prediction_row("contraction per iteration  (eq. 22)",
                         fmt::format("{:.6f}", p.contraction_bound),
                         fmt::format("{:.6f}", p.contraction));
  text += prediction_row(fmt::format("iterations to {:.3g}  (eq. 25)", options.tolerance),
                         count_text(p.iterations_bound, "may diverge"),
                         count_text(p.iterations, "may diverge"));
  text += prediction_row("error, nearly homogeneous  (eq. 37)", percent_text(p.homogeneous_bound),
                         percent_text(p.homogeneous));
  text +=
      prediction_row("error, any environment  (eq. 43)", percent_text(p.heterogeneous_bound), "");
  return text;
}

std::string scene_text(const BoundsReport& report) {
  const SceneMeasures& m = *report.measures;
  const Scene& scene = *report.options.scene;
  std::string text =
      fmt::format("{:<18} {}, {} patches\n", "scene", scene.name(), scene.patch_count());
  text += fmt::format("{:<18} {:.6g}\n", "rho max", m.rho_max);
  text +=
      fmt::format("{:<18} {:.4g}: extent R = {:.4g} m, smallest patch {} with A = {:.3g} m2\n\n",
                  "R2/A", m.size_ratio, m.extent, m.smallest, m.smallest_area);
  return text;
}

std::string directions_text(const BoundsReport& report) {
  const BoundsRow& r = report.rows.front();
  std::string text = fmt::format("\nDirections for {}\n", percent_text(report.options.accuracy));
  text += prediction_row("", "guaranteed", "estimated");
  text += prediction_row("nearly homogeneous  (eq. 37)", count_text(r.homogeneous),
                         count_text(r.actual_homogeneous, "> 65536"));
  text += prediction_row("any environment  (eq. 43)", count_text(r.heterogeneous),
                         count_text(r.estimated_heterogeneous, "-"));
  return text;
}

std::string run_text(const BoundsReport& report) {
  const RunEstimate& run = *report.run;
  return fmt::format(
      "\nEstimated from the solve run ({}: {} RMS error of B with {} passes, {}):\n"
      "  M = {:<12} for {}\n",
      run.scene, percent_text(run.error), run.passes, name_of(run.sampling),
      count_text(run.estimated_passes), percent_text(report.options.accuracy));
}

template <class Number>
OrderedJson json_of(const std::optional<Number>& number) {
  return number ? OrderedJson(*number) : OrderedJson();
}

OrderedJson json_of(const BoundsRow& r) {
  return {{"rho", r.rho},
          {"converges",
           {{"paper", json_of(r.paper_contract)},
            {"formula", r.contract},
            {"actual", json_of(r.actual_contract)}}},
          {"homogeneous",
           {{"paper", json_of(r.paper_homogeneous)},
            {"formula", r.homogeneous},
            {"actual", json_of(r.actual_homogeneous)}}},
          {"heterogeneous",
           {{"paper", json_of(r.paper_heterogeneous)},
            {"formula", r.heterogeneous},
            {"estimated", json_of(r.estimated_heterogeneous)}}}};
}

OrderedJson json_of(const BoundsPrediction& p) {
  return {{"rho", p.rho},
          {"eps", {{"bound", p.eps_bound}, {"actual", p.eps}}},
          {"contraction", {{"bound", p.contraction_bound}, {"actual", p.contraction}}},
          {"steps", {{"bound", json_of(p.iterations_bound)}, {"actual", json_of(p.iterations)}}},
          {"homogeneous_error", {{"bound", p.homogeneous_bound}, {"actual", p.homogeneous}}},
          {"heterogeneous_error", {{"bound", p.heterogeneous_bound}}}};
}

}  // namespace

std::string text_of(const BoundsReport& report) {
  std::string text;
  if (report.measures) {
    text += scene_text(report);
  }
  text += tables_text(report);
  if (report.prediction) {
    text += prediction_text(report) + directions_text(report);
  }
  if (report.run) {
    text += run_text(report);
  }
  return text;
}

void write_bounds_report(const std::string& path, const BoundsReport& report) {
  const BoundsOptions& options = report.options;
  OrderedJson json;
  json["program"] = "transillum " TRANSILLUM_VERSION;
  json["accuracy"] = options.accuracy;
  json["size_ratio"] = report.size_ratio;
  json["tolerance"] = options.tolerance;
  json["directions"] = options.directions;
  json["sampling"] = name_of(options.sets.sampling);
  json["two_way"] = options.sets.two_way;
  json["tables"] = OrderedJson::array();
  for (const BoundsRow& r : report.rows) {
    json["tables"].push_back(json_of(r));
  }
  json["prediction"] = report.prediction ? json_of(*report.prediction) : OrderedJson();
  json["scene"] = OrderedJson();
  if (report.measures) {
    const SceneMeasures& m = *report.measures;
    json["scene"] = {{"name", options.scene->name()},
                     {"rho_max", m.rho_max},
                     {"extent", m.extent},
                     {"smallest_patch", m.smallest},
                     {"smallest_area", m.smallest_area},
                     {"size_ratio", m.size_ratio}};
  }
  json["run"] = OrderedJson();
  if (report.run) {
    json["run"] = {{"scene", report.run->scene},
                   {"passes", report.run->passes},
                   {"rms_error", report.run->error},
                   {"estimated_passes", report.run->estimated_passes}};
  }
  const std::string text = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
  write_file_whole(path, [&](std::ostream& out) { out << text << '\n'; });
}

}  // namespace transillum::cli
