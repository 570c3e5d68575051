// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "state/breakpoints.h"
#include "state/focus.h"
#include "state/selection.h"

class QAction;
class QComboBox;
class QLabel;
class QLayout;
class QLineEdit;
class QListWidget;
class QMenu;
class QSpinBox;
class QToolButton;

namespace transillum::viewer {

/// The list of breakpoints, with how often the last run hit each; rows to add one or a condition
/// of one; and actions that run to the next and the previous one.
class BreakpointPanel : public QWidget {
  Q_OBJECT

 public:
  BreakpointPanel(Focus& focus, Selection& selection, Breakpoints& breakpoints,
                  QWidget* parent = nullptr);

  void add_to(QMenu& menu) const;

 private:
  void make_actions();
  void make_list();
  QLayout* make_buttons();
  QWidget* make_new_row();
  QLayout* make_join_row();
  void show_list();
  void show_run_menu(const QPoint& position);
  void show_inputs();
  void show_state();
  void mark_current();
  QString text_of_row(int row) const;
  Condition entered() const;
  void add_new();
  void join_new(bool alternative);
  void remove_current();
  void run(StepOrder order);

  Focus& focus_;
  Selection& selection_;
  Breakpoints& breakpoints_;
  QListWidget* list_;
  QComboBox* kind_;
  QSpinBox *patch_, *other_;
  QLineEdit* value_;
  QLabel* unit_;
  QLabel* hint_;
  QToolButton *add_, *and_, *or_, *remove_;
  QSpinBox* stop_at_;
  std::shared_ptr<HitCounts> hits_;  ///< hits of the last run; null if the list has changed since
  QAction *run_on_, *run_back_;
};

}  // namespace transillum::viewer
