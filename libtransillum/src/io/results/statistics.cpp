// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Options, statistics and error estimate of a solve as JSON. data/FILES.md lists the keys.
#include <nlohmann/json.hpp>
#include <ostream>

#include "io/results/result_writers.h"
#include "io/results/statistics_files.h"
#include "options/option_table.h"
#include "transillum/at.h"
#include "transillum/files.h"

namespace transillum {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Rgb& color) { return {color.r, color.g, color.b}; }

template <typename Record, typename ValueOf>
Json list_of(const std::vector<Record>& steps, ValueOf value_of) {
  Json list = Json::array();
  for (const Record& step : steps) {
    list.push_back(value_of(step));
  }
  return list;
}

/// The errors by surface; null where they are not estimated.
Json surfaces_json(const SurfaceErrors& errors) {
  if (errors.surfaces.empty()) {
    return {};
  }
  return {{"limit", errors.limit},
          {"worst", errors.surfaces[static_cast<std::size_t>(errors.worst)].name},
          {"surfaces", list_of(errors.surfaces, [](const SurfaceError& s) {
             return Json{{"name", s.name},   {"patches", s.patches}, {"area", s.area},
                         {"level", s.level}, {"dark", s.is_dark},    {"rms", s.rms},
                         {"limit", s.limit}};
           })}};
}

/// The error estimate; null without replicas.
Json error_json(const Solution& solution) {
  const ErrorEstimate& error = solution.error;
  if (error.replicas == 0) {
    return {};
  }
  return {{"replicas", error.replicas},
          {"rms", error.rms},
          {"rms_limit", error.rms_limit},
          {"rms_lowest", error.rms_lowest},
          {"independent_errors", error.independent_errors},
          {"confidence", 0.95},
          {"quantile", error.quantile},
          {"uncertain_patches", uncertain_patches(solution).size()},
          {"mean_B", list_of(error.mean_radiosity)},
          {"mean_B_standard_error", list_of(error.mean_standard_error)},
          {"by_surface", surfaces_json(error.surfaces)}};
}

/// The report of a solve with a goal; null without one.
Json accuracy_json(const std::optional<AccuracyReport>& report) {
  if (!report) {
    return {};
  }
  const AccuracyGoal& goal = report->goal;
  Json stages = Json::array();
  for (const AccuracyStage& stage : report->stages) {
    stages.push_back(
        {{"directions", stage.directions}, {"replicas", stage.replicas}, {"error", stage.error}});
  }
  return {{"asked", goal.accuracy > 0 ? Json(goal.accuracy) : Json()},
          {"of", name_of_accuracy(goal)},
          {"seconds", goal.seconds > 0 ? Json(goal.seconds) : Json()},
          {"error", report->error},
          {"surface", report->surface.empty() ? Json() : Json(report->surface)},
          {"dark", report->is_dark},
          {"confidence", 0.95},
          {"reached", report->reached},
          {"trusted", report->trusted},
          {"obstacle", report->obstacle == AccuracyObstacle::none
                           ? Json()
                           : Json(name_of(report->obstacle))},
          {"passes_made", report->passes_made},
          {"stages", stages}};
}

/// Values about lobes; null where none took part.
Json glossy_json(const GlossyStatistics& counted) {
  if (counted.patches == 0) {
    return {};
  }
  return {{"patches", counted.patches},
          {"lobes", counted.lobes},
          {"sum_error", counted.sum_error},
          {"sum_defect", counted.sum_defect},
          {"spread", counted.spread},
          {"exponent", counted.exponent},
          {"radiance_bytes", counted.radiance_bytes},
          {"lobe_bytes", counted.lobe_bytes},
          {"transfer_bytes", counted.transfer_bytes}};
}

/// The number of faces listed with their cost.
constexpr std::size_t listed_faces = 10;

Json cost_json(const PatchCost& cost) {
  return {{"seconds", cost.seconds},
          {"queries", cost.queries},
          {"candidates", cost.candidates},
          {"exact_queries", cost.exact_queries()}};
}

/// The cost of passes; null where it was not measured.
Json costs_json(const Scene& scene, const PatchCosts* costs) {
  if (costs == nullptr) {
    return {};
  }
  const PatchCost total = costs->total();
  Json json{{"passes", costs->passes}, {"seconds_measuring", costs->seconds}};
  json.update(cost_json(total));
  json["reasons"] = Json::array();
  for (std::size_t k = 1; k < query_failures; ++k) {
    json["reasons"].push_back({{"reason", name_of(static_cast<QueryFailure>(k))},
                               {"repeated_queries", total.repeated[k]},
                               {"exact_queries", total.exact[k]}});
  }
  json["faces"] = list_of(costly_faces(scene, *costs, listed_faces), [&](const FaceCost& face) {
    const Patch& patch = scene.patch(face.patch);
    Json line{{"face", patch.face},
              {"group", patch.group == no_group ? Json() : Json(at(scene.groups(), patch.group))},
              {"material", scene.material(face.patch).name},
              {"patches", face.patches}};
    line.update(cost_json(face.cost));
    line["reason"] = name_of(face.cost.main_reason());
    return line;
  });
  return json;
}

/// Values that are known only after an iteration are null without one.
Json statistics_json(const SolveStatistics& statistics) {
  const bool stepped = statistics.iterations > 0;
  Json json;
  json["patches"] = statistics.patches;
  json["fragments"] = statistics.fragments;
  json["directions"] = statistics.directions;
  json["passes"] = statistics.passes;
  json["passes_made"] = statistics.passes_made;
  json["iterations"] = statistics.iterations;
  json["burn_in"] = statistics.burn_in;
  json["threads"] = statistics.threads;
  json["transfers"] = statistics.transfers;
  json["integrated_pairs"] = statistics.integrated_pairs;
  json["form_factors"] = statistics.form_factors;
  json["kept_form_factors"] = statistics.kept_form_factors;
  json["glossy"] = glossy_json(statistics.glossy);
  json["first_shot"] = {{"sources", statistics.shot_sources},
                        {"power_share", statistics.shot_power_fraction},
                        {"disagreement", statistics.shot_disagreement},
                        {"disagreement_patch", statistics.shot_disagreement_patch}};
  json["converged"] = statistics.converged;
  json["closure_defect_max"] = statistics.closure_defect_max;
  json["closure_defect_grazing"] = statistics.closure_defect_grazing;
  json["closure_defect_moments"] = statistics.closure_defect_moments;
  json["negative_corners"] = statistics.negative_corners;
  json["light_directions"] = statistics.light_directions;
  json["escaped"] = statistics.escaped;
  json["energy_defect"] = stepped ? Json(statistics.energy_defect) : Json();
  json["energy_balance"] = stepped ? Json(statistics.energy_balance) : Json();
  json["rho_max"] = statistics.rho_max;
  json["predicted_contraction"] = statistics.predicted_contraction;
  const auto& steps = statistics.iteration_records;
  json["change"] = list_of(steps, [](const IterationRecord& s) { return s.change; });
  json["contraction"] = list_of(steps, [](const IterationRecord& s) { return s.contraction; });
  json["error"] =
      list_of(steps, [](const IterationRecord& s) { return s.error ? Json(*s.error) : Json(); });
  json["remainder"] = list_of(steps, [](const IterationRecord& s) { return s.remainder; });
  json["remainder_dimmest"] =
      list_of(steps, [](const IterationRecord& s) { return s.remainder_dimmest; });
  json["unlit_area"] = list_of(steps, [](const IterationRecord& s) { return s.unlit_area; });
  json["change_of_b"] = list_of(steps, [](const IterationRecord& s) { return s.change_of_b; });
  json["step_seconds"] = list_of(steps, [](const IterationRecord& s) { return s.seconds; });
  json["refinement"] = list_of(statistics.refinement, [](const RefinementRound& round) {
    return Json{{"patches", round.patches}, {"figure", round.measure}, {"seconds", round.seconds}};
  });
  const PassCounts& counts = statistics.counts;
  json["counters"] = {{"pairs", counts.pairs},
                      {"cuts", counts.cuts},
                      {"decisions", counts.decisions},
                      {"exact_decisions", counts.exact_decisions},
                      {"exact_looks", counts.exact_queries},
                      {"pixels", counts.pixels},
                      {"missed_patches", counts.missed}};
  json["thread_seconds"] = {{"order", counts.seconds_order},
                            {"bins", counts.seconds_bins},
                            {"clip", counts.seconds_clip}};
  json["seconds"] = {{"load", statistics.seconds_load},
                     {"bsp", statistics.seconds_bsp},
                     {"first_shot", statistics.seconds_first_shot},
                     {"transfers", statistics.seconds_transfers},
                     {"iterate", statistics.seconds_iterate},
                     {"total", statistics.seconds_total}};
  return json;
}

}  // namespace

void write_statistics(const std::filesystem::path& path, const RunOptions& options,
                      const Solution& solution) {
  write_statistics(path, options, solution, nullptr);
}

void write_statistics(const std::filesystem::path& path, const RunOptions& options,
                      const Solution& solution, const PatchCosts* costs) {
  Json json;
  json["program"] = "transillum " TRANSILLUM_VERSION;
  json["scene"] = solution.scene->name();
  json["complete"] = solution.complete;
  json["covered_faces"] = solution.scene->report().covered_faces;
  RunOptions used = options;
  used.scene = solution.scene->options();
  json["options"] = options_json(used);
  for (const Option& option : transillum::options()) {
    if (json["options"].contains(option.name) && !why_unused(option.name, {used}).empty()) {
      json["options"][option.name] = nullptr;
    }
  }
  json.update(statistics_json(solution.statistics));
  json["error_estimate"] = error_json(solution);
  json["accuracy"] = accuracy_json(solution.accuracy);
  json["costs"] = costs_json(*solution.scene, costs);
  // nlohmann writes doubles in the shortest form that reads back, and what is not finite as null.
  // A scene's name may be a file name, which need not be UTF-8; JSON must be.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  write_file_whole(path, [&](std::ostream& out) { out << text << '\n'; });
}

using Json = nlohmann::ordered_json;

Json options_json(const RunOptions& run) {
  Json json;
  for (const Option& o : options()) {
    if (o.in_files && !o.reads_scene) {
      json[o.name] = Json::parse(o.to_json(run));
    }
  }
  const int averaged = run.solve.averaged_iterations;
  json["averaged-iterations"] = averaged > 0 ? Json(averaged) : Json();
  return json;
}

}  // namespace transillum
