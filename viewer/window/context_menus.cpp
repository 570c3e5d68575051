// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/context_menus.h"

#include <QAbstractItemView>
#include <QClipboard>
#include <QGuiApplication>
#include <QMainWindow>
#include <QMenu>

#include "model/material_edits.h"
#include "patches/patch_table.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "solve/convergence_view.h"
#include "state/step_events.h"
#include "stepping/timeline_lanes.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "window/base/dock_layouts.h"
#include "window/base/open_scene.h"
#include "window/scene_bars.h"

namespace transillum::viewer {

namespace {

/// Finds steps that process a fragment of the patch.
StepFinder find_processing(PatchId patch) {
  return find_where([patch](const MapHistory& history, std::int32_t step) {
    return history.step(step).patch == patch;
  });
}

}  // namespace

ContextMenus::ContextMenus(const WindowFrame& frame, DockLayouts& docks)
    : QObject(&frame.window), frame_(frame), docks_(docks) {
  SceneView* view = frame_.page.scene_view();
  connect(view, &SceneView::menu_requested, this, [this, view](const QPoint& position) {
    show_patch_menu(view->patch_at(position), view->canvas()->mapToGlobal(position));
  });
  for (const char* table : {"patch_table", "partner_table"}) {
    add_to_table(*frame_.window.findChild<QAbstractItemView*>(QLatin1String(table)));
  }
  add_actions(*frame_.window.findChild<ConvergenceView*>(),
              {"copy_values", "export_values", "export_charts"});
  add_actions(*frame_.window.findChild<TimelineLanes*>(),
              {"step_back", "step_on", "previous_event", "next_event", "previous_direction",
               "next_direction", "follow_newest", "copy_step"});
}

void ContextMenus::add_to_table(QAbstractItemView& table) {
  table.setContextMenuPolicy(Qt::CustomContextMenu);
  connect(&table, &QWidget::customContextMenuRequested, this, [this, &table](const QPoint& place) {
    const QModelIndex index = table.indexAt(place);
    const auto* rows = qobject_cast<const PatchTable*>(table.model());
    if (rows && index.isValid()) {
      show_patch_menu(rows->patch(index.row()), table.viewport()->mapToGlobal(place));
    }
  });
}

void ContextMenus::add_actions(QWidget& widget, std::initializer_list<const char*> names) {
  widget.setContextMenuPolicy(Qt::ActionsContextMenu);
  for (const char* name : names) {
    widget.addAction(frame_.window.findChild<QAction*>(QLatin1String(name)));
  }
}

void ContextMenus::add_action(QMenu& menu, const char* name) {
  menu.addAction(frame_.window.findChild<QAction*>(QLatin1String(name)));
}

/// @param patch  no_patch beside the scene
/// @param place  on the screen
void ContextMenus::show_patch_menu(PatchId patch, const QPoint& place) {
  if (!frame_.state.scene.loaded()) {
    return;
  }
  auto* menu = named("patch_menu", new QMenu(&frame_.window));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  if (patch != no_patch) {
    // The entries are about the patch under the pointer, or about the selection that it is in.
    if (!frame_.state.selection.contains(patch)) {
      frame_.state.selection.select(patch);
    }
    const Scene& scene = *frame_.state.scene.loaded()->scene;
    const std::string& name = scene.material(patch).name;
    menu->addSection(name.empty()
                         ? tr("Patch %1").arg(patch)
                         : tr("Patch %1, %2").arg(patch).arg(QString::fromStdString(name)));
    add_showing(*menu, patch);
    menu->addSeparator();
    add_emitting(*menu, patch);
    menu->addSeparator();
    add_selecting(*menu);
  }
  add_action(*menu, "show_all");
  menu->popup(place);
}

void ContextMenus::add_showing(QMenu& menu, PatchId patch) {
  menu.addAction(tr("What lights it"), this, [this] { docks_.bring_to_front("received"); })
      ->setObjectName("show_received");
  menu.addAction(tr("Light paths to it"), this, [this] { docks_.bring_to_front("paths"); })
      ->setObjectName("show_paths");
  QAction* step = menu.addAction(tr("Step its query"), this, [this, patch] {
    docks_.bring_to_front("map");
    const RunPosition position = frame_.state.focus.position();
    frame_.state.focus.go_to_first(position.iteration, position.direction, find_processing(patch));
  });
  step->setObjectName("step_query");
  enable_if(*step, frame_.state.focus.map() != nullptr, tr("No direction is shown yet"));
  menu.addAction(tr("Copy the number"), this,
                 [patch] { QGuiApplication::clipboard()->setText(QString::number(patch)); })
      ->setObjectName("copy_number");
}

void ContextMenus::add_emitting(QMenu& menu, PatchId patch) {
  QMenu* targets = menu.addMenu(tr("Make it emit"));
  const auto loaded = frame_.state.scene.loaded();
  for (const TargetKind kind : {TargetKind::face, TargetKind::material, TargetKind::group}) {
    const std::string target = MaterialEdits::target_of(*loaded->scene, kind, patch);
    if (!target.empty()) {
      targets->addAction(target_text(target), this, [this, target] {
        frame_.window.findChild<LightOffer*>()->make_emit(target);
      });
    }
  }
}

void ContextMenus::add_selecting(QMenu& menu) {
  for (const char* name : {"select_material", "select_group", "select_face"}) {
    add_action(menu, name);
  }
  menu.addSeparator();
  for (const char* name : {"hide_selection", "isolate_selection"}) {
    add_action(menu, name);
  }
}

}  // namespace transillum::viewer
