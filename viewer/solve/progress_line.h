// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "model/snapshot.h"

class QLabel;
class QProgressBar;

namespace transillum::viewer {

/// The status bar: scene, phase, progress, rate and time left.
class ProgressLine : public QWidget {
  Q_OBJECT

 public:
  explicit ProgressLine(QWidget* parent = nullptr);

  void show_scene(const LoadedScene& loaded);
  void show_loading(const QString& phase, double fraction);
  void show_state(RunState state);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

 private:
  void show_solve();
  void set_steps(int steps);
  void show_bar(const SolveProgress& progress, bool within);
  void show_stage_of_lobes(const SolveProgress& progress);

  RunState state_ = RunState::empty;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLabel* scene_;
  QLabel* phase_;
  QProgressBar* bar_;
  QLabel* rate_;
  QLabel* time_;
};

}  // namespace transillum::viewer
