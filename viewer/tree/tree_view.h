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

/// Why the polygon in focus comes when it does: the planes of the BSP tree from the root to it,
/// each with what it puts before and after; and the tree as a whole.
class TreeView : public QWidget {
  Q_OBJECT

 public:
  TreeView(Focus& focus, Selection& selection, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void show_position();
  void show_words();
  QString words_of_selection() const;
  void select_step(std::int32_t step);
  void go_to_step(std::int32_t step);

  Focus& focus_;
  Selection& selection_;
  std::shared_ptr<const TreeOutline> outline_;
  QLabel* words_;
  QTableView* table_;
  TreePathTable* path_;
  TreeBrowser* browser_;
  QTabWidget* tabs_;
};

}  // namespace transillum::viewer
