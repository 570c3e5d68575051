// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/workspace_bar.h"

#include <QToolButton>

#include "solve/solve_actions.h"
#include "window/base/dock_layouts.h"

namespace transillum::viewer {

WorkspaceBar::WorkspaceBar(const DockLayouts& docks, QAction& start, QAction& open,
                           const SolveActions& actions)
    : QToolBar(tr("Tools")), docks_(docks), start_(start), open_(open), actions_(actions) {
  setObjectName("tool_bar");
  setMovable(false);
  setContextMenuPolicy(Qt::PreventContextMenu);  // its menu would hide the bar
  setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  add_tab(&start_);
  for (const Layout layout : {Layout::teach, Layout::inspect, Layout::debug}) {
    add_tab(docks_.action(layout));
  }
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  gap_ = addWidget(gap);
  addAction(&open_);
  connect(&docks_, &DockLayouts::switched, this, &WorkspaceBar::show_tools);
  show_tools();
}

void WorkspaceBar::add_tab(QAction* action) {
  auto* tab = new QToolButton;
  tab->setDefaultAction(action);
  tab->setToolButtonStyle(Qt::ToolButtonTextOnly);
  tab->setProperty("workspace", true);  // the style sheet marks the current one
  addWidget(tab);
}

// Lessons solve by themselves; one direction at a time is for stepping.
void WorkspaceBar::show_tools() {
  const Layout layout = docks_.current();
  const bool none = start_.isChecked() || layout == Layout::teach;
  const QList<QAction*> tools = none ? QList<QAction*>() : actions_.tools(layout == Layout::debug);
  if (tools == tools_) {
    return;
  }
  for (QAction* tool : tools_) {
    removeAction(tool);
  }
  tools_ = tools;
  insertActions(&open_, tools_);
}

}  // namespace transillum::viewer
