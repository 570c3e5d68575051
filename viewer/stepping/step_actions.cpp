// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The actions of the Step menu and the timeline's buttons; each moves Focus to another phase, step,
// direction or iteration.
#include "stepping/step_actions.h"

#include <QKeySequence>
#include <QMenu>
#include <utility>

#include "widgets/build.h"

namespace transillum::viewer {

StepActions::StepActions(Focus& focus, Selection& selection, QObject* parent)
    : QObject(parent), focus_(focus), selection_(selection) {
  add_moves();
  add_newest();
  connect(&focus_, &Focus::target_changed, this, &StepActions::show_state);
  connect(&focus_, &Focus::moved, this, &StepActions::show_state);
  connect(&selection_, &Selection::changed, this, &StepActions::show_state);
  show_state();
}

void StepActions::add_moves() {
  using S = StepActions;
  constexpr StepOrder on = StepOrder::forward, back = StepOrder::backward;
  QAction* previous_direction =
      add("previous_direction", tr("Previous direction"), Qt::Key_BracketLeft,
          tr("Go to the same step of the previous direction"), &S::direction, back);
  QAction* previous_exchange =
      add("previous_exchange", tr("Previous exchange"), QKeySequence(QStringLiteral("Shift+T")),
          tr("Go back to a step that exchanges light"), &S::exchange, back);
  previous_event_ = add(
      "previous_event", tr("Previous event of the patch"), QKeySequence(QStringLiteral("Shift+N")),
      tr("Go back to a step that processes, cuts or covers the selected patch"), &S::event, back);
  QAction* step_back =
      add("step_back", tr("Previous step"), Qt::Key_Comma, tr("Undo one step"), &S::step, back);
  add("phase_back", tr("Previous phase"), Qt::Key_M,
      tr("Go back one phase of the step: after, split, before"), &S::phase, back);
  QAction* phase_on =
      add("phase_on", tr("Next phase"), Qt::Key_Slash,
          tr("Go forward one phase of the step: before, split, after"), &S::phase, on);
  QAction* step_on =
      add("step_on", tr("Next step"), Qt::Key_Period, tr("Process one fragment"), &S::step, on);
  next_event_ = add("next_event", tr("Next event of the patch"), Qt::Key_N,
                    tr("Go forward to a step that processes, cuts or covers the selected patch"),
                    &S::event, on);
  QAction* next_exchange = add("next_exchange", tr("Next exchange"), Qt::Key_T,
                               tr("Go forward to a step that exchanges light"), &S::exchange, on);
  QAction* next_direction = add("next_direction", tr("Next direction"), Qt::Key_BracketRight,
                                tr("Go to the same step of the next direction"), &S::direction, on);
  add("previous_iteration", tr("Previous iteration"), Qt::Key_BraceLeft,
      tr("Go to the same direction and step of the previous iteration"), &S::iteration, back);
  add("next_iteration", tr("Next iteration"), Qt::Key_BraceRight,
      tr("Go to the same direction and step of the next iteration"), &S::iteration, on);

  using theme::Icon;
  buttons_ = {previous_direction, previous_exchange, previous_event_, step_back, phase_on, step_on,
              next_event_,        next_exchange,     next_direction};
  const Icon icons[] = {Icon::previous_direction, Icon::previous_exchange, Icon::previous_event,
                        Icon::step_back,          Icon::phase_on,          Icon::step_on,
                        Icon::next_event,         Icon::next_exchange,     Icon::next_direction};
  for (std::size_t k = 0; k < buttons_.size(); ++k) {
    buttons_[k]->setIcon(theme::icon(icons[k]));
  }
}

void StepActions::add_newest() {
  newest_ = make_action(
      this, "follow_newest", tr("Follow newest"),
      tr("Show each new direction as it is solved, at the step with the most sources in V (F)"),
      Qt::Key_F);
  newest_->setIcon(theme::icon(theme::Icon::newest));
  newest_->setCheckable(true);
  connect(newest_, &QAction::triggered, &focus_, &Focus::set_following);
}

QAction* StepActions::add(const char* name, const QString& text, const QKeySequence& key,
                          const QString& tip, void (StepActions::*what)(StepOrder),
                          StepOrder order) {
  auto* action = make_key_action(this, name, text, tip, key);
  connect(action, &QAction::triggered, this, [this, what, order] { (this->*what)(order); });
  actions_.push_back(action);
  return action;
}

void StepActions::add_to(QMenu& menu) const {
  for (QAction* action : actions_) {
    menu.addAction(action);
  }
  menu.addSeparator();
  menu.addAction(newest_);
}

namespace {

int sign(StepOrder order) { return order == StepOrder::forward ? 1 : -1; }

}  // namespace

void StepActions::step(StepOrder order) { focus_.step_by(sign(order)); }
void StepActions::phase(StepOrder order) { focus_.phase_by(sign(order)); }
void StepActions::event(StepOrder order) {
  seek(find_events_of(selection_.patch()), selection_.patch(), order);
}
void StepActions::exchange(StepOrder order) { seek(find_exchanges(), no_patch, order); }

/// Skips steps without an event that passes the filter; if a patch is given, only its events count.
void StepActions::seek(StepFinder finder, PatchId patch, StepOrder order) {
  const EventFilter& filter = focus_.filter();
  if (filter.on()) {
    finder = find_of(std::move(finder), [filter, patch](const MapHistory& history, std::int32_t k) {
      return filter.passes_at(history, k, patch);
    });
  }
  focus_.seek(std::move(finder), order);
}

void StepActions::direction(StepOrder order) { focus_.direction_by(sign(order)); }
void StepActions::iteration(StepOrder order) { focus_.iteration_by(sign(order)); }

void StepActions::show_state() {
  const bool any = focus_.passes() > 0 && focus_.map();
  for (QAction* action : actions_) {
    enable_if(*action, any, tr("No direction is shown yet"));
  }
  const bool patch = any && selection_.patch() != no_patch;
  for (QAction* action : {next_event_, previous_event_}) {
    enable_if(*action, patch, tr("No patch is selected"));
  }
  enable_if(*newest_, focus_.passes() > 0, tr("No scene is solved yet"));
  newest_->setChecked(focus_.following());
}

}  // namespace transillum::viewer
