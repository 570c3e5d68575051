// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "algorithm_state.h"
#include "selection.h"

class QLabel;

namespace transillum::viewer {

class ValueGrid;

/// The paper's pseudo-code with the line in focus marked, and what its variables hold.
class AlgorithmView : public QWidget {
  Q_OBJECT

 public:
  AlgorithmView(const Focus& focus, const Selection& selection, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

 private:
  void show_moment();
  void show_values(const AlgorithmState& state);

  const Focus& focus_;
  const Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::vector<QLabel*> lines_;  ///< as algorithm_code()
  ValueGrid* values_;
  QLabel *moment_, *i_, *map_, *lists_, *j_, *weight_, *radiosity_, *gathered_;
};

}  // namespace transillum::viewer
