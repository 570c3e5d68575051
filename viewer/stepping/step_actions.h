// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <vector>

#include "state/focus.h"
#include "state/selection.h"
#include "widgets/theme.h"

class QAction;
class QKeySequence;
class QMenu;

namespace transillum::viewer {

/// Actions that move the focus through a run: menu items, buttons and keys.
class StepActions : public QObject {
  Q_OBJECT

 public:
  StepActions(Focus& focus, Selection& selection, QObject* parent = nullptr);

  void add_to(QMenu& menu) const;
  /// The actions with an icon, from those that go back to those that go forward, without newest().
  std::vector<QAction*> buttons() const { return buttons_; }
  QAction* newest() const { return newest_; }

 private:
  void add_moves();
  void add_newest();
  QAction* add(const char* name, const QString& text, const QKeySequence& key, const QString& tip,
               void (StepActions::*what)(StepOrder), StepOrder order);
  void step(StepOrder order);
  void phase(StepOrder order);
  void event(StepOrder order);
  void exchange(StepOrder order);
  void seek(StepFinder finder, PatchId patch, StepOrder order);
  void direction(StepOrder order);
  void iteration(StepOrder order);
  void show_state();

  Focus& focus_;
  Selection& selection_;
  std::vector<QAction*> actions_;
  std::vector<QAction*> buttons_;
  QAction* newest_;
  QAction *next_event_, *previous_event_;
};

}  // namespace transillum::viewer
