// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "model/snapshot.h"
#include "window/window_parts.h"

namespace transillum::viewer {

class SolveActions;
class ViewStateApplier;

/// Connects the actions and settings of a solve with the runner: run, pause, step, start over, and
/// solving again with changed settings.
class SolveControl : public QObject {
  Q_OBJECT

 public:
  SolveControl(const WindowParts& parts, SolveActions& actions, ViewStateApplier& applier);

 private:
  void run();
  /// Solves with the settings of the panel; reads the scene again where its options differ.
  void solve_again();
  void solve_with_replicas();
  void show_state(RunState state);

  WindowParts parts_;
  SolveActions& actions_;
  ViewStateApplier& applier_;
};

}  // namespace transillum::viewer
