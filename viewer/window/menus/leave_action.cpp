// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/leave_action.h"

#include <QAction>
#include <QMainWindow>

namespace transillum::viewer {

QAction* new_leave_action(const WindowFrame& frame, FullScreen& full_screen) {
  auto* action = new QAction(
      QMainWindow::tr("Stop loading or searching, leave the full screen, or clear the selection"),
      &frame.window);
  action->setObjectName("clear_selection");
  action->setShortcut(QKeySequence(Qt::Key_Escape));
  QObject::connect(action, &QAction::triggered, [&state = frame.state, &full_screen] {
    if (state.runner.state() == RunState::loading) {
      state.runner.stop();
    } else if (state.focus.seeking()) {
      state.focus.stop();
    } else if (full_screen.action()->isChecked()) {
      full_screen.action()->trigger();
    } else {
      state.selection.select(no_patch);
    }
  });
  return action;
}

}  // namespace transillum::viewer
