// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/relighting.h"

#include <utility>

#include "model/snapshot_values.h"

namespace transillum::viewer {

// While a slider is dragged, a late picture is better than none: a running job is finished.
Relighting::Relighting(QUndoStack& undo, QObject* parent)
    : QObject(parent),
      edits_(undo),
      relighter_(
          *this, &Relighting::relit,
          [this](const Request& request, std::shared_ptr<const RelightResult> light,
                 const QString& error) {
            if (!light) {
              emit failed(error);
            } else if (edits_.any()) {  // else undone since
              light_ = std::move(light);
              materials_ = request.materials;
              emit changed();
            }
          },
          CurrentJob::finish) {
  connect(&edits_, &MaterialEdits::changed, this, &Relighting::request_light);
}

namespace {

/// Whether the light is iterated from E on, so that charts show how fast it converges. The former
/// light is a better start, which larger scenes need.
bool shows_iterations(const SolverSnapshot& solved) {
  constexpr std::size_t most = 2'000'000, per_moments = 9;
  const FormFactors& f = *solved.form_factors;
  return f.value.size() + per_moments * f.moments.size() <= most &&
         solved.options.scheme == Scheme::fixed;
}

}  // namespace

RelightOptions relight_options(const SolverSnapshot& solved) {
  RelightOptions options;
  options.tolerance = solved.options.tolerance;
  options.start = solved.radiosity;
  options.start_linear_terms = solved.linear_terms;
  options.sky_irradiance = solved.sky_irradiance;
  options.sky_linear_terms = solved.sky_linear_terms;
  options.basis = solved.options.basis;
  options.shot = solved.shot.get();
  return options;
}

RelightResult Relighting::relit(const Request& request, const Cancellation& cancellation) {
  const SolverSnapshot& solved = *request.snapshot;
  RelightOptions options = relight_options(solved);
  if (shows_iterations(solved)) {
    options.start = {};
    options.start_linear_terms = {};
  } else if (request.start) {
    options.start = request.start->radiosity;
    options.start_linear_terms = request.start->linear_terms;
  }
  options.patch_materials = request.materials->of_patch;
  return relight(*solved.loaded->scene, *solved.form_factors, request.materials->materials, options,
                 cancellation);
}

void Relighting::show_scene(std::shared_ptr<const Scene> scene, bool edited) {
  snapshot_ = nullptr;
  used_ = nullptr;
  light_ = nullptr;
  materials_ = asked_ = nullptr;
  relighter_.clear();
  if (edited) {
    edits_.continue_with(std::move(scene));
  } else {
    edits_.start_with(std::move(scene));
  }
}

/// Whether the scene is not solved because nothing emits.
bool Relighting::awaits_light() const {
  return !has_light(*snapshot_) && snapshot_->progress.iteration == 0;
}

QString Relighting::reason_unavailable() const {
  if (!snapshot_) {
    return tr("Open a scene to change its light.");
  }
  if (awaits_light()) {
    return {};
  }
  if (snapshot_->shot && !snapshot_->shot->sources.empty() &&
      snapshot_->shot->contributions.empty()) {
    return tr(
        "The first shot, stored per material, exceeds the memory limit: solve without it to change "
        "the light.");
  }
  if (snapshot_->glossy) {
    return snapshot_->progress.iteration > 0 || snapshot_->materials || asked_
               ? QString()
               : tr("The light can be changed after the first iteration.");
  }
  return snapshot_->form_factors ? QString() : why_no_form_factors(*snapshot_);
}

QString Relighting::method_note() const {
  if (!snapshot_) {
    return {};
  }
  if (snapshot_->glossy) {
    return tr("Changed light is computed from the kept transfers, by direction.");
  }
  if (snapshot_->options.scheme == Scheme::semi_iterative) {
    return tr(
        "Changed light uses the form factors of all iterations; B of the scheme is a mean over "
        "iterations.");
  }
  if (snapshot_->shot && !snapshot_->shot->sources.empty()) {
    return tr("The first shot is included; patches that did not emit before are not shot.");
  }
  return {};
}

void Relighting::ask_solver() {
  const auto wanted = edits_.any() ? edits_.materials() : nullptr;
  if (wanted != asked_) {
    asked_ = wanted;
    emit solver_light_requested(wanted);
  }
}

void Relighting::request_light() {
  if (snapshot_ && snapshot_->glossy) {
    ask_solver();
    emit changed();
    return;
  }
  if (!edits_.any()) {
    relighter_.clear();
    light_ = nullptr;
    materials_ = nullptr;
    used_ = nullptr;
    emit changed();
    return;
  }
  if (snapshot_ && awaits_light() && edits_.has_light()) {
    emit form_factors_requested();
    emit solve_requested();
    return;
  }
  if (!reason_unavailable().isEmpty() || !snapshot_->form_factors) {
    emit form_factors_requested();
    return;
  }
  used_ = snapshot_->form_factors;
  relighter_.request({.snapshot = snapshot_, .materials = edits_.materials(), .start = light_});
}

std::shared_ptr<const SolverSnapshot> Relighting::lit(
    std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  if (snapshot_->glossy) {
    light_ = nullptr;
    materials_ = nullptr;
    used_ = nullptr;
    ask_solver();
    return snapshot_;
  }
  // The snapshot has form factors of more passes than the newest request.
  if (edits_.any() && snapshot_->form_factors && snapshot_->form_factors != used_) {
    request_light();
  }
  if (!light_ || !snapshot_->form_factors) {
    return snapshot_;
  }
  auto lit = std::make_shared<SolverSnapshot>(*snapshot_);
  lit->radiosity = light_->radiosity;
  lit->linear_terms = light_->linear_terms;
  lit->irradiance = light_->irradiance;
  lit->statistics.iteration_records = light_->iteration_records;
  lit->statistics.iterations = light_->iterations;
  const double rho_max = materials_->rho_max();
  if (lit->statistics.rho_max > 0) {
    lit->statistics.predicted_contraction *= rho_max / lit->statistics.rho_max;
    lit->statistics.rho_max = rho_max;
  }
  lit->materials = materials_;
  lit->fitted = nullptr;
  return lit;
}

}  // namespace transillum::viewer
