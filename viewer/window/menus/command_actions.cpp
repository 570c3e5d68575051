// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/command_actions.h"

#include <QApplication>
#include <QClipboard>
#include <QMainWindow>
#include <QMenu>
#include <utility>

#include "map/map_view.h"
#include "model/command_text.h"
#include "model/snapshot_values.h"
#include "solve/settings_panel.h"
#include "widgets/build.h"

namespace transillum::viewer {

CommandActions::CommandActions(const WindowFrame& frame, const MapView& view,
                               std::function<bool()> saved)
    : QObject(&frame.window), frame_(frame), view_(view), saved_(std::move(saved)) {
  const auto add = [this](const char* name, const QString& text, const char* key,
                          const QString& tip) {
    auto* action = make_action(this, name, text, tip, QKeySequence(QString::fromLatin1(key)));
    enable_if(*action, false, tr("No scene is solved yet"));
    return action;
  };
  solve_ = add("copy_solve", tr("Copy the solve as a command"), "Ctrl+Shift+C",
               tr("Copy a shell command that makes this solve with the program transillum"));
  map_ = add("copy_map", tr("Copy the map as a command"), "Ctrl+Shift+M",
             tr("Copy a shell command that writes the map of this direction"));
  step_ = add("copy_step", tr("Copy the step as a command"), "Ctrl+Alt+M",
              tr("Copy a shell command that writes V at this step and phase"));
  connect(step_, &QAction::triggered, this, &CommandActions::copy_step);
  connect(solve_, &QAction::triggered, this, &CommandActions::copy_solve);
  connect(map_, &QAction::triggered, this, [this] { copy_map({}); });
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, [this] {
    // The commands read scenes, not results.
    enable_if(*solve_, frame_.state.scene.loaded()->description != nullptr,
              tr("A result file does not say how it was made"));
  });
  connect(&frame_.state.focus, &Focus::moved, this, [this] {
    const bool any = solve_->isEnabled() && frame_.state.focus.map();
    for (QAction* action : {map_, step_}) {
      enable_if(*action, any, tr("No direction is shown yet"));
    }
  });
}

void CommandActions::add_to(QMenu& menu) const { menu.addActions({solve_, map_, step_}); }

RunOptions CommandActions::options() const {
  return run_options_of(*frame_.state.scene.snapshot(), frame_.state.scene.options(),
                        frame_.state.scene.input());
}

std::vector<MaterialChange> CommandActions::changes() const {
  return frame_.state.scene.has_saved_faces() ? std::vector<MaterialChange>()
                                              : frame_.state.relighting.edits().changes();
}

void CommandActions::copy_solve() {
  if (!saved_()) {
    return;
  }
  const std::string command = solve_command(frame_.state.scene.spec(), options(), changes());
  QApplication::clipboard()->setText(QString::fromStdString(command));
}

void CommandActions::copy_map(std::optional<std::int32_t> steps) {
  if (!saved_()) {
    return;
  }
  QApplication::clipboard()->setText(QString::fromStdString(map_command(
      frame_.state.scene.spec(), options(), changes(),
      frame_.state.focus.map()->record().frame.omega, steps, steps ? no_patch : view_.receiver())));
}

void CommandActions::copy_step() {
  const Focus& focus = frame_.state.focus;
  const bool before = focus.phase() == Phase::before && focus.position().step >= 0;
  copy_map(focus.position().step + (before ? 0 : 1));
}

}  // namespace transillum::viewer
