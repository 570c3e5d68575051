// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "colors/run_beside.h"
#include "state/selection.h"

class QLabel;
class QTableWidget;
class QToolButton;

namespace transillum::viewer {

/// The differences of the open scene from a run beside it, along the direction in focus: a
/// sentence, and a table of patches, which can be copied.
class BesideView : public QWidget {
  Q_OBJECT

 public:
  BesideView(const RunBeside& beside, Selection& selection, QWidget* parent = nullptr);

 private:
  void show_state();

  const RunBeside& beside_;
  QLabel* words_;
  QTableWidget* table_;
  QToolButton* copy_;
};

}  // namespace transillum::viewer
