// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/solve_control.h"

#include <QMainWindow>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "model/measured_errors.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "session/divisions.h"
#include "session/next_steps.h"
#include "solve/round_panel.h"
#include "solve/settings_panel.h"
#include "solve/solve_actions.h"
#include "solve/solve_cost.h"
#include "window/base/notifier.h"
#include "window/base/open_scene.h"
#include "window/base/view_state_applier.h"
#include "window/solve_undo.h"

namespace transillum::viewer {

SolveControl::SolveControl(const WindowFrame& frame, SettingsPanel& settings, SolveActions& actions,
                           ViewStateApplier& applier)
    : QObject(&frame.window),
      frame_(frame),
      settings_(settings),
      actions_(actions),
      applier_(applier),
      undo_(*new SolveUndo(frame)),
      forecast_(*this, PatchForecast(),
                [this](const PatchForecast::Request& request,
                       const std::shared_ptr<const PatchForecast::Answer>& answer, const QString&) {
                  if (answer) {
                    show_forecast(request, *answer);
                  } else if (std::exchange(awaits_forecast_, false)) {
                    open_again();  // reading the scene will fail likewise, and say why
                  }
                }) {
  SolveRunner& runner = frame_.state.runner;
  connect(&actions_, &SolveActions::run, this, &SolveControl::run);
  connect(&actions_, &SolveActions::pause, &runner, &SolveRunner::pause);
  connect(&actions_, &SolveActions::one_direction, this,
          [this] { advance(Goal::Kind::direction); });
  connect(&actions_, &SolveActions::one_iteration, this,
          [this] { advance(Goal::Kind::iteration); });
  connect(&actions_, &SolveActions::stop, this, &SolveControl::start_over);
  connect(&runner, &SolveRunner::state_changed, this, &SolveControl::show_state);
  connect(&frame_.state.scene, &OpenScene::snapshot_ready, this, [this] {
    actions_.show_state(frame_.state.runner.state(), frame_.state.scene.at_start());
    show_division();
  });
  connect(&frame_.state.relighting.edits(), &MaterialEdits::changed, this,
          &SolveControl::show_division);
  connect(&actions_, &SolveActions::divide_along_shadows, this,
          &SolveControl::divide_along_shadows);
  connect(&settings_, &SettingsPanel::restart_clicked, this, &SolveControl::solve_settings);
  connect(&settings_, &SettingsPanel::forecast_wanted, this, [this](const SceneOptions& options) {
    if (frame_.state.scene.loaded() && frame_.state.scene.loaded()->description) {
      request_forecast(options);
    }
  });
  connect(&undo_, &SolveUndo::returned, this, [this](const SolveOptions& options) {
    settings_.set_options(options, frame_.state.scene.options());
  });
  connect(&frame_.state.scene, &OpenScene::opening, this, [this] { awaits_forecast_ = false; });
  connect(settings_.rounds(), &RoundPanel::canceled, &runner, &SolveRunner::stop);
  connect(&frame_.page, &ScenePage::replicas_requested, this, &SolveControl::solve_with_replicas);
}

bool SolveControl::solve_settings() {
  const bool accepted = finds_light(settings_.solve_options()) && may_solve_again();
  if (accepted) {
    solve_again();
  }
  return accepted;
}

void SolveControl::start_over() {
  if (frame_.state.runner.state() == RunState::loading ||
      frame_.guard.may_lose(&frame_.window, tr("Start over"))) {
    frame_.state.runner.stop();
  }
}

bool SolveControl::may_solve_again() const {
  return frame_.guard.may_lose(&frame_.window, tr("Solve again"));
}

bool SolveControl::finds_light(const SolveOptions& options) {
  const bool emits = !frame_.state.scene.loaded() || frame_.state.relighting.edits().has_light();
  const std::string why = options.why_dark(emits);
  if (!why.empty()) {
    emit light_missing(QString::fromStdString(why));
  }
  return why.empty();
}

/// Continues the solve, if it has light.
void SolveControl::advance(Goal::Kind kind) {
  const auto snapshot = frame_.state.scene.snapshot();
  if (finds_light(snapshot ? snapshot->options : settings_.solve_options())) {
    frame_.state.runner.set_goal({.kind = kind, .without_light = true});
  }
}

void SolveControl::run() {
  // Before the first direction, changed settings still take effect.
  const bool again = frame_.state.scene.at_start() && settings_.differ_from_effect();
  if (!again) {
    advance(Goal::Kind::finished);
  } else if (finds_light(settings_.solve_options())) {
    solve_again();
  }
}

void SolveControl::solve_again() {
  if (!frame_.state.scene.loaded()) {
    return;
  }
  frame_.notifier.dismiss();
  RunOptions options = wanted_options();
  const auto& shown = frame_.state.scene.snapshot();
  if (shown && shown->options.glossy != options.solve.glossy &&
      has_lobes(*frame_.state.scene.loaded()->scene)) {
    frame_.state.colors.show_lobes(options.solve.glossy);
  }
  if (options.refine.is_set() && !may_refine(options.refine.patches)) {
    return;
  }
  if (settings_.patches_wanted() == 0 &&
      frame_.state.scene.is_open(frame_.state.scene.spec(), options)) {
    undo_.remember();
    frame_.state.runner.restart(SolveWorker::choice_of(options), {Goal::Kind::finished});
  } else if (frame_.state.scene.loaded()->description) {
    awaits_forecast_ = true;
    request_forecast(options.scene);
  } else {
    open_again();
  }
}

/// The options of the panel, for the open scene. Materials that were changed in the window become
/// materials of the scene: they are solved, estimated, refined and copied like all others.
RunOptions SolveControl::wanted_options() const {
  RunOptions options = settings_.options();
  options.input = frame_.state.scene.input();
  const std::vector<MaterialChange> changes = frame_.state.relighting.edits().changes();
  options.input.changes.insert(options.input.changes.end(), changes.begin(), changes.end());
  return options;
}

void SolveControl::open_again() {
  undo_.remember();
  applier_.open_again(wanted_options());
}

void SolveControl::request_forecast(const SceneOptions& options) {
  forecast_.request({whole_of(frame_.state.scene.loaded()), options, settings_.patches_wanted()});
}

void SolveControl::show_forecast(const PatchForecast::Request& request,
                                 const PatchForecast::Answer& answer) {
  if (request.patches > 0) {
    settings_.set_patch_area(request.patches, answer.max_patch_area, answer.patches);
  } else {
    settings_.show_forecast(request.options, answer.patches);
  }
  // The settings may have changed since.
  const SceneOptions wanted = settings_.scene_options();
  const bool newest = settings_.patches_wanted() == 0 &&
                      answer.max_patch_area == wanted.max_patch_area &&
                      request.options.two_sided == wanted.two_sided;
  if (newest && std::exchange(awaits_forecast_, false) && may_refine(answer.patches)) {
    open_again();
  }
}

bool SolveControl::may_refine(std::int64_t patches) {
  constexpr std::int64_t many_patches = 200'000;
  if (patches <= many_patches || patches <= frame_.state.scene.loaded()->scene->patch_count()) {
    return true;
  }
  QMessageBox box(QMessageBox::Question, tr("Very many patches"),
                  tr("The solve would be of %1. Divide the scene so finely?")
                      .arg(cost_text(cost_of(nullptr, settings_.solve_options(), patches))),
                  QMessageBox::Cancel, &frame_.window);
  box.setObjectName("many_patches");
  const QPushButton* divide = box.addButton(tr("Divide"), QMessageBox::AcceptRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == divide;
}

void SolveControl::solve_with_replicas() {
  if (!finds_light(settings_.solve_options()) || !may_solve_again()) {
    return;
  }
  constexpr int replicas = 8;
  SolveOptions solve = settings_.solve_options();
  solve.directions = std::max(solve.directions, replicas);
  solve.replicas = replicas;
  settings_.set_options(solve, settings_.scene_options());
  solve_again();
}

void SolveControl::finish() {
  if (frame_.state.relighting.edits().changes().empty()) {
    run();
  } else if (finds_light(settings_.solve_options()) && may_solve_again()) {
    solve_again();
  }
}

void SolveControl::divide_along_shadows() {
  SolveOptions solve = settings_.solve_options();
  if (!frame_.state.scene.loaded() || !solve.sky.sun.is_set() || !may_solve_again()) {
    return;
  }
  if (settings_.total()) {
    solve.goal = {};  // nothing more is divided
  }
  frame_.notifier.dismiss();
  undo_.remember();
  frame_.state.runner.restart({.solve = solve,
                               .from = frame_.state.scene.loaded(),
                               .division = division_by_shadows(solve.sky.sun.direction)},
                              {Goal::Kind::finished});
}

void SolveControl::show_division() {
  const auto& snapshot = frame_.state.scene.snapshot();
  const QString unsolved = frame_.state.relighting.edits().why_unsolved();
  actions_.set_division_refused(snapshot && snapshot->options.sky.sun.is_set()
                                    ? unsolved
                                    : tr("The solve has no sun (Solve settings, Sky)"));
}

void SolveControl::take_step(const NextStep& step) {
  const auto errors = frame_.state.colors.errors();
  if (!errors || errors->loaded != frame_.state.scene.loaded() || !may_solve_again()) {
    return;
  }
  const std::string division = name_of_division(step, errors->solve);
  if (!division.empty() && !may_refine(step.patches)) {
    return;
  }
  frame_.notifier.dismiss();
  SolveOptions solve = errors->solve.options;
  solve.goal = {};  // the step is about a number of passes
  solve.directions = step.passes;
  solve.tolerance = step.tolerance;
  settings_.set_options({solve, settings_.scene_options()});
  frame_.state.runner.restart({.solve = solve, .from = errors->loaded, .division = division},
                              {Goal::Kind::finished});
}

void SolveControl::show_state(RunState state) {
  actions_.show_state(state, frame_.state.scene.at_start());
  frame_.page.scene_view()->set_antialiased(state != RunState::running);
  settings_.set_restart_enabled(frame_.state.scene.loaded() && state != RunState::loading);
}

}  // namespace transillum::viewer
