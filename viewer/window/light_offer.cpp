// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/light_offer.h"

#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <algorithm>
#include <string>
#include <vector>

#include "patches/material_panel.h"
#include "scene/scene_page.h"
#include "solve/settings_panel.h"
#include "widgets/banner.h"
#include "window/dock_layouts.h"
#include "window/view_state_applier.h"
#include "window/work_guard.h"

namespace transillum::viewer {

namespace {

constexpr double first_exitance = 10;  // W/m²; the exposure follows it

}  // namespace

LightOffer::LightOffer(const WindowFrame& frame, DockLayouts& docks, SettingsPanel& settings,
                       MaterialPanel& materials, ViewStateApplier& applier)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      settings_(settings),
      materials_(materials),
      applier_(applier) {
  Banner* bar = frame_.page.light_bar();
  QPushButton* button = bar->add_button("make_emit", tr("Make it emit"));
  menu_ = new QMenu(button);
  button->setMenu(menu_);
  connect(menu_, &QMenu::aboutToShow, this, &LightOffer::fill_menu);
  connect(bar, &Banner::closed, this, [this] { closed_ = true; });
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, [this] {
    closed_ = false;
    update();
    if (!frame_.state.relighting.edits().has_light()) {
      emit frame_.state.relighting.form_factors_requested();  // so that a light appears at once
    }
  });
  connect(&frame_.state.relighting.edits(), &MaterialEdits::changed, this, &LightOffer::update);
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, &LightOffer::update);
  connect(&frame_.state.selection, &Selection::changed, this, &LightOffer::update);
}

void LightOffer::update() {
  Banner& bar = *frame_.page.light_bar();
  const auto snapshot = frame_.state.scene.snapshot();
  const bool sky = snapshot && snapshot->options.sky.is_set();
  if (closed_ || sky || !frame_.state.scene.loaded() ||
      frame_.state.relighting.edits().has_light()) {
    bar.dismiss();
    return;
  }
  bar.show_message(
      Banner::Kind::offer,
      frame_.state.selection.patch() == no_patch
          ? tr("No light: the scene is shown in neutral light. Click a face to make it emit.")
          : tr("No light: make the selected face, material or group emit."));
}

void LightOffer::fill_menu() {
  menu_->clear();
  const auto loaded = frame_.state.scene.loaded();
  const PatchId patch = frame_.state.selection.patch();
  std::vector<std::string> targets;
  for (const TargetKind kind : {TargetKind::face, TargetKind::material, TargetKind::group}) {
    if (patch != no_patch) {
      targets.push_back(MaterialEdits::target_of(*loaded->scene, kind, patch));
    }
  }
  if (targets.empty()) {
    menu_->addAction(tr("Click a face in the scene to choose it"))->setEnabled(false);
  }
  for (const std::string& target : targets) {
    if (!target.empty()) {
      add_target(target_text(target), target);
    }
  }
  if (!loaded->description) {
    return;
  }
  const std::string suggested =
      frame_.state.relighting.edits().with_kind(suggested_light(*loaded->description));
  if (std::find(targets.begin(), targets.end(), suggested) == targets.end()) {
    menu_->addSeparator();
    add_target(tr("%1 (suggested)").arg(target_text(suggested)), suggested);
  }
}

void LightOffer::add_target(const QString& text, const std::string& target) {
  menu_->addAction(text, this, [this, target] { make_emit(target); });
}

void LightOffer::make_emit(const std::string& target) {
  constexpr Rgb white{first_exitance, first_exitance, first_exitance};
  const auto snapshot = frame_.state.scene.snapshot();
  if (snapshot && !snapshot->form_factors_fit && frame_.state.scene.loaded()->description) {
    // Form factors that exceed the memory limit cannot give light: only a new solve can.
    if (!frame_.guard.may_lose(&frame_.window, tr("Make it emit"))) {
      return;
    }
    RunOptions options{settings_.solve_options(), frame_.state.scene.options(),
                       frame_.state.scene.input(), settings_.refinement()};
    options.input.changes.push_back({target, {}, white});
    applier_.open_again(options);
    return;
  }
  MaterialEdits& edits = frame_.state.relighting.edits();
  edits.begin_drag();
  edits.set_exitance(target, white);
  materials_.show_target(target);
  docks_.bring_to_front("material");
}

}  // namespace transillum::viewer
