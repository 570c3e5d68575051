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

/// The whole BSP tree as an outline view; the path to the current fragment is kept expanded.
class TreeBrowser : public QWidget {
  Q_OBJECT

 public:
  TreeBrowser(Focus& focus, Selection& selection, QWidget* parent = nullptr);

  /// @param outline null shows an empty view
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
  std::vector<std::int32_t> opened_;  ///< nodes that open_path() expanded, from the root
};

}  // namespace transillum::viewer
