// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "colors/run_beside.h"
#include "state/selection.h"

class QComboBox;
class QLabel;
class QTableWidget;
class QToolButton;

namespace transillum::viewer {

/// The differences of the open scene from a run beside it: a sentence, and a table of one quantity
/// by patch, the largest change first. Everything can be copied.
class BesideView : public QWidget {
  Q_OBJECT

 public:
  BesideView(const RunBeside& beside, Selection& selection, QWidget* parent = nullptr);

 private:
  /// The quantity of the table, in the order of the list.
  enum class Shown { area, factor_sum, radiosity, factors };
  /// A row of the table.
  struct Line {
    PatchId patch;
    double there, here, change;
  };

  void show_state();
  void show_table();
  std::vector<Line> lines(const DirectionComparison& comparison) const;
  void select_row(int row);

  const RunBeside& beside_;
  Selection& selection_;
  QLabel* words_;
  QComboBox* shown_;
  QTableWidget* table_;
  QToolButton* copy_;
};

}  // namespace transillum::viewer
