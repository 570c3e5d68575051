// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Values of lessons, from solves and recorded maps of the page's scene. The map of a direction
// holds, for each step, the polygons directly above its fragment: the inside list.
#include "lessons/computed_values.h"

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

/// A solve. It is finished, and has form factors, only where a value needs them.
struct ComputedValues::Run {
  SolveOptions options;
  RadiositySolver solver;
  FormFactors form_factors = {};
  std::vector<double> jumps = {};
  /// The solutions of runs in which lobes take part, by the changes of materials.
  std::vector<std::pair<std::vector<MaterialChange>, Solution>> with_lobes = {};
};

/// A solve of the scene with other patches.
struct ComputedValues::Divided {
  double patch_area;
  SolveOptions options;
  Solution solution;
};

namespace {

bool holds(const std::vector<PatchId>& list, PatchId patch) {
  return std::find(list.begin(), list.end(), patch) != list.end();
}

SolveOptions with_linear_basis(SolveOptions options) {
  options.basis = Basis::linear;
  return options;
}

SolveOptions reference_options_of(const LessonValue& wanted) {
  SolveOptions options = reference_options(wanted.reference);
  options.first_shot = first_shot_where_it_pays;
  return options;
}

ErrorEstimate estimate_of(const RadiositySolver& solver) {
  ErrorEstimate estimate = solver.error_estimate();
  if (estimate.replicas == 0) {
    throw InputError("an error estimate needs replicas, and the run has none");
  }
  return estimate;
}

}  // namespace

ComputedValues::ComputedValues(std::shared_ptr<const LoadedScene> loaded, Cancellation cancellation,
                               std::function<void(double fraction)> progress)
    : loaded_(std::move(loaded)),
      cancellation_(std::move(cancellation)),
      progress_(std::move(progress)) {}

ComputedValues::~ComputedValues() = default;

double ComputedValues::work_of(const SolveOptions& options, double patch_area) const {
  const Scene& scene = *loaded_->scene;
  double area = 0;
  for (PatchId i = 0; patch_area > 0 && i < scene.patch_count(); ++i) {
    area += scene.patch(i).area;
  }
  return options.directions * (patch_area > 0 ? area / patch_area : scene.patch_count());
}

void ComputedValues::expect_solve(const SolveOptions& options, double patch_area) {
  const std::pair solve(options, patch_area);
  if (std::find(expected_.begin(), expected_.end(), solve) == expected_.end()) {
    expected_.push_back(solve);
    expected_work_ += work_of(options, patch_area);
  }
}

void ComputedValues::expect(const LessonValue& wanted) {
  switch (wanted.kind) {
    case LessonValueKind::constant:
    case LessonValueKind::patches:
    case LessonValueKind::fragments:
    case LessonValueKind::area:
    case LessonValueKind::exitance:
    case LessonValueKind::reflectance:
      return;
    case LessonValueKind::ratio:
      std::for_each(wanted.of.begin(), wanted.of.end(), [this](const auto& of) { expect(of); });
      return;
    case LessonValueKind::function_error:
      expect_solve(with_linear_basis(wanted.solve), wanted.reference_area);
      expect_solve(wanted.solve, wanted.patch_area);
      return;
    case LessonValueKind::rms_error:
    case LessonValueKind::covered:
      expect_solve(reference_options_of(wanted));
      [[fallthrough]];
    default:
      if (!is_of_direction(wanted.kind)) {
        expect_solve(wanted.solve);
      }
  }
}

void ComputedValues::tell(double work, const SolveProgress& now) const {
  const double fraction = now.iteration > 0 ? 1 : 1.0 * now.direction / std::max(1, now.passes);
  if (progress_ && expected_work_ > 0) {
    progress_(std::min(1.0, (done_work_ + fraction * work) / expected_work_));
  }
}

void ComputedValues::check_patch(PatchId patch) const {
  const PatchId patches = loaded_->scene->patch_count();
  if (patch < 0 || patch >= patches) {
    throw InputError("there is no patch " + std::to_string(patch) + "; the scene has 0 to " +
                     std::to_string(patches - 1));
  }
}

ComputedValues::Run& ComputedValues::run_of(const SolveOptions& options) {
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

const RadiositySolver& ComputedValues::solved(const SolveOptions& options) {
  Run& run = run_of(options);
  if (!run.solver.progress().finished) {
    const double work = work_of(options);
    run.solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& solver) {
      tell(work, solver.progress());
      return true;
    });
    done_work_ += work;
  }
  return run.solver;
}

const Solution* ComputedValues::solved_with_lobes(const SolveOptions& options,
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
  GlossySolver solver(scene, options, {.tree = changes.empty() ? loaded_->tree : nullptr},
                      cancellation_);
  const double work = work_of(options);
  solver.solve([&](const SolveProgress& now) {
    tell(work, now);
    return true;
  });
  done_work_ += work;
  known.emplace_back(changes, solver.solution());
  return &known.back().second;
}

Rgb ComputedValues::light_of(const LessonValue& wanted) {
  const Solution* glossy = solved_with_lobes(wanted.solve, wanted.changes);
  const PatchId patch = wanted.patch;
  if (wanted.kind == LessonValueKind::irradiance) {
    return at(glossy ? glossy->irradiance : solved(wanted.solve).irradiance(), patch);
  }
  if (wanted.kind == LessonValueKind::radiosity) {
    return at(glossy ? glossy->radiosity : solved(wanted.solve).radiosity(), patch);
  }
  if (glossy) {
    const Vec3 to_eye = wanted.eye - loaded_->scene->patch(patch).center;
    return glossy->glossy->radiance(patch, normalized(to_eye));
  }
  return std::numbers::inv_pi * at(solved(wanted.solve).radiosity(), patch);
}

const MapHistory& ComputedValues::history_of(const LessonValue& wanted) {
  const RadiositySolver& solver = run_of(wanted.solve).solver;
  const int passes = solver.progress().passes;
  if (wanted.direction >= passes) {
    throw InputError("there is no direction " + std::to_string(wanted.direction + 1) +
                     "; the run has 1 to " + std::to_string(passes));
  }
  const Vec3 omega = solver.direction(wanted.iteration, wanted.direction);
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

const std::vector<Rgb>& ComputedValues::reference_of(const LessonValue& wanted) {
  auto& reference = references_[wanted.reference];
  if (reference.empty()) {
    const SolveOptions options = reference_options_of(wanted);
    const double work = work_of(options);
    reference = solve_reference(
        loaded_->scene, loaded_->tree, options, [&](const SolveProgress& now) { tell(work, now); },
        cancellation_);
    done_work_ += work;
  }
  return reference;
}

double ComputedValues::covered(const LessonValue& wanted) {
  const std::vector<Rgb>& reference = reference_of(wanted);
  const RadiositySolver& solver = solved(wanted.solve);
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

double ComputedValues::error_of(const LessonValue& wanted) {
  const std::vector<Rgb>& reference = reference_of(wanted);
  return radiosity_error(*loaded_->scene, solved(wanted.solve).radiosity(), reference).rms;
}

const Solution& ComputedValues::divided(double patch_area, const SolveOptions& options) {
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
  const double work = work_of(options, patch_area);
  const auto observer = [&](const SolveSession& session) {
    tell(work, session.progress());
    return true;
  };
  Solution solution = solve(scene, options, observer, cancellation_);
  done_work_ += work;
  cancellation_.throw_if_canceled();
  return divided_
      .emplace_back(std::make_unique<Divided>(Divided{patch_area, options, std::move(solution)}))
      ->solution;
}

double ComputedValues::function_error(const LessonValue& wanted) {
  const Solution& reference = divided(wanted.reference_area, with_linear_basis(wanted.solve));
  return compare_functions(reference, divided(wanted.patch_area, wanted.solve)).l2;
}

double ComputedValues::of_run(const LessonValue& wanted) {
  const Solution* glossy = solved_with_lobes(wanted.solve);
  const SolveStatistics statistics =
      glossy ? glossy->statistics : solved(wanted.solve).statistics();
  switch (wanted.kind) {
    case LessonValueKind::directions:
      return statistics.directions;
    case LessonValueKind::iterations:
      return statistics.iterations;
    case LessonValueKind::contraction:
      return statistics.iteration_records.back().contraction;
    case LessonValueKind::light_directions:
      return statistics.light_directions / wanted.solve.replicas;
    default:
      break;
  }
  const ErrorEstimate estimate = estimate_of(solved(wanted.solve));
  return wanted.kind == LessonValueKind::estimated_error ? estimate.rms : estimate.rms_limit;
}

/// The rows of the map that the value is about: fragments of patch i, or the polygons directly
/// above them or above the patches of `others`.
std::vector<std::int32_t> ComputedValues::rows_of(const LessonValue& wanted) {
  const MapHistory& history = history_of(wanted);
  const bool counts = wanted.kind == LessonValueKind::above;
  std::vector<std::int32_t> rows;
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    const MapHistory::Step& step = history.step(k);
    if (counts ? !holds(wanted.others, step.patch) : step.patch != wanted.patch) {
      continue;
    }
    if (wanted.kind == LessonValueKind::projected_area && step.row != MapRecord::no_row) {
      rows.push_back(step.row);
    }
    if (wanted.kind == LessonValueKind::projected_area) {
      continue;
    }
    for (const std::int32_t r : history.inside_at(k)) {
      const PatchId patch = history.row(r).patch;
      const std::string& material = wanted.material;
      const auto& scene = *loaded_->scene;
      const bool taken = counts ? !holds(wanted.others, patch) &&
                                      (material.empty() || scene.material(patch).name == material)
                                : wanted.others.empty() || holds(wanted.others, patch);
      if (taken) {
        rows.push_back(r);
      }
    }
  }
  return rows;
}

double ComputedValues::of_direction(const LessonValue& wanted) {
  const MapHistory& history = history_of(wanted);
  if (wanted.kind == LessonValueKind::steps) {
    return history.step_count();
  }
  if (wanted.kind == LessonValueKind::polygons) {
    std::int32_t most = 0;
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      most = std::max(most, history.step(k).map_size);
    }
    return most;
  }
  double area = 0;
  std::set<PatchId> patches;
  for (const std::int32_t r : rows_of(wanted)) {
    area += history.record().area(history.row(r));
    patches.insert(history.row(r).patch);
  }
  const bool counts = wanted.kind == LessonValueKind::seen || wanted.kind == LessonValueKind::above;
  return counts ? static_cast<double>(patches.size()) : area;
}

double ComputedValues::form_factor(const LessonValue& wanted) {
  const RadiositySolver& solver = solved(wanted.solve);
  if (wanted.kind == LessonValueKind::form_factor_sum) {
    return at(solver.form_factor_sums(), wanted.patch);
  }
  FormFactors& factors = run_of(wanted.solve).form_factors;
  if (factors.row_begin.empty()) {
    factors = solver.form_factors();
  }
  const std::vector<double> row = form_factors_from(factors, wanted.patch);
  if (wanted.all) {
    return std::accumulate(row.begin(), row.end(), 0.0);
  }
  return std::accumulate(wanted.others.begin(), wanted.others.end(), 0.0,
                         [&](double sum, PatchId j) { return sum + at(row, j); });
}

double ComputedValues::jump(const LessonValue& wanted) {
  const RadiositySolver& solver = solved(wanted.solve);
  std::vector<double>& jumps = run_of(wanted.solve).jumps;
  if (jumps.empty()) {
    jumps = radiosity_jumps(solver.solution(), cancellation_);
  }
  return at(jumps, wanted.patch);
}

double ComputedValues::of_patch(const LessonValue& wanted) {
  const Scene& scene = *loaded_->scene;
  switch (wanted.kind) {
    case LessonValueKind::area:
      return scene.patch(wanted.patch).area;
    case LessonValueKind::exitance:
      return luminance(scene.material(wanted.patch).exitance);
    case LessonValueKind::reflectance:
      return luminance(scene.material(wanted.patch).reflectance);
    case LessonValueKind::radiosity:
    case LessonValueKind::irradiance:
    case LessonValueKind::radiance:
      return luminance(light_of(wanted));
    case LessonValueKind::jump:
      return jump(wanted);
    default:
      return form_factor(wanted);
  }
}

double ComputedValues::value(const LessonValue& wanted) {
  for (const PatchId patch : wanted.others) {
    check_patch(patch);
  }
  if (wanted.patch != no_patch) {
    check_patch(wanted.patch);
  }
  switch (wanted.kind) {
    case LessonValueKind::constant:
      return wanted.number;
    case LessonValueKind::patches:
      return loaded_->scene->patch_count();
    case LessonValueKind::fragments:
      return static_cast<double>(loaded_->tree->fragments().size());
    case LessonValueKind::ratio:
      return value(wanted.of.front()) / value(wanted.of.back());
    case LessonValueKind::rms_error:
      return error_of(wanted);
    case LessonValueKind::function_error:
      return function_error(wanted);
    case LessonValueKind::covered:
      return covered(wanted);
    case LessonValueKind::directions:
    case LessonValueKind::iterations:
    case LessonValueKind::contraction:
    case LessonValueKind::estimated_error:
    case LessonValueKind::largest_error:
    case LessonValueKind::light_directions:
      return of_run(wanted);
    default:
      return is_of_direction(wanted.kind) ? of_direction(wanted) : of_patch(wanted);
  }
}

std::vector<double> ComputedValues::of_patches(const LessonValue& wanted) {
  std::vector<double> values;
  LessonValue one = wanted;
  for (PatchId k = 0; k < loaded_->scene->patch_count(); ++k) {
    if (wanted.patch != no_patch || wanted.kind == LessonValueKind::above) {
      one.others = {k};
    } else {
      one.patch = k;
    }
    values.push_back(value(one));
  }
  return values;
}

std::vector<std::vector<Vec2>> ComputedValues::region(const LessonValue& wanted) {
  check_patch(wanted.patch);
  const MapHistory& history = history_of(wanted);
  std::vector<std::vector<Vec2>> parts;
  for (const std::int32_t r : rows_of(wanted)) {
    const auto outline = history.record().outline(history.row(r));
    parts.emplace_back(outline.begin(), outline.end());
  }
  return parts;
}

}  // namespace transillum::viewer
