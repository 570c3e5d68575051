// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/solve_actions.h"

#include <QKeySequence>
#include <QWidget>

#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QAction* make_action(QObject* parent, theme::Icon icon, const char* name, const QString& text,
                     const QKeySequence& key, const QString& tip) {
  auto* action = make_key_action(parent, name, text, tip, key);
  action->setIcon(theme::icon(icon));
  return action;
}

}  // namespace

SolveActions::SolveActions(QObject* parent) : QObject(parent) {
  run_ = make_action(this, theme::Icon::run, "run", tr("Run"), Qt::Key_F5,
                     tr("Solve until converged"));
  pause_ = make_action(this, theme::Icon::pause, "pause", tr("Pause"), Qt::Key_F6,
                       tr("Pause after the current direction"));
  one_direction_ = make_action(this, theme::Icon::one_direction, "one_direction",
                               tr("One direction"), Qt::Key_F7, tr("Process one more direction"));
  one_iteration_ = make_action(this, theme::Icon::one_iteration, "one_iteration",
                               tr("One iteration"), Qt::Key_F8, tr("Finish this iteration"));
  stop_ = make_action(this, theme::Icon::stop, "stop", tr("Start over"),
                      QKeySequence(QStringLiteral("Shift+F5")),
                      tr("Discard this solve and return to the first direction, or stop loading"));
  divide_ = make_key_action(this, "divide_shadows", tr("Divide along shadow edges"),
                            tr("Divide the patches where the sun's shadows end, and solve"), {});
  connect(divide_, &QAction::triggered, this, &SolveActions::divide_along_shadows);
  connect(run_, &QAction::triggered, this, &SolveActions::run);
  connect(pause_, &QAction::triggered, this, &SolveActions::pause);
  connect(one_direction_, &QAction::triggered, this, &SolveActions::one_direction);
  connect(one_iteration_, &QAction::triggered, this, &SolveActions::one_iteration);
  connect(stop_, &QAction::triggered, this, &SolveActions::stop);
  show_state(RunState::empty, true);
  set_division_refused(tr("No scene is open"));
}

void SolveActions::add_to(QWidget& menu) const {
  menu.addActions(tools(true));
  menu.addAction(divide_);
}

void SolveActions::set_division_refused(const QString& why) {
  enable_if(*divide_, why.isEmpty(), why);
}

QList<QAction*> SolveActions::tools(bool single) const {
  return single ? QList<QAction*>{run_, pause_, one_direction_, one_iteration_, stop_}
                : QList<QAction*>{run_, pause_, stop_};
}

void SolveActions::show_state(RunState state, bool at_start) {
  const bool paused = state == RunState::paused;
  const bool running = state == RunState::running;
  const bool loading = state == RunState::loading;
  stop_->setText(loading ? tr("Stop loading") : tr("Start over"));
  const QString why = state == RunState::empty      ? tr("No scene is open")
                      : loading                     ? tr("A scene is being loaded")
                      : state == RunState::finished ? tr("The solve has converged")
                                                    : tr("The solve is under way");
  enable_if(*run_, paused, why);
  enable_if(*pause_, running, paused ? tr("The solve is paused") : why);
  enable_if(*one_direction_, paused || running, why);
  enable_if(*one_iteration_, paused || running, why);
  enable_if(*stop_, loading || running || state == RunState::finished || (paused && !at_start),
            paused ? tr("The solve is at its first direction") : why);
}

}  // namespace transillum::viewer
