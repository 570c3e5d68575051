// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/view_state_applier.h"

#include <QAction>
#include <algorithm>
#include <utility>

#include "lessons/page_control.h"
#include "map/map_view.h"
#include "model/snapshot_values.h"
#include "scene/color_controls.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "scene/show_menu.h"
#include "solve/settings_panel.h"
#include "state/step_events.h"
#include "stepping/algorithm_view.h"
#include "widgets/build.h"
#include "window/base/dock_layouts.h"
#include "window/base/notifier.h"

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
    case StepName::whole:
      break;
  }
  return find_where([](const MapHistory& history, std::int32_t step) {
    return !history.inside_at(step).empty() && !history.outside_at(step).empty();
  });
}

}  // namespace

ViewStateApplier::ViewStateApplier(const WindowFrame& frame, DockLayouts& docks, MapView& map,
                                   AlgorithmView& algorithm, SettingsPanel& settings)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      map_(map),
      algorithm_(algorithm),
      settings_(settings) {
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, &ViewStateApplier::on_scene);
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, &ViewStateApplier::on_snapshot);
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, [this] {
    const auto snapshot = frame_.state.scene.snapshot();
    const bool ended = snapshot && snapshot->progress.finished;
    if (std::exchange(ended_, ended) != ended) {
      follow_layout();
    }
  });
  connect(&frame_.state.focus_feed, &FocusFeed::watched_changed, this,
          &ViewStateApplier::follow_layout);
  connect(&frame_.state.runner, &SolveRunner::failed, this, [this] { awaits_ = Awaits::nothing; });
  connect(&frame_.state.focus, &Focus::moved, this, &ViewStateApplier::on_direction);
}

void ViewStateApplier::show(const ViewState& state) {
  before_lesson_.reset();
  follow_layout();
  enable_sharp(true);
  apply(state);
  for (const std::string& panel : state.panels) {
    docks_.bring_to_front(panel);
  }
}

void ViewStateApplier::show_page(const ViewState& page) {
  enter_lesson();
  apply(page);
  docks_.show_for_page(page.panels);
}

void ViewStateApplier::enter_lesson() {
  if (!before_lesson_) {
    frame_.state.breakpoints.set_scene({});
    frame_.state.breakpoints.set_list({});
    before_lesson_ = appearance();
    before_lesson_->options = settings_.options();
    before_lesson_->layout = docks_.current();
    // Lessons are about patches, and what few directions do to them.
    enable_sharp(false);
    follow_layout();
  }
}

void ViewStateApplier::enable_sharp(bool enabled) {
  enable_if(*frame_.page.sharp()->action(), enabled, tr("Lessons show patches"));
}

void ViewStateApplier::follow_layout() {
  const Layout layout = docks_.current();
  const bool teaches = in_lesson(), without_lesson = layout == Layout::teach && !teaches;
  SceneView& scene = *frame_.page.scene_view();
  scene.set_direction_followed(teaches || layout == Layout::debug || (without_lesson && !ended_));
  scene.set_steps_shown(!without_lesson || frame_.state.focus_feed.watched());
}

void ViewStateApplier::set_option(const std::string& name, const std::string& value) {
  ViewState now = arrived() ? state() : requested_;
  if (!now.options.refine.is_set()) {
    now.options.refine = requested_.options.refine;  // the page's limits
    now.options.refine.by.reset();
  }
  now.options = with_option(now.options, name, value);
  now.solve = {Goal::Kind::finished};
  if (now.focus && now.focus->direction >= now.options.solve.directions) {
    now.focus.reset();
  }
  enter_lesson();
  apply(now);
}

void ViewStateApplier::leave_lesson() {
  awaits_ = Awaits::nothing;
  opened_here_ = false;
  leaving_ = true;
  if (before_lesson_ && settings_.options() == applied_options_) {
    settings_.set_options(before_lesson_->options);
  }
}

void ViewStateApplier::apply(const ViewState& state) {
  requested_ = state;
  leaving_ = false;
  frame_.notifier.dismiss();
  if (requested_.layout && *requested_.layout != docks_.current()) {
    docks_.choose(*requested_.layout);
  }
  apply_appearance(requested_);
  start_run();
}

void ViewStateApplier::apply_appearance(const ViewState& state) {
  ColorChoice& colors = frame_.state.colors;
  colors.set_quantity(state.quantity);
  colors.set_range_rule(RangeRule::automatic);
  colors.set_mode(state.color_mode);
  colors.set_map(state.color_map);
  colors.set_logarithmic(state.logarithmic.value_or(traits_of(state.quantity).spans_decades));
  if (state.range_rule == RangeRule::fixed) {
    colors.set_range(state.range->first, state.range->second);
  }
  colors.set_gamma(state.gamma);
  colors.set_automatic_exposure(!state.exposure);
  if (state.exposure) {
    colors.set_exposure(*state.exposure);
  }
  const ShowMenu& show = *frame_.page.color_controls()->show_menu();
  for (const Overlay overlay : all_overlays) {
    show.overlay(overlay)->setChecked(
        std::count(state.overlays.begin(), state.overlays.end(), overlay) > 0);
  }
  show.clip()->set_choice(state.clip);
  algorithm_.set_kind(state.algorithm);
  map_.set_labels_shown(state.labels);
}

void ViewStateApplier::reload() {
  if (frame_.state.scene.spec().empty()) {
    return;
  }
  // Repeats a request of which nothing has been applied yet.
  const bool pending = awaits_ == Awaits::scene || awaits_ == Awaits::run;
  if (!pending || requested_.scene.empty()) {
    requested_ = state();
  }
  open_requested();
}

void ViewStateApplier::open_again(const RunOptions& options) {
  requested_ = state();
  requested_.options = options;
  // The changed materials may now belong to the scene.
  const auto& changes = options.input.changes;
  const auto& edits = requested_.materials;
  if (changes.size() >= edits.size() &&
      std::equal(edits.begin(), edits.end(), changes.end() - std::ssize(edits))) {
    requested_.materials.clear();
  }
  requested_.solve = {Goal::Kind::finished};
  requested_.selection = no_patch;
  requested_.also_selected.clear();
  requested_.hidden.clear();
  requested_.pointed_at = no_patch;
  requested_.focus.reset();
  open_requested();
}

void ViewStateApplier::open_requested() {
  awaits_ = Awaits::scene;
  opened_here_ = true;
  settings_.set_options(requested_.options);
  frame_.state.scene.open(requested_.scene, requested_.options, requested_.solve);
}

void ViewStateApplier::start_run() {
  // A state without a scene applies to whichever scene is open.
  if (requested_.scene.empty()) {
    if (!frame_.state.scene.loaded() && !frame_.state.scene.is_opening()) {
      awaits_ = Awaits::nothing;
      fail(tr("scene: is missing, and no scene is open"));
      return;
    }
    awaits_ = Awaits::run;
    on_snapshot();
    return;
  }
  SolveOptions& solve = requested_.options.solve;
  const RunOptions now = settings_.options();
  solve.threads = now.solve.threads;
  solve.memory = now.solve.memory;
  settings_.set_options(requested_.options);
  applied_options_ = settings_.options();
  RunOptions options = applied_options_;
  options.input = requested_.options.input;
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot || !frame_.state.scene.is_open(requested_.scene, options)) {
    awaits_ = Awaits::scene;
    opened_here_ = true;
    frame_.state.scene.open(requested_.scene, options, requested_.solve);
    return;
  }
  awaits_ = Awaits::run;
  const bool beyond = requested_.solve.kind != Goal::Kind::finished &&
                      (snapshot->passes_done > requested_.solve.passes ||
                       (requested_.solve.passes == 0 && !snapshot->statistics.refinement.empty()));
  if (beyond || !is_requested(*snapshot)) {
    run_before_ = snapshot->kept_directions.front();
    frame_.state.runner.restart(SolveWorker::choice_of(requested_.options), requested_.solve);
  } else {
    frame_.state.runner.set_goal(requested_.solve);
  }
  on_snapshot();
}

// When requests follow one another quickly, each opens the scene, so it may be loaded more than
// once; each time its run starts again.
void ViewStateApplier::on_scene() {
  if (leaving_) {
    restore_appearance();
  }
  opened_here_ = opened_here_ && frame_.state.scene.is_open(requested_.scene, requested_.options);
  // Otherwise the user has opened another scene meanwhile.
  awaits_ = opened_here_ ? Awaits::run : Awaits::nothing;
}

void ViewStateApplier::restore_appearance() {
  leaving_ = false;
  if (before_lesson_) {
    apply_appearance(*before_lesson_);
    frame_.page.color_controls()->set_direction(before_lesson_->direction_shown);
    enable_sharp(true);
    frame_.state.focus.set_phase(Phase::after);
    if (docks_.current() == Layout::teach) {
      // The page of the lesson is about another scene.
      docks_.choose(before_lesson_->layout == Layout::debug ? Layout::debug : Layout::inspect);
    }
    before_lesson_.reset();
    follow_layout();
  }
  frame_.state.colors.set_automatic_exposure(true);
  frame_.state.focus.set_following(true);
}

// Snapshots of the previous run may still arrive.
bool ViewStateApplier::run_has_started() const {
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot) {
    return false;
  }
  if (requested_.scene.empty()) {
    return true;
  }
  return is_requested(*snapshot) && snapshot->kept_directions.front() != run_before_;
}

bool ViewStateApplier::is_requested(const SolverSnapshot& snapshot) const {
  return is_run_of(snapshot.options, requested_.options.solve) &&
         snapshot.total.has_value() == requested_.options.total &&
         (!snapshot.total || snapshot.refine.patches == requested_.options.refine.patches) &&
         (snapshot.refine == requested_.options.refine || snapshot.loaded->stored);
}

// Whether the patches that the state is about exist. Until the last round is done, the scene has
// other patches; where nothing is to be solved, there are no rounds.
bool ViewStateApplier::has_patches() const {
  return requested_.scene.empty() || requested_.solve.kind == Goal::Kind::pause ||
         !frame_.state.scene.snapshot()->refinement.left;
}

// Uses the snapshot, because the state of the runner may still belong to the previous run.
bool ViewStateApplier::run_is_over() const {
  const SolverSnapshot& snapshot = *frame_.state.scene.snapshot();
  if (snapshot.progress.finished || !has_light(snapshot)) {
    return true;
  }
  if (requested_.scene.empty()) {
    return frame_.state.runner.state() != RunState::running &&
           frame_.state.runner.state() != RunState::loading;
  }
  return requested_.solve.kind != Goal::Kind::finished &&
         snapshot.passes_done >= requested_.solve.passes;
}

void ViewStateApplier::fail(const QString& message) {
  frame_.notifier.show_failure(message);
  emit unreachable(message);
}

void ViewStateApplier::on_snapshot() {
  if (applies_view_) {
    return;  // materials that change nothing show the snapshot again at once
  }
  if (awaits_ == Awaits::run && run_has_started()) {
    run_before_ = nullptr;
    applies_view_ = true;
    apply_view();
    applies_view_ = false;
    awaits_ = Awaits::rounds;
  }
  if (awaits_ == Awaits::rounds && has_patches()) {
    apply_selection();
    awaits_ = Awaits::iteration;
  }
  if (awaits_ != Awaits::iteration) {
    return;
  }
  const int iterations = frame_.state.focus.iterations();
  const bool exists = !requested_.focus || requested_.focus->iteration < iterations;
  if (!exists && !run_is_over()) {
    return;
  }
  if (!exists) {
    fail(tr("focus: there is no iteration %1; the run has 1 to %2")
             .arg(requested_.focus->iteration + 1)
             .arg(iterations));
  }
  apply_focus();
}

void ViewStateApplier::apply_view() {
  frame_.page.show_scene();
  SceneView* view = frame_.page.scene_view();
  if (requested_.camera) {
    view->set_square_view(*requested_.camera);
  } else {
    view->reset_view();
  }
  frame_.page.color_controls()->set_direction(requested_.direction_shown);
  frame_.page.color_controls()->set_outlines(
      requested_.outlines.value_or(frame_.state.scene.outlined_by_default()));
  for (const std::string& misfit :
       frame_.state.relighting.edits().start_over(requested_.materials)) {
    frame_.notifier.show_failure(tr("materials: %1").arg(QString::fromStdString(misfit)));
  }
  // The range is set only now: the previous scene would have widened it.
  if (requested_.range_rule != RangeRule::widening) {
    return;
  }
  if (requested_.range) {
    frame_.state.colors.widen_from(requested_.range->first, requested_.range->second);
  } else {
    frame_.state.colors.set_range_rule(RangeRule::widening);
  }
}

void ViewStateApplier::apply_selection() {
  const PatchId patches = frame_.state.scene.snapshot()->loaded->scene->patch_count();
  const auto check = [&](const QString& key, PatchId largest) {
    if (largest >= patches) {
      fail(tr("%1: there is no patch %2; the scene has 0 to %3")
               .arg(key)
               .arg(largest)
               .arg(patches - 1));
    }
  };
  const auto last_of = [](const std::vector<PatchRange>& ranges) {
    return ranges.empty() ? no_patch : ranges.back().last;
  };
  const PatchId patch = requested_.selection < patches ? requested_.selection : no_patch;
  frame_.state.selection.select(patch);
  if (patch != no_patch && !requested_.also_selected.empty()) {
    std::vector<PatchId> all = patches_in(requested_.also_selected, patches);
    if (!std::binary_search(all.begin(), all.end(), patch)) {
      all.insert(std::lower_bound(all.begin(), all.end(), patch), patch);
    }
    frame_.state.selection.select_all(std::move(all));
  }
  frame_.page.hidden().reset(patches, patches_in(requested_.hidden, patches));
  check(QStringLiteral("select"), requested_.selection);
  check(QStringLiteral("also-selected"), last_of(requested_.also_selected));
  check(QStringLiteral("hidden"), last_of(requested_.hidden));
  check(QStringLiteral("callouts"), requested_.pointed_at);
}

void ViewStateApplier::apply_focus() {
  Focus& focus = frame_.state.focus;
  if (!requested_.focus) {
    awaits_ = Awaits::nothing;
    focus.set_following(true);
    return;
  }
  awaits_ = Awaits::direction;
  const int passes = focus.passes_of(requested_.focus->iteration);
  if (requested_.focus->iteration < focus.iterations() && requested_.focus->direction >= passes) {
    fail(tr("focus: there is no direction %1; the run has 1 to %2")
             .arg(requested_.focus->direction + 1)
             .arg(passes));
  }
  const auto* step = std::get_if<std::int32_t>(&requested_.focus->step);
  focus.go_to({requested_.focus->iteration, requested_.focus->direction, step ? *step : -1},
              StepReason::page);
}

void ViewStateApplier::on_direction() {
  if (awaits_ != Awaits::direction || !frame_.state.focus.arrived()) {
    return;
  }
  awaits_ = Awaits::nothing;
  Focus& focus = frame_.state.focus;
  const auto* name = std::get_if<StepName>(&requested_.focus->step);
  if (name && *name == StepName::whole) {
    focus.show_whole();
    return;
  }
  if (name) {
    focus.seek(find_named(*name, frame_.state.selection.patch()), StepOrder::forward,
               StepReason::page);
  }
  focus.set_phase(requested_.focus->phase);
}

bool ViewStateApplier::arrived() const {
  return awaits_ == Awaits::nothing && frame_.state.focus.arrived();
}

ViewState ViewStateApplier::state() const {
  if (!frame_.state.scene.loaded()) {
    return {};
  }
  ViewState state = appearance();
  state.scene = frame_.state.scene.spec();
  // A scene that has just been loaded has no snapshot yet.
  const auto snapshot = frame_.state.scene.snapshot();
  state.options = settings_.options();
  state.options.scene = frame_.state.scene.options();
  state.options.input = frame_.state.scene.input();
  if (snapshot) {
    state.options = run_options_of(*snapshot, state.options.scene, state.options.input);
  }
  const RunState run = frame_.state.runner.state();
  if ((frame_.state.scene.loaded()->stored && !snapshot) ||
      (snapshot && snapshot->refinement.left && run != RunState::running)) {
    state.solve = {};  // a place within the rounds cannot be named
  } else if (snapshot && run != RunState::finished && run != RunState::running) {
    const std::int64_t passes = snapshot->passes_done;
    state.solve = passes > 0 ? Goal{Goal::Kind::passes, passes} : Goal{};
  }
  const Focus& focus = frame_.state.focus;
  if (!focus.following() && focus.map()) {
    const RunPosition& position = focus.position();
    state.focus = FocusChoice{
        position.iteration, position.direction,
        focus.at_step() ? StepChoice(position.step) : StepChoice(StepName::whole), focus.phase()};
  }
  state.materials = frame_.state.relighting.edits().changes();
  read_patches(state);
  state.camera = frame_.page.scene_view()->square_view();
  state.outlines = frame_.page.color_controls()->outlines();
  state.layout = docks_.current();
  return state;
}

void ViewStateApplier::read_patches(ViewState& state) const {
  state.selection = frame_.state.selection.patch();
  std::vector<PatchId> others = frame_.state.selection.patches();
  others.erase(std::remove(others.begin(), others.end(), state.selection), others.end());
  state.also_selected = ranges_of(others);
  std::vector<PatchId> hidden;
  for (PatchId i = 0; i < frame_.state.scene.loaded()->scene->patch_count(); ++i) {
    if (frame_.page.hidden().hidden(i)) {
      hidden.push_back(i);
    }
  }
  state.hidden = ranges_of(hidden);
}

ViewState ViewStateApplier::appearance() const {
  ViewState state;
  const ColorChoice& colors = frame_.state.colors;
  // Kept runs and measured errors are not part of a state.
  if (colors.quantity() != Quantity::difference && colors.quantity() != Quantity::measured_error) {
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
  const ShowMenu& show = *frame_.page.color_controls()->show_menu();
  for (const Overlay overlay : all_overlays) {
    if (show.overlay(overlay)->isChecked()) {
      state.overlays.push_back(overlay);
    }
  }
  state.clip = show.clip()->choice();
  state.algorithm = algorithm_.kind();
  state.direction_shown = frame_.page.color_controls()->direction();
  state.labels = map_.labels_shown();
  return state;
}

}  // namespace transillum::viewer
