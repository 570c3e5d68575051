// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/view_state_applier.h"

#include <QAction>
#include <algorithm>

#include "map/map_view.h"
#include "scene/color_controls.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/show_menu.h"
#include "state/step_finder.h"
#include "stepping/algorithm_view.h"
#include "widgets/banner.h"
#include "window/inspection_panels.h"
#include "window/main_window.h"

namespace transillum::viewer {

namespace {

StepFinder find_named(StepName name, PatchId selection) {
  switch (name) {
    case StepName::exchange:
      return find_exchanges();
    case StepName::event:
      return find_events_of(selection);
    case StepName::fullest:
      return [](const MapHistory& history, std::int32_t, StepOrder) {
        return history.record().fullest_step();
      };
    case StepName::polygon:
      return find_where([selection](const MapHistory& history, std::int32_t step) {
        return history.step(step).patch == selection;
      });
    case StepName::cut:
      break;
  }
  return find_where([](const MapHistory& history, std::int32_t step) {
    return !history.inside_at(step).empty() && !history.outside_at(step).empty();
  });
}

}  // namespace

ViewStateApplier::ViewStateApplier(MainWindow& window) : QObject(&window), window_(window) {
  connect(&window_, &MainWindow::scene_shown, this, &ViewStateApplier::on_scene);
  connect(&window_, &MainWindow::snapshot_shown, this, &ViewStateApplier::on_snapshot);
  connect(&window_, &MainWindow::failed, this, [this] { act_ = Act::idle; });
  connect(&window_.focus(), &Focus::moved, this, &ViewStateApplier::on_direction);
}

void ViewStateApplier::show(const ViewState& state) {
  before_.reset();
  bring(state);
}

void ViewStateApplier::show_page(const ViewState& page) {
  if (!before_) {
    before_ = look();
    before_->options = window_.options();
  }
  bring(page);
}

void ViewStateApplier::leave() {
  act_ = Act::idle;
  opens_ = false;
  left_ = true;
  if (before_ && window_.options() == brought_options_) {
    window_.set_options(before_->options.solve, before_->options.scene);
  }
}

void ViewStateApplier::bring(const ViewState& state) {
  wish_ = state;
  left_ = false;
  window_.page()->banner()->dismiss();
  if (wish_.layout && *wish_.layout != window_.docks().current()) {
    window_.docks().arrange(*wish_.layout);
  }
  for (const std::string& panel : wish_.panels) {
    window_.docks().bring_to_front(panel);
  }
  put_on(wish_);
  begin_run();
}

void ViewStateApplier::put_on(const ViewState& state) {
  ColorChoice& colors = window_.colors();
  colors.set_quantity(state.quantity);
  colors.set_range_rule(RangeRule::automatic);
  colors.set_mode(state.color_mode);
  colors.set_map(state.color_map);
  colors.set_logarithmic(state.logarithmic);
  if (state.range_rule == RangeRule::fixed) {
    colors.set_range(state.range->first, state.range->second);
  }
  colors.set_gamma(state.gamma);
  colors.set_automatic_exposure(!state.exposure);
  if (state.exposure) {
    colors.set_exposure(*state.exposure);
  }
  const ShowMenu& show = *window_.page()->color_controls()->show_menu();
  for (const Overlay overlay : all_overlays) {
    show.overlay(overlay)->setChecked(
        std::count(state.overlays.begin(), state.overlays.end(), overlay) > 0);
  }
  window_.algorithm()->set_kind(state.algorithm);
  window_.map_view()->set_labels_shown(state.labels);
}

void ViewStateApplier::reload() {
  if (window_.spec().empty()) {
    return;
  }
  wish_ = state();
  act_ = Act::awaits_scene;
  opens_ = true;
  window_.set_options(wish_.options.solve, wish_.options.scene);
  window_.open(QString::fromStdString(wish_.scene), wish_.solve);
}

void ViewStateApplier::begin_run() {
  // Without a scene of its own, a page is about whichever is open.
  if (wish_.scene.empty()) {
    act_ = Act::awaits_run;
    on_snapshot();
    return;
  }
  const RunOptions now = window_.options();
  wish_.options.solve.threads = now.solve.threads;
  wish_.options.solve.memory = now.solve.memory;
  window_.set_options(wish_.options.solve, wish_.options.scene);
  brought_options_ = window_.options();

  const auto snapshot = window_.snapshot();
  if (!snapshot || !window_.shows(wish_.scene, wish_.options.scene)) {
    act_ = Act::awaits_scene;
    opens_ = true;
    window_.open(QString::fromStdString(wish_.scene), wish_.solve);
    return;
  }
  act_ = Act::awaits_run;
  const bool beyond = wish_.solve.kind != Goal::Kind::finished &&
                      passes_done(snapshot->progress, snapshot->kept_passes) > wish_.solve.passes;
  if (beyond || !(snapshot->options == wish_.options.solve)) {
    window_.runner().restart(wish_.options.solve, wish_.solve);
  } else {
    window_.runner().pursue(wish_.solve);
  }
  on_snapshot();
}

// Of wishes that follow one another quickly each asks for the scene, and more than one may get it;
// every time it begins anew.
void ViewStateApplier::on_scene() {
  if (left_) {
    begin_with_first_look();
  }
  opens_ = opens_ && window_.shows(wish_.scene, wish_.options.scene);
  act_ = opens_ ? Act::awaits_run : Act::idle;  // idle: the user has opened another
}

void ViewStateApplier::begin_with_first_look() {
  left_ = false;
  if (before_) {
    put_on(*before_);
    window_.page()->color_controls()->set_direction(before_->direction_shown);
    before_.reset();
  }
  window_.colors().set_automatic_exposure(true);
  window_.focus().set_following(true);
}

// Snapshots of the run before may still be on their way.
bool ViewStateApplier::run_has_begun() const {
  const auto snapshot = window_.snapshot();
  if (!snapshot) {
    return false;
  }
  if (wish_.scene.empty()) {
    return true;
  }
  return snapshot->options == wish_.options.solve &&
         (wish_.solve.kind == Goal::Kind::finished ||
          passes_done(snapshot->progress, snapshot->kept_passes) <= wish_.solve.passes);
}

bool ViewStateApplier::moment_is_there() const {
  return !wish_.focus || wish_.focus->iteration < window_.focus().iterations() ||
         window_.runner().state() == RunState::finished;
}

void ViewStateApplier::on_snapshot() {
  if (act_ != Act::awaits_run || !run_has_begun()) {
    return;
  }
  arrange();
  if (!moment_is_there()) {
    return;
  }
  focus();
}

void ViewStateApplier::arrange() {
  window_.page()->show_scene();
  SceneView* scene = window_.page()->scene_view();
  if (wish_.camera) {
    scene->look_from(*wish_.camera);
  } else {
    scene->reset_view();
  }
  const PatchId patches = window_.snapshot()->loaded->scene->patch_count();
  window_.selection().select(wish_.selection < patches ? wish_.selection : no_patch);
  if (wish_.selection >= patches) {
    window_.show_failure(tr("select: there is no patch %1; the scene has 0 to %2")
                             .arg(wish_.selection)
                             .arg(patches - 1));
  }
  window_.page()->color_controls()->set_direction(wish_.direction_shown);
  window_.page()->color_controls()->set_outlines(
      wish_.outlines.value_or(window_.outlined_at_first()));
  for (const std::string& name : window_.inspection().edits().start_over(wish_.materials)) {
    window_.show_failure(
        tr("materials: the scene has no material %1").arg(QString::fromStdString(name)));
  }
  // The scene before would widen it.
  if (wish_.range_rule != RangeRule::widening) {
    return;
  }
  if (wish_.range) {
    window_.colors().widen_from(wish_.range->first, wish_.range->second);
  } else {
    window_.colors().set_range_rule(RangeRule::widening);
  }
}

void ViewStateApplier::focus() {
  Focus& focus = window_.focus();
  if (!wish_.focus) {
    act_ = Act::idle;
    focus.set_following(true);
    return;
  }
  act_ = Act::awaits_direction;
  const int passes = focus.passes_of(wish_.focus->iteration);
  if (wish_.focus->direction >= passes) {
    window_.show_failure(tr("focus: there is no direction %1; the run has 1 to %2")
                             .arg(wish_.focus->direction + 1)
                             .arg(passes));
  }
  const auto* step = std::get_if<std::int32_t>(&wish_.focus->step);
  focus.go_to({wish_.focus->iteration, wish_.focus->direction, step ? *step : -1});
}

void ViewStateApplier::on_direction() {
  if (act_ != Act::awaits_direction || !window_.focus().arrived()) {
    return;
  }
  act_ = Act::idle;
  Focus& focus = window_.focus();
  if (const auto* name = std::get_if<StepName>(&wish_.focus->step)) {
    focus.seek(find_named(*name, window_.selection().patch()), StepOrder::forward);
  }
  focus.set_phase(wish_.focus->phase);
}

bool ViewStateApplier::arrived() const { return act_ == Act::idle && window_.focus().arrived(); }

ViewState ViewStateApplier::state() const {
  const auto snapshot = window_.snapshot();
  if (!snapshot) {
    return {};
  }
  ViewState state = look();
  state.scene = window_.spec();
  state.options = {snapshot->options, window_.scene_options_in_effect()};
  const bool finished = window_.runner().state() == RunState::finished ||
                        window_.runner().state() == RunState::running;
  if (!finished) {
    const std::int64_t passes = passes_done(snapshot->progress, snapshot->kept_passes);
    state.solve = passes > 0 ? Goal{Goal::Kind::passes, passes} : Goal{};
  }
  const Focus& focus = window_.focus();
  if (!focus.following() && focus.map()) {
    const RunPosition& position = focus.position();
    state.focus = FocusChoice{position.iteration, position.direction, position.step, focus.phase()};
  }
  state.materials = window_.inspection().edits().changes();
  state.selection = window_.selection().patch();
  state.camera = window_.page()->scene_view()->view_point();
  state.outlines = window_.page()->color_controls()->outlines();
  state.layout = window_.docks().current();
  return state;
}

ViewState ViewStateApplier::look() const {
  ViewState state;
  const ColorChoice& colors = window_.colors();
  if (colors.quantity() != Quantity::difference) {
    state.quantity = colors.quantity();
  }
  state.range_rule = colors.range_rule();
  if (state.range_rule != RangeRule::automatic) {
    state.range = {colors.scale().low, colors.scale().high};
  }
  state.color_mode = colors.mode();
  state.color_map = colors.map();
  state.logarithmic = colors.scale().logarithmic;
  if (!colors.exposure_is_automatic()) {
    state.exposure = colors.scale().exposure;
  }
  state.gamma = colors.scale().gamma;
  const ShowMenu& show = *window_.page()->color_controls()->show_menu();
  for (const Overlay overlay : all_overlays) {
    if (show.overlay(overlay)->isChecked()) {
      state.overlays.push_back(overlay);
    }
  }
  state.algorithm = window_.algorithm()->kind();
  state.direction_shown = window_.page()->color_controls()->direction();
  state.labels = window_.map_view()->labels_shown();
  return state;
}

}  // namespace transillum::viewer
