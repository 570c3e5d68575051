// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Figures of lessons, from solves and recorded maps of the page's scene. The map of a direction
// holds, for each step, the polygons directly above its fragment: the inside list.
#include "lessons/figure_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "colors/color_scale.h"
#include "model/snapshot_values.h"
#include "radiosity/analysis/function_comparison.h"
#include "scene/build/patch_count.h"
#include "transillum/glossy.h"
#include "transillum/material_changes.h"
#include "transillum/refinement.h"
#include "transillum/solve_session.h"
#include "transillum/study.h"

namespace transillum::viewer {

/// A solve. It is finished, and has form factors, only where a figure needs them.
struct FigureValues::Run {
  SolveOptions options;
  RadiositySolver solver;
  FormFactors form_factors = {};
  std::vector<double> jumps = {};
  /// The solutions of runs in which lobes take part, by the changes of materials.
  std::vector<std::pair<std::vector<MaterialChange>, Solution>> with_lobes = {};
};

/// A solve of the scene with other patches.
struct FigureValues::Divided {
  double patch_area;
  SolveOptions options;
  Solution solution;
};

namespace {

bool holds(const std::vector<PatchId>& list, PatchId patch) {
  return std::find(list.begin(), list.end(), patch) != list.end();
}

ErrorEstimate estimate_of(const RadiositySolver& solver) {
  ErrorEstimate estimate = solver.error_estimate();
  if (estimate.replicas == 0) {
    throw InputError("an error estimate needs replicas, and the run has none");
  }
  return estimate;
}

}  // namespace

FigureValues::FigureValues(std::shared_ptr<const LoadedScene> loaded, Cancellation cancellation)
    : loaded_(std::move(loaded)), cancellation_(std::move(cancellation)) {}

FigureValues::~FigureValues() = default;

void FigureValues::check_patch(PatchId patch) const {
  const PatchId patches = loaded_->scene->patch_count();
  if (patch < 0 || patch >= patches) {
    throw InputError("there is no patch " + std::to_string(patch) + "; the scene has 0 to " +
                     std::to_string(patches - 1));
  }
}

FigureValues::Run& FigureValues::run_of(const SolveOptions& options) {
  const auto known = std::find_if(runs_.begin(), runs_.end(),
                                  [&](const auto& run) { return run->options == options; });
  if (known != runs_.end()) {
    return **known;
  }
  auto run = std::make_unique<Run>(Run{
      options, RadiositySolver(loaded_->scene, options, {.tree = loaded_->tree}, cancellation_)});
  run->solver.keep_form_factors();
  return *runs_.emplace_back(std::move(run));
}

const RadiositySolver& FigureValues::solved(const SolveOptions& options) {
  Run& run = run_of(options);
  if (!run.solver.progress().finished) {
    run.solver.advance(RadiositySolver::Until::finished);
  }
  return run.solver;
}

const Solution* FigureValues::solved_with_lobes(const SolveOptions& options,
                                                const std::vector<MaterialChange>& changes) {
  if (!options.glossy || !has_lobes(*loaded_->scene)) {
    return nullptr;
  }
  auto& known = run_of(options).with_lobes;
  for (const auto& [of_changes, solution] : known) {
    if (of_changes == changes) {
      return &solution;
    }
  }
  std::shared_ptr<const Scene> scene = loaded_->scene;
  if (!changes.empty()) {
    if (!loaded_->description) {
      throw InputError("materials of a result cannot be changed");
    }
    SceneDescription changed = *loaded_->description;
    change_materials(changed, changes);
    scene = std::make_shared<const Scene>(changed, scene->options(), cancellation_);
  }
  GlossySolver solver(scene, options, changes.empty() ? loaded_->tree : nullptr, cancellation_);
  solver.solve();
  known.emplace_back(changes, solver.solution());
  return &known.back().second;
}

Rgb FigureValues::light_of(const Figure& figure) {
  const Solution* glossy = solved_with_lobes(figure.solve, figure.changes);
  const PatchId patch = figure.patch;
  if (figure.kind == FigureKind::irradiance) {
    return at(glossy ? glossy->irradiance : solved(figure.solve).irradiance(), patch);
  }
  if (figure.kind == FigureKind::radiosity) {
    return at(glossy ? glossy->radiosity : solved(figure.solve).radiosity(), patch);
  }
  if (glossy) {
    const Vec3 to_eye = figure.eye - loaded_->scene->patch(patch).center;
    return glossy->glossy->radiance(patch, normalized(to_eye));
  }
  return std::numbers::inv_pi * at(solved(figure.solve).radiosity(), patch);
}

const MapHistory& FigureValues::history_of(const Figure& figure) {
  const RadiositySolver& solver = run_of(figure.solve).solver;
  const int passes = solver.progress().passes;
  if (figure.direction >= passes) {
    throw InputError("there is no direction " + std::to_string(figure.direction + 1) +
                     "; the run has 1 to " + std::to_string(passes));
  }
  const Vec3 omega = solver.direction(figure.iteration, figure.direction);
  for (const auto& [known, history] : histories_) {
    if (known.x == omega.x && known.y == omega.y && known.z == omega.z) {
      return history;
    }
  }
  return histories_
      .emplace_back(
          omega,
          MapHistory(
              record_local_map(*loaded_->scene, *loaded_->tree, omega, cancellation_).record))
      .second;
}

const std::vector<Rgb>& FigureValues::reference_of(const Figure& figure) {
  auto& reference = references_[figure.reference];
  if (reference.empty()) {
    SolveOptions options = reference_options(figure.reference);
    options.first_shot = first_shot_where_it_pays;
    reference = solve_reference(loaded_->scene, loaded_->tree, options, {}, cancellation_);
  }
  return reference;
}

double FigureValues::covered(const Figure& figure) {
  const std::vector<Rgb>& reference = reference_of(figure);
  const RadiositySolver& solver = solved(figure.solve);
  const ErrorEstimate estimate = estimate_of(solver);
  int inside = 0, all = 0;
  for (PatchId i = 0; i < loaded_->scene->patch_count(); ++i) {
    if (luminance(loaded_->scene->exitance(i)) > 0 || luminance(at(reference, i)) == 0) {
      continue;
    }
    const Rgb error = at(solver.radiosity(), i) - at(reference, i);
    const Rgb bar = estimate.quantile * at(estimate.standard_error, i);
    inside += int(std::abs(error.r) <= bar.r) + int(std::abs(error.g) <= bar.g) +
              int(std::abs(error.b) <= bar.b);
    all += 3;
  }
  return static_cast<double>(inside) / all;
}

double FigureValues::error_of(const Figure& figure) {
  const std::vector<Rgb>& reference = reference_of(figure);
  return radiosity_error(*loaded_->scene, solved(figure.solve).radiosity(), reference).rms;
}

const Solution& FigureValues::divided(double patch_area, const SolveOptions& options) {
  for (const auto& known : divided_) {
    if (known->patch_area == patch_area && known->options == options) {
      return known->solution;
    }
  }
  if (!loaded_->description) {
    throw InputError("a result has the patches of its file; other patches need its scene");
  }
  SceneOptions scene_options = loaded_->scene->options();
  scene_options.max_patch_area = 0;
  if (patch_area > 0) {  // a file may ask for any number of patches
    const Scene whole(*loaded_->description, scene_options, cancellation_);
    check_memory(whole.name(), count_patches(whole, patch_area), options.replicas,
                 options.basis == Basis::linear ? 3 : 1);
  }
  scene_options.max_patch_area = patch_area;
  const auto scene =
      std::make_shared<const Scene>(*loaded_->description, scene_options, cancellation_);
  Solution solution = solve(scene, options, {}, cancellation_);
  cancellation_.throw_if_canceled();
  return divided_
      .emplace_back(std::make_unique<Divided>(Divided{patch_area, options, std::move(solution)}))
      ->solution;
}

double FigureValues::function_error(const Figure& figure) {
  SolveOptions options = figure.solve;
  options.basis = Basis::linear;
  const Solution& reference = divided(figure.reference_area, options);
  return compare_functions(reference, divided(figure.patch_area, figure.solve)).l2;
}

double FigureValues::of_run(const Figure& figure) {
  const Solution* glossy = solved_with_lobes(figure.solve);
  const SolveStatistics statistics =
      glossy ? glossy->statistics : solved(figure.solve).statistics();
  switch (figure.kind) {
    case FigureKind::directions:
      return statistics.directions;
    case FigureKind::iterations:
      return statistics.iterations;
    case FigureKind::contraction:
      return statistics.iteration_records.back().contraction;
    case FigureKind::light_directions:
      return statistics.light_directions / figure.solve.replicas;
    default:
      break;
  }
  const ErrorEstimate estimate = estimate_of(solved(figure.solve));
  return figure.kind == FigureKind::estimated_error ? estimate.rms : estimate.rms_limit;
}

/// The rows of the map that the figure is about: fragments of patch i, or the polygons directly
/// above them or above the patches of `others`.
std::vector<std::int32_t> FigureValues::rows_of(const Figure& figure) {
  const MapHistory& history = history_of(figure);
  const bool counts = figure.kind == FigureKind::above;
  std::vector<std::int32_t> rows;
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    const MapHistory::Step& step = history.step(k);
    if (counts ? !holds(figure.others, step.patch) : step.patch != figure.patch) {
      continue;
    }
    if (figure.kind == FigureKind::projected_area && step.row != MapRecord::no_row) {
      rows.push_back(step.row);
    }
    if (figure.kind == FigureKind::projected_area) {
      continue;
    }
    for (const std::int32_t r : history.inside_at(k)) {
      const PatchId patch = history.row(r).patch;
      const std::string& material = figure.material;
      const auto& scene = *loaded_->scene;
      const bool taken = counts ? !holds(figure.others, patch) &&
                                      (material.empty() || scene.material(patch).name == material)
                                : figure.others.empty() || holds(figure.others, patch);
      if (taken) {
        rows.push_back(r);
      }
    }
  }
  return rows;
}

double FigureValues::of_direction(const Figure& figure) {
  const MapHistory& history = history_of(figure);
  if (figure.kind == FigureKind::steps) {
    return history.step_count();
  }
  if (figure.kind == FigureKind::polygons) {
    std::int32_t most = 0;
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      most = std::max(most, history.step(k).map_size);
    }
    return most;
  }
  double area = 0;
  std::set<PatchId> patches;
  for (const std::int32_t r : rows_of(figure)) {
    area += history.record().area(history.row(r));
    patches.insert(history.row(r).patch);
  }
  const bool counts = figure.kind == FigureKind::seen || figure.kind == FigureKind::above;
  return counts ? static_cast<double>(patches.size()) : area;
}

double FigureValues::form_factor(const Figure& figure) {
  const RadiositySolver& solver = solved(figure.solve);
  if (figure.kind == FigureKind::form_factor_sum) {
    return at(solver.form_factor_sums(), figure.patch);
  }
  FormFactors& factors = run_of(figure.solve).form_factors;
  if (factors.row_begin.empty()) {
    factors = solver.form_factors();
  }
  const std::vector<double> row = form_factors_from(factors, figure.patch);
  if (figure.all) {
    return std::accumulate(row.begin(), row.end(), 0.0);
  }
  return std::accumulate(figure.others.begin(), figure.others.end(), 0.0,
                         [&](double sum, PatchId j) { return sum + at(row, j); });
}

double FigureValues::jump(const Figure& figure) {
  const RadiositySolver& solver = solved(figure.solve);
  std::vector<double>& jumps = run_of(figure.solve).jumps;
  if (jumps.empty()) {
    jumps = radiosity_jumps(solver.solution(), cancellation_);
  }
  return at(jumps, figure.patch);
}

double FigureValues::of_patch(const Figure& figure) {
  const Scene& scene = *loaded_->scene;
  switch (figure.kind) {
    case FigureKind::area:
      return scene.patch(figure.patch).area;
    case FigureKind::exitance:
      return luminance(scene.material(figure.patch).exitance);
    case FigureKind::reflectance:
      return luminance(scene.material(figure.patch).reflectance);
    case FigureKind::radiosity:
    case FigureKind::irradiance:
    case FigureKind::radiance:
      return luminance(light_of(figure));
    case FigureKind::jump:
      return jump(figure);
    default:
      return form_factor(figure);
  }
}

double FigureValues::value(const Figure& figure) {
  for (const PatchId patch : figure.others) {
    check_patch(patch);
  }
  if (figure.patch != no_patch) {
    check_patch(figure.patch);
  }
  switch (figure.kind) {
    case FigureKind::constant:
      return figure.number;
    case FigureKind::patches:
      return loaded_->scene->patch_count();
    case FigureKind::fragments:
      return static_cast<double>(loaded_->tree->fragments().size());
    case FigureKind::ratio:
      return value(figure.parts.front()) / value(figure.parts.back());
    case FigureKind::rms_error:
      return error_of(figure);
    case FigureKind::function_error:
      return function_error(figure);
    case FigureKind::covered:
      return covered(figure);
    case FigureKind::directions:
    case FigureKind::iterations:
    case FigureKind::contraction:
    case FigureKind::estimated_error:
    case FigureKind::largest_error:
    case FigureKind::light_directions:
      return of_run(figure);
    default:
      return is_of_direction(figure.kind) ? of_direction(figure) : of_patch(figure);
  }
}

std::vector<double> FigureValues::of_patches(const Figure& figure) {
  std::vector<double> values;
  Figure one = figure;
  for (PatchId k = 0; k < loaded_->scene->patch_count(); ++k) {
    if (figure.patch != no_patch || figure.kind == FigureKind::above) {
      one.others = {k};
    } else {
      one.patch = k;
    }
    values.push_back(value(one));
  }
  return values;
}

std::vector<std::vector<Vec2>> FigureValues::region(const Figure& figure) {
  check_patch(figure.patch);
  const MapHistory& history = history_of(figure);
  std::vector<std::vector<Vec2>> parts;
  for (const std::int32_t r : rows_of(figure)) {
    const auto outline = history.record().outline(history.row(r));
    parts.emplace_back(outline.begin(), outline.end());
  }
  return parts;
}

}  // namespace transillum::viewer
