// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "state/algorithm_state.h"
#include "state/selection.h"

class QComboBox;
class QLabel;
class QVBoxLayout;

namespace transillum::viewer {

class ValueGrid;

/// The paper's pseudo-code with the current lines highlighted, and the values of its variables.
class AlgorithmView : public QWidget {
  Q_OBJECT

 public:
  AlgorithmView(const Focus& focus, const Selection& selection, QWidget* parent = nullptr);

  /// The map whose pseudo-code is shown.
  MapKind kind() const;
  /// Marks the lines with a symbol, given by its letter; marks no line if it is empty.
  void point_at(const QString& symbol);
  void set_kind(MapKind kind);
  /// Hides the values of the step, while a question asks for one of them.
  void set_values_hidden(bool hidden);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

 signals:
  /// Region R of the global map; nothing with the local map or without a probed point.
  void region_shown(const std::optional<transillum::MapRegion>& region);

 private:
  QWidget* make_code(CodeLine first, CodeLine last);
  QWidget* make_local_values();
  QWidget* make_region_values();
  void show_kind();
  void show_position();
  void show_values(const AlgorithmState& state);
  void show_region(const RegionState& state);

  const Focus& focus_;
  const Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::vector<QLabel*> lines_;  ///< in the order of algorithm_code()
  QString pointed_;             ///< a symbol
  QComboBox* kind_;
  QLabel* hidden_note_;
  bool values_hidden_ = false;
  std::vector<QWidget*> local_widgets_,
      global_widgets_;  ///< shown with the local or the global map
  ValueGrid *values_, *region_values_;
  QLabel *position_, *i_, *map_, *lists_, *j_, *weight_, *radiosity_, *gathered_;
  ValueGrid* moments_grid_;  ///< shown where B is linear on patches
  QLabel* moments_;
  QLabel *region_, *region_area_, *region_list_, *region_i_, *region_j_, *region_radiosity_,
      *region_gathered_, *region_hint_;
};

}  // namespace transillum::viewer
