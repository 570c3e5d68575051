// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/editing/editing.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>

#include "map/section_view.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "widgets/build.h"
#include "widgets/scrolling.h"
#include "window/base/dock_layouts.h"
#include "window/base/notifier.h"
#include "window/editing/move_handles.h"
#include "window/editing/move_panel.h"
#include "window/editing/scene_edits.h"
#include "window/editing/section_drag.h"

namespace transillum::viewer {

SceneEdits* add_editing(const WindowFrame& frame, DockLayouts& docks, QMenu& edit) {
  auto* edits = new SceneEdits(frame);
  auto* panel = new MovePanel(*edits);
  new MoveHandles(*edits, *panel);
  new SectionDrag(*edits, *frame.window.findChild<SectionView*>());
  const QDockWidget* dock = docks.add(SceneEdits::tr("Move"), "move_dock", scrollable(panel));
  QObject::connect(dock, &QDockWidget::visibilityChanged, edits, &SceneEdits::set_active);
  SceneView* view = frame.page.scene_view();
  QObject::connect(dock, &QDockWidget::visibilityChanged, view, &SceneView::set_paths_hidden);
  QObject::connect(edits, &SceneEdits::failed, &frame.notifier, &Notifier::show_failure);
  edit.addSeparator();
  QAction* move = make_action(edits, "move_faces", SceneEdits::tr("Move, turn or scale"),
                              SceneEdits::tr("Show handles of the selected object in the scene, "
                                             "and its place in numbers"),
                              QKeySequence(QStringLiteral("Shift+M")));
  QObject::connect(move, &QAction::triggered, &docks, [&docks] { docks.bring_to_front("move"); });
  edit.addAction(move);
  panel->add_to(edit);
  return edits;
}

}  // namespace transillum::viewer
