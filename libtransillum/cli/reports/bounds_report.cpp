// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/reports/bounds_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json_text.h"
#include "sampling/discrepancy.h"
#include "transillum/errors.h"

namespace transillum::cli {
namespace {

using Json = nlohmann::json;

/// Adds the paper's values for row.rho, if its tables have them for the same accuracy and size
/// ratio.
void add_paper_values(BoundsRow& row, const BoundsOptions& options, double size_ratio) {
  const PaperTables& paper = paper_tables();
  const auto found = std::find(paper.rho.begin(), paper.rho.end(), row.rho);
  if (found == paper.rho.end()) {
    return;
  }
  const auto k = static_cast<std::size_t>(found - paper.rho.begin());
  row.paper_contract = paper.to_contract[k];
  if (options.accuracy != PaperTables::accuracy) {
    return;
  }
  row.paper_homogeneous = paper.if_homogeneous[k];
  if (size_ratio == PaperTables::size_ratio) {
    row.paper_heterogeneous = paper.if_heterogeneous[k];
  }
}

BoundsRow make_row(double rho, const BoundsOptions& options, double size_ratio,
                   const BoundsTask& begin, const Cancellation& cancellation) {
  const DirectionSetFamily& sets = options.sets;
  const double accuracy = options.accuracy;
  BoundsRow row;
  row.rho = rho;
  add_paper_values(row, options, size_ratio);
  row.contract = directions_to_contract(rho);
  row.homogeneous = directions_if_homogeneous(rho, accuracy);
  row.heterogeneous = directions_if_heterogeneous(rho, accuracy, size_ratio);
  const auto begin_table = [&](int table) {
    begin(fmt::format("directions for Table {}, rho {}", table, rho));
  };
  begin_table(1);
  row.actual_contract = actual_directions_to_contract(sets, rho, cancellation);
  begin_table(2);
  row.actual_homogeneous = actual_directions_if_homogeneous(sets, rho, accuracy, cancellation);
  begin_table(3);
  row.estimated_heterogeneous =
      estimated_directions_if_heterogeneous(sets, rho, accuracy, size_ratio, cancellation);
  return row;
}

BoundsPrediction predict(double rho, const BoundsOptions& options, double size_ratio,
                         const Cancellation& cancellation) {
  BoundsPrediction p;
  p.rho = rho;
  p.eps_bound = quadrature_error_bound(options.directions);
  p.eps = measured_quadrature_error(options.sets, options.directions, cancellation);
  p.contraction_bound = contraction_bound(rho, p.eps_bound);
  p.contraction = contraction_bound(rho, p.eps);
  p.iterations_bound = iterations_to(options.tolerance, p.contraction_bound);
  p.iterations = iterations_to(options.tolerance, p.contraction);
  p.homogeneous_bound = homogeneous_error_bound(rho, p.eps_bound);
  p.homogeneous = homogeneous_error_bound(rho, p.eps);
  p.heterogeneous_bound =
      heterogeneous_error_bound(rho, size_ratio, star_discrepancy_bound(options.directions));
  return p;
}

Sampling sampling_of(const std::string& name, const std::string& path) {
  try {
    return from_name<Sampling>(name);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

RunEstimate read_run(const std::string& path, double accuracy) {
  const std::string text = read_json_file(path);
  check_json(text, path);
  const Json json = Json::parse(text);
  const auto fail = [&path](const char* what) -> double {
    throw InputError(fmt::format("{}: {}", path, what));
  };
  if (!json.is_object() || !json.contains("options")) {
    fail("not statistics written by solve --stats");
  }
  try {
    RunEstimate run;
    run.scene = json.value("scene", "");
    run.sampling = sampling_of(json.at("options").at("sampling"), path);
    run.passes = json.at("passes");
    const Json estimate = json.value("error_estimate", Json());
    if (!estimate.is_object()) {
      fail("no error estimate; solve with --replicas 4");
    }
    run.error = estimate.at("rms");
    const double replicas = estimate.at("replicas");
    if (!(run.error > 0 && run.passes >= 1 && replicas >= 1)) {
      fail("the error estimate is 0");
    }
    run.estimated_passes =
        estimated_passes_by_replicas(run.sampling, run.passes, replicas, run.error, accuracy);
    return run;
  } catch (const Json::exception&) {
    throw InputError(path + ": not statistics written by solve --stats");
  }
}

}  // namespace

BoundsReport make_bounds_report(const BoundsOptions& options, const BoundsTask& begin,
                                const Cancellation& cancellation) {
  BoundsReport report;
  report.options = options;
  if (!options.run.empty()) {
    report.run = read_run(options.run, options.accuracy);
  }
  if (options.scene) {
    begin("measuring the scene");
    report.measures = measure(*options.scene, cancellation);
  }
  report.size_ratio = options.size_ratio.value_or(report.measures ? report.measures->size_ratio
                                                                  : PaperTables::size_ratio);
  std::optional<double> rho = options.rho;
  if (!rho && report.measures) {
    rho = report.measures->rho_max;
  }
  const auto add_row = [&](double r) {
    report.rows.push_back(make_row(r, options, report.size_ratio, begin, cancellation));
  };
  if (rho) {
    add_row(*rho);
  } else {
    for (const double r : paper_tables().rho) {
      add_row(r);
    }
  }
  if (rho) {
    begin("quadrature error");
    report.prediction = predict(*rho, options, report.size_ratio, cancellation);
  }
  return report;
}

}  // namespace transillum::cli
