// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "state/focus.h"
#include "state/selection.h"

class QLabel;
class QTableView;
class QTabWidget;

namespace transillum::viewer {

class TreeOutline;
class TreeBrowser;
class TreePathTable;

/// The current fragment's place in the BSP order: the planes of the tree from the root to it, each
/// with the fragments before and after; on a second tab the whole tree.
class TreeView : public QWidget {
  Q_OBJECT

 public:
  TreeView(Focus& focus, Selection& selection, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void make_path_table();
  void show_position();
  void show_text();
  QString text_of_selection() const;

  Focus& focus_;
  Selection& selection_;
  std::shared_ptr<const TreeOutline> outline_;
  QLabel* text_;
  QTableView* table_;
  TreePathTable* path_;
  TreeBrowser* browser_;
  QTabWidget* tabs_;
};

}  // namespace transillum::viewer
