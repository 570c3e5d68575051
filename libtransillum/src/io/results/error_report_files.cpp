// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The errors of a solve by surface and cause, as a page (HTML) or as JSON. data/FILES.md lists the
// keys.
#include "io/results/error_report_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/text_file.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The causes in the order of columns.
struct Cause {
  const char* name;  ///< key and class
  double CauseErrors::*error;
};
constexpr Cause causes[] = {{"directions", &CauseErrors::directions},
                            {"patches", &CauseErrors::patches},
                            {"iterations", &CauseErrors::iterations},
                            {"method", &CauseErrors::method}};

const char* kind_name(NextStep::Kind kind) {
  switch (kind) {
    case NextStep::Kind::divide_surface:
      return "divide-surface";
    case NextStep::Kind::divide_all:
      return "divide-all";
    case NextStep::Kind::directions:
      return "directions";
    case NextStep::Kind::iterations:
      break;
  }
  return "iterations";
}

/// 2400 -> "2,400".
std::string with_separators(std::int64_t number) {
  std::string text = fmt::to_string(number);
  for (std::ptrdiff_t place = std::ssize(text) - 3; place > 0; place -= 3) {
    text.insert(static_cast<std::size_t>(place), ",");
  }
  return text;
}

std::string duration(double seconds) {
  return seconds < 120 ? fmt::format("{:.2g} s", seconds)
                       : fmt::format("{:.0f} min", std::ceil(seconds / 60));
}

double root_mean_square(const Rgb& c) { return std::sqrt((c.r * c.r + c.g * c.g + c.b * c.b) / 3); }

OrderedJson errors_json(const CauseErrors& errors) {
  OrderedJson json;
  for (const Cause& cause : causes) {
    json[cause.name] = errors.*cause.error;
  }
  json["total"] = errors.total();
  return json;
}

OrderedJson measurements_json(const ErrorMeasurements& m) {
  return {{"replicas", m.replicas},
          {"replicas_added", m.replicas_added},
          {"divided_patches", m.divided_patches},
          {"divided_fraction", m.divided_fraction},
          {"divided_seconds", m.divided_seconds},
          {"compared_directions", m.compared_directions},
          {"compared_with", name_of(m.reference)},
          {"exact_queries", m.exact_queries},
          {"lost", m.lost ? OrderedJson(*m.lost) : OrderedJson()},
          {"seconds", m.seconds}};
}

OrderedJson report_json(const ErrorReport& report, const MeasuredSolve& solve) {
  OrderedJson json;
  json["program"] = "transillum " TRANSILLUM_VERSION;
  json["scene"] = solve.solution.scene->name();
  json["patches"] = solve.solution.scene->patch_count();
  json["passes"] = solve.options.directions;
  json["total"] = report.total();
  json["worst"] =
      report.worst < 0 ? OrderedJson() : OrderedJson(at(report.surfaces, report.worst).name);
  json["surfaces"] = OrderedJson::array();
  for (const SurfaceCauses& surface : report.surfaces) {
    json["surfaces"].push_back({{"name", surface.name},
                                {"patches", surface.patches},
                                {"area", surface.area},
                                {"unit", root_mean_square(surface.unit)},
                                {"dark", surface.is_dark},
                                {"errors", errors_json(surface.errors)},
                                {"divided_alone", surface.divided_alone},
                                {"divided_all", surface.divided_all}});
  }
  json["steps"] = OrderedJson::array();
  for (const NextStep& step : report.steps) {
    json["steps"].push_back({{"kind", kind_name(step.kind)},
                             {"surface", step.surface},
                             {"patches", step.patches},
                             {"passes", step.passes},
                             {"tolerance", step.tolerance},
                             {"seconds", step.seconds},
                             {"from", step.from},
                             {"to", step.to},
                             {"text", step_text(step)}});
  }
  json["measurements"] = measurements_json(report.measurements);
  return json;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return result;
}

constexpr const char* page_head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>How wrong is it? {0}</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ font: 16px/1.5 system-ui, sans-serif; max-width: 58rem; margin: 2rem auto; padding: 0 1rem; }}
h1 {{ font-size: 1.4rem; }} h2 {{ font-size: 1.1rem; margin-top: 2rem; }}
table {{ border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .3rem .6rem; text-align: right; border-bottom: 1px solid #8884; }}
th:first-child, td:first-child {{ text-align: left; }}
td.bar {{ width: 35%; }} .total {{ font-weight: 600; }}
.bar div {{ display: flex; height: .8rem; }}
.directions {{ background: #4477aa; }} .patches {{ background: #ee8866; }}
.iterations {{ background: #228833; }} .method {{ background: #999999; }}
.key {{ display: inline-block; width: .8rem; height: .8rem; margin-right: .3rem; }}
.note {{ opacity: .75; font-size: .9rem; }}
</style>
</head>
<body>
)";

/// The four errors of a surface as one bar; `largest` is as long as the cell.
std::string bar(const CauseErrors& errors, double largest) {
  std::string text = "<div>";
  for (const Cause& cause : causes) {
    const double width = largest > 0 ? 100 * (errors.*cause.error) / largest : 0;
    text += fmt::format("<span class=\"{}\" style=\"width:{:.2f}%\"></span>", cause.name,
                        std::isfinite(width) ? width : 100);
  }
  return text + "</div>";
}

void write_table(std::ostream& out, const ErrorReport& report) {
  out << "<table>\n<tr><th>surface</th>";
  for (const Cause& cause : causes) {
    out << "<th><span class=\"key " << cause.name << "\"></span>" << cause.name << "</th>";
  }
  out << "<th>total</th><th></th></tr>\n";
  for (const SurfaceCauses& surface : report.surfaces) {
    out << "<tr><td>" << escaped(surface.name) << (surface.is_dark ? " (dark)" : "") << "</td>";
    for (const Cause& cause : causes) {
      out << "<td>" << error_percentage(surface.errors.*cause.error) << "</td>";
    }
    out << "<td class=\"total\">" << error_percentage(surface.errors.total())
        << "</td><td class=\"bar\">" << bar(surface.errors, report.total()) << "</td></tr>\n";
  }
  out << "</table>\n";
}

std::string lost_text(const ErrorMeasurements& m) {
  return m.lost ? fmt::format("The scene is closed; {} of what its patches see is lost.",
                              error_percentage(*m.lost))
                : std::string("The scene is open, so that closure shows nothing.");
}

void write_measurements(std::ostream& out, const ErrorMeasurements& m) {
  out << fmt::format(
      "<h2>How it was measured</h2>\n<table>\n"
      "<tr><td>directions</td><td>limit that holds in 95 % of all runs, by the spread of {} "
      "rotated sets of directions{}</td></tr>\n"
      "<tr><td>patches</td><td>a solve of {} patches, {} of the scene's divided, by the same "
      "directions, {}</td></tr>\n"
      "<tr><td>iterations</td><td>bound by the last change and the contraction</td></tr>\n"
      "<tr><td>method</td><td>engine {} along {} directions. {} Visibility queries repeated in "
      "exact arithmetic: {}.</td></tr>\n</table>\n",
      m.replicas, m.replicas_added ? ", for which the solve was repeated" : "",
      with_separators(m.divided_patches),
      m.divided_fraction < 1 ? error_percentage(m.divided_fraction) : "each",
      duration(m.divided_seconds), name_of(m.reference), m.compared_directions, lost_text(m),
      with_separators(m.exact_queries));
}

void write_page(std::ostream& out, const ErrorReport& report, const MeasuredSolve& solve) {
  const std::string scene = escaped(solve.solution.scene->name());
  out << fmt::format(fmt::runtime(page_head), scene);
  out << "<h1>How wrong is it? " << scene << "</h1>\n";
  if (report.worst >= 0) {
    out << fmt::format(
        "<p>The worst surface, <b>{}</b>, is off by at most about <b>{}</b> of its reflected "
        "light.</p>\n",
        escaped(at(report.surfaces, report.worst).name), error_percentage(report.total()));
  }
  out << fmt::format(
      "<p class=\"note\">{} patches, {} passes per iteration. Errors are RMS over a "
      "surface, over its RMS reflected light; the total is their sum.</p>\n",
      with_separators(solve.solution.scene->patch_count()),
      with_separators(solve.options.directions));
  write_table(out, report);
  out << "<h2>What to do next</h2>\n";
  if (report.steps.empty()) {
    out << "<p>No single step makes the worst surface more accurate.</p>\n";
  } else {
    out << "<ol>\n";
    for (const NextStep& step : report.steps) {
      out << "<li>" << escaped(step_text(step)) << "</li>\n";
    }
    out << "</ol>\n<p class=\"note\">Of the whole solve, by the measured times; the error is the "
           "worst surface's, before and after. Most gain for its work first.</p>\n";
  }
  write_measurements(out, report.measurements);
  out << "</body>\n</html>\n";
}

}  // namespace

std::string error_percentage(double error) {
  constexpr double least = 1e-6;
  return error < least ? "0 %"
         : error < 1   ? fmt::format("{:.2g} %", 100 * error)
                       : fmt::format("{:.0f} %", 100 * error);
}

std::string step_text(const NextStep& step) {
  std::string what;
  switch (step.kind) {
    case NextStep::Kind::divide_surface:
      what = fmt::format("divide {}: {} patches", step.surface, with_separators(step.patches));
      break;
    case NextStep::Kind::divide_all:
      what = fmt::format("divide all surfaces: {} patches", with_separators(step.patches));
      break;
    case NextStep::Kind::directions:
      what = fmt::format("more directions: {} passes", with_separators(step.passes));
      break;
    case NextStep::Kind::iterations:
      what = fmt::format("more iterations: tolerance {:.1g}", step.tolerance);
      break;
  }
  return fmt::format("{}, {}, {} to {}", what, duration(step.seconds), error_percentage(step.from),
                     error_percentage(step.to));
}

void check_error_report_path(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending != ".html" && ending != ".json") {
    throw InputError(
        fmt::format("{}: the name of an error report must end in .html or .json", path.string()));
  }
  check_writable(path);
}

void write_error_report(const std::filesystem::path& path, const ErrorReport& report,
                        const MeasuredSolve& solve) {
  check_error_report_path(path);
  const bool is_json = lower_case_ending(path) == ".json";
  write_file_whole(path, [&](std::ostream& out) {
    if (is_json) {
      out << report_json(report, solve).dump(2, ' ', false, OrderedJson::error_handler_t::replace)
          << "\n";
    } else {
      write_page(out, report, solve);
    }
  });
}

}  // namespace transillum
