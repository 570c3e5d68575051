// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "state/focus.h"
#include "state/selection.h"

class QTreeView;

namespace transillum::viewer {

class TreeModel;
class TreeOutline;

/// The whole BSP tree, to be opened node by node; the way to the polygon in focus is open.
class TreeBrowser : public QWidget {
  Q_OBJECT

 public:
  TreeBrowser(Focus& focus, Selection& selection, QWidget* parent = nullptr);

  /// Null: there is nothing to show.
  void show_position(const std::shared_ptr<const TreeOutline>& outline);

 protected:
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void open_path();
  void set_widths();

  Focus& focus_;
  Selection& selection_;
  std::shared_ptr<const TreeOutline> outline_;
  QTreeView* view_;
  TreeModel* model_;
  std::vector<std::int32_t> opened_;  ///< by open_path(), from the root
};

}  // namespace transillum::viewer
