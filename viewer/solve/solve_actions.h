// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QList>
#include <QObject>

#include "model/snapshot.h"

class QAction;
class QWidget;

namespace transillum::viewer {

/// The actions run, pause, one direction, one iteration and start over, for a menu and a tool bar,
/// and the division along the edges of shadows.
class SolveActions : public QObject {
  Q_OBJECT

 public:
  explicit SolveActions(QObject* parent = nullptr);

  void add_to(QWidget& menu) const;
  /// The actions of a tool bar. @param single  also those for a single direction and iteration
  QList<QAction*> tools(bool single) const;
  /// Enables the actions that apply.
  /// @param at_start no direction has been processed yet
  void show_state(RunState state, bool at_start);
  /// Enables the division along the edges of shadows, unless there is a reason against it.
  void set_division_refused(const QString& why);

 signals:
  void run();
  void pause();
  void one_direction();
  void one_iteration();
  void stop();
  void divide_along_shadows();

 private:
  QAction *run_, *pause_, *one_direction_, *one_iteration_, *stop_, *divide_;
};

}  // namespace transillum::viewer
