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
  connect(solve_, &QAction::triggered, this, &CommandActions::copy_solve);
  connect(map_, &QAction::triggered, this, &CommandActions::copy_map);
  connect(&parts_.scene, &OpenScene::snapshot_shown, this, [this] {
    // The commands read scenes, not results.
    solve_->setEnabled(parts_.scene.loaded()->description != nullptr);
  });
  connect(&parts_.focus, &Focus::moved, this,
          [this] { map_->setEnabled(solve_->isEnabled() && parts_.focus.map()); });
}

void CommandActions::add_to(QMenu& menu) const {
  menu.addAction(solve_);
  menu.addAction(map_);
}

RunOptions CommandActions::options() const {
  return {parts_.scene.snapshot()->options, parts_.scene.options(), parts_.scene.input()};
}

void CommandActions::copy_solve() {
  QApplication::clipboard()->setText(QString::fromStdString(
      solve_command(parts_.scene.spec(), options(), parts_.relighting.edits().changes())));
}

void CommandActions::copy_map() {
  QApplication::clipboard()->setText(QString::fromStdString(
      map_command(parts_.scene.spec(), options(), parts_.relighting.edits().changes(),
                  parts_.focus.map()->record().frame.omega)));
}

}  // namespace transillum::viewer
