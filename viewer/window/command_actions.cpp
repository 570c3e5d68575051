// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/command_actions.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QMainWindow>
#include <QMenu>

#include "model/command_text.h"
#include "solve/settings_panel.h"

namespace transillum::viewer {

CommandActions::CommandActions(const WindowParts& parts) : QObject(&parts.window), parts_(parts) {
  const auto add = [this](const char* name, const QString& text, const char* key,
                          const QString& tip) {
    auto* action = new QAction(text, this);
    action->setObjectName(QString::fromLatin1(name));
    action->setShortcut(QKeySequence(QString::fromLatin1(key)));
    action->setToolTip(tip);
    action->setEnabled(false);
    return action;
  };
  solve_ = add("copy_solve", tr("Copy the solve as a command"), "Ctrl+Shift+C",
               tr("Copy a line for a shell that makes this solve with the program transillum"));
  map_ = add("copy_map", tr("Copy the map as a command"), "Ctrl+Shift+M",
             tr("Copy a line for a shell that writes the map of this direction; add --out FILE"));
  step_ = add("copy_step", tr("Copy the step as a command"), "Ctrl+Alt+M",
              tr("Copy a line for a shell that writes V at this step and phase; add --out FILE"));
  connect(step_, &QAction::triggered, this, &CommandActions::copy_step);
  connect(solve_, &QAction::triggered, this, &CommandActions::copy_solve);
  connect(map_, &QAction::triggered, this, [this] { copy_map({}); });
  connect(&parts_.scene, &OpenScene::snapshot_shown, this, [this] {
    // The commands read scenes, not results.
    solve_->setEnabled(parts_.scene.loaded()->description != nullptr);
  });
  connect(&parts_.focus, &Focus::moved, this, [this] {
    const bool any = solve_->isEnabled() && parts_.focus.map();
    map_->setEnabled(any);
    step_->setEnabled(any);
  });
}

void CommandActions::add_to(QMenu& menu) const {
  menu.addAction(solve_);
  menu.addAction(map_);
  menu.addAction(step_);
}

RunOptions CommandActions::options() const {
  const SolverSnapshot& snapshot = *parts_.scene.snapshot();
  return {snapshot.options, parts_.scene.options(), parts_.scene.input(), snapshot.refine};
}

void CommandActions::copy_solve() {
  QApplication::clipboard()->setText(QString::fromStdString(
      solve_command(parts_.scene.spec(), options(), parts_.relighting.edits().changes())));
}

void CommandActions::copy_map(std::optional<std::int32_t> steps) {
  QApplication::clipboard()->setText(QString::fromStdString(
      map_command(parts_.scene.spec(), options(), parts_.relighting.edits().changes(),
                  parts_.focus.map()->record().frame.omega, steps)));
}

void CommandActions::copy_step() {
  const Focus& focus = parts_.focus;
  const bool before = focus.phase() == Phase::before && focus.position().step >= 0;
  copy_map(focus.position().step + (before ? 0 : 1));
}

}  // namespace transillum::viewer
