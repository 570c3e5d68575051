// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "stepping/step_actions.h"

#include <QAction>
#include <QKeySequence>
#include <QMenu>

namespace transillum::viewer {

StepActions::StepActions(Focus& focus, Selection& selection, QObject* parent)
    : QObject(parent), focus_(focus), selection_(selection) {
  using S = StepActions;
  constexpr StepOrder on = StepOrder::forward, back = StepOrder::backward;
  QAction* previous_direction =
      add("previous_direction", tr("Previous direction"), Qt::Key_BracketLeft,
          tr("The same step of the direction before"), &S::direction, back);
  QAction* previous_exchange =
      add("previous_exchange", tr("Previous exchange"), QKeySequence(QStringLiteral("Shift+T")),
          tr("Back to a polygon that sees light above it"), &S::exchange, back);
  previous_event_ = add(
      "previous_event", tr("Previous event of the patch"), QKeySequence(QStringLiteral("Shift+N")),
      tr("Back to a step that cut, covered or lit the selected patch"), &S::event, back);
  QAction* step_back = add("step_back", tr("One polygon back"), Qt::Key_Comma,
                           tr("Undo one polygon"), &S::step, back);
  add("phase_back", tr("One phase back"), Qt::Key_M,
      tr("Back within the step: V after, its parts, V before"), &S::phase, back);
  QAction* phase_on = add("phase_on", tr("One phase on"), Qt::Key_Slash,
                          tr("On within the step: V before, its parts, V after"), &S::phase, on);
  QAction* step_on =
      add("step_on", tr("One polygon on"), Qt::Key_Period, tr("Process one polygon"), &S::step, on);
  next_event_ =
      add("next_event", tr("Next event of the patch"), Qt::Key_N,
          tr("On to a step that cuts, covers or lights the selected patch"), &S::event, on);
  QAction* next_exchange = add("next_exchange", tr("Next exchange"), Qt::Key_T,
                               tr("On to a polygon that sees light above it"), &S::exchange, on);
  QAction* next_direction = add("next_direction", tr("Next direction"), Qt::Key_BracketRight,
                                tr("The same step of the next direction"), &S::direction, on);
  add("previous_iteration", tr("Previous iteration"), Qt::Key_BraceLeft,
      tr("The same moment of the iteration before"), &S::iteration, back);
  add("next_iteration", tr("Next iteration"), Qt::Key_BraceRight,
      tr("The same moment of the next iteration"), &S::iteration, on);

  using theme::Icon;
  buttons_ = {previous_direction, previous_exchange, previous_event_, step_back, phase_on, step_on,
              next_event_,        next_exchange,     next_direction};
  const Icon icons[] = {Icon::previous_direction, Icon::previous_exchange, Icon::previous_event,
                        Icon::step_back,          Icon::phase_on,          Icon::step_on,
                        Icon::next_event,         Icon::next_exchange,     Icon::next_direction};
  for (std::size_t k = 0; k < buttons_.size(); ++k) {
    buttons_[k]->setIcon(theme::icon(icons[k]));
  }

  newest_ = new QAction(theme::icon(Icon::newest), tr("Follow the newest"), this);
  newest_->setObjectName("follow_newest");
  newest_->setCheckable(true);
  newest_->setShortcut(Qt::Key_F);
  newest_->setToolTip(tr("Show each new direction after the step at which most of it shines (F)"));
  connect(newest_, &QAction::triggered, &focus_, &Focus::set_following);
  connect(&focus_, &Focus::target_changed, this, &StepActions::show_state);
  connect(&focus_, &Focus::moved, this, &StepActions::show_state);
  connect(&selection_, &Selection::changed, this, &StepActions::show_state);
  show_state();
}

QAction* StepActions::add(const char* name, const QString& text, const QKeySequence& key,
                          const QString& tip, void (StepActions::*what)(StepOrder),
                          StepOrder order) {
  auto* action = new QAction(text, this);
  action->setObjectName(QString::fromLatin1(name));
  action->setShortcut(key);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(tip, key.toString(QKeySequence::NativeText)));
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
void StepActions::event(StepOrder order) { focus_.seek(find_events_of(selection_.patch()), order); }
void StepActions::exchange(StepOrder order) { focus_.seek(find_exchanges(), order); }
void StepActions::direction(StepOrder order) { focus_.direction_by(sign(order)); }
void StepActions::iteration(StepOrder order) { focus_.iteration_by(sign(order)); }

void StepActions::show_state() {
  const bool any = focus_.passes() > 0 && focus_.map();
  for (QAction* action : actions_) {
    action->setEnabled(any);
  }
  const bool patch = any && selection_.patch() != no_patch;
  next_event_->setEnabled(patch);
  previous_event_->setEnabled(patch);
  newest_->setEnabled(focus_.passes() > 0);
  newest_->setChecked(focus_.following());
}

}  // namespace transillum::viewer
