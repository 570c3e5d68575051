// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolBar>

namespace transillum::viewer {

class DockLayouts;
class SolveActions;

/// The tool bar: the first page and the layouts as tabs, and the tools that the layout in use
/// needs.
class WorkspaceBar : public QToolBar {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  WorkspaceBar(const DockLayouts& docks, QAction& start, QAction& open,
               const SolveActions& actions);

 private:
  void add_tab(QAction* action);
  void show_tools();

  const DockLayouts& docks_;
  QAction &start_, &open_;
  const SolveActions& actions_;
  QAction* gap_;
  QList<QAction*> tools_;  ///< shown now
};

}  // namespace transillum::viewer
