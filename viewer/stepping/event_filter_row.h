// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "state/focus.h"

class QAction;
class QLineEdit;
class QMenu;
class QToolButton;

namespace transillum::viewer {

/// The controls of the event filter: areas, patch, kinds, and a button that removes it.
class EventFilterRow : public QWidget {
  Q_OBJECT

 public:
  explicit EventFilterRow(Focus& focus, QWidget* parent = nullptr);

  void add_to(QMenu& menu) const;

 signals:
  void requested();  ///< by its key: the panel is to be brought to the front

 private:
  void make_kinds();
  void make_actions();
  void enter();
  void show_filter();

  Focus& focus_;
  QLineEdit *least_, *largest_, *patch_;
  QToolButton *kinds_, *clear_button_;
  std::vector<QAction*> kind_actions_;
  QAction *filter_, *clear_;
};

}  // namespace transillum::viewer
