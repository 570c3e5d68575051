// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "model/snapshot.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace transillum::viewer {

/// The rounds of a refinement: patches, error measure and time of each, their progress, and a
/// button that cancels them. Hidden where there are none.
class RoundPanel : public QWidget {
  Q_OBJECT

 public:
  explicit RoundPanel(QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);

 signals:
  void canceled();

 private:
  void show_table(const SolverSnapshot& snapshot);
  void show_progress(const SolverSnapshot& snapshot);
  void fit_height();
  void scroll_here();

  QTableWidget* table_;
  QLabel* phase_;
  QProgressBar* bar_;
  QPushButton* cancel_;
};

/// Number of patches of the rounds to come, this one included, and of the solve after them, if each
/// round doubles them.
struct RoundsAhead {
  int rounds = 0;
  double patches = 0;  ///< sum over all solves
};
RoundsAhead rounds_ahead(PatchId patches, const RefineChoice& refine);

}  // namespace transillum::viewer
