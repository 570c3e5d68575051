// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/command_actions.h"

#include <QApplication>
#include <QClipboard>
#include <QMainWindow>
#include <QMenu>
#include <cmath>
#include <utility>

#include "map/map_view.h"
#include "model/command_text.h"
#include "model/snapshot_values.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
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
  picture_ = add("copy_picture", tr("Copy the picture as a command"), "",
                 tr("Copy a shell command that makes this solve and its sharp picture from here"));
  map_ = add("copy_map", tr("Copy the map as a command"), "Ctrl+Shift+M",
             tr("Copy a shell command that writes the map of this direction"));
  step_ = add("copy_step", tr("Copy the step as a command"), "Ctrl+Alt+M",
              tr("Copy a shell command that writes V at this step and phase"));
  connect(step_, &QAction::triggered, this, &CommandActions::copy_step);
  connect(solve_, &QAction::triggered, this, &CommandActions::copy_solve);
  connect(picture_, &QAction::triggered, this, &CommandActions::copy_picture);
  connect(map_, &QAction::triggered, this, [this] { copy_map({}); });
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, &CommandActions::show_state);
  connect(&frame_.state.colors, &ColorChoice::changed, this, &CommandActions::show_state);
  connect(&frame_.state.focus, &Focus::moved, this, &CommandActions::show_state);
  connect(&frame_.state.relighting.edits(), &MaterialEdits::changed, this,
          &CommandActions::show_state);
}

void CommandActions::add_to(QMenu& menu) const { menu.addActions({solve_, picture_, map_, step_}); }

void CommandActions::show_state() {
  const auto loaded = frame_.state.scene.loaded();
  const MaterialEdits& edits = frame_.state.relighting.edits();
  const Quantity shown = frame_.state.colors.quantity();
  const bool is_light = shown == Quantity::radiosity || shown == Quantity::eye_radiance;
  // The commands read scenes, not results.
  const QString why = !frame_.state.scene.snapshot() ? tr("No scene is solved yet")
                      : !loaded->description ? tr("A result file does not say how it was made")
                      : frame_.state.scene.input().orient
                          ? edits.why_unsolved()  // light turns faces
                          : QString();
  enable_if(*solve_, why.isEmpty(), why);
  enable_if(*picture_, why.isEmpty() && is_light,
            why.isEmpty() ? tr("The program makes pictures of light alone") : why);
  for (QAction* action : {map_, step_}) {
    enable_if(*action, why.isEmpty() && frame_.state.focus.map(),
              why.isEmpty() ? tr("No direction is shown yet") : why);
  }
}

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
  QApplication::clipboard()->setText(QString::fromStdString(solve()));
}

std::string CommandActions::solve() const {
  return solve_command(frame_.state.scene.spec(), options(), changes());
}

void CommandActions::copy_picture() {
  if (!saved_()) {
    return;
  }
  const SceneView& view = *frame_.page.scene_view();
  const ViewPoint from = view.view_point();
  const QSize size = view.canvas()->devicePixelRatioF() * view.canvas()->size();
  const ColorScale& scale = frame_.state.colors.scale();
  const bool colored = scale.mode != ColorMode::true_color;
  const PictureCommand picture{.camera = {.eye = from.eye,
                                          .target = from.target,
                                          .up = from.up,
                                          .field_of_view = from.view_angle},
                               .width = size.width(),
                               .height = size.height(),
                               .false_colors = colored,
                               .exposure = colored ? 1 / scale.high : std::exp2(scale.exposure)};
  QApplication::clipboard()->setText(QString::fromStdString(picture_command(solve(), picture)));
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
