// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "colors/color_choice.h"
#include "radiosity/analysis/result_comparison.h"
#include "state/selection.h"

class QAction;
class QComboBox;
class QLabel;
class QLayout;
class QTableWidget;
class QTableWidgetItem;
class QToolButton;

namespace transillum::viewer {

class RunBeside;

/// The list of kept runs, to name and remove them; the choice of two to compare, and their
/// difference.
class KeptRunPanel : public QWidget {
  Q_OBJECT

 public:
  /// @param beside  shows the run chosen in the list beside the open scene
  /// @param keep, difference  actions of the menu, also buttons here
  KeptRunPanel(ColorChoice& colors, Selection& selection, RunBeside& beside, QAction& keep,
               QAction& difference, QWidget* parent = nullptr);

 signals:
  /// The patch of the largest difference has been selected.
  void patch_chosen();

 private:
  void make_table();
  QLayout* make_buttons(QAction& keep, QAction& difference);
  QLayout* make_choices();
  QLayout* make_values();
  void show_list();
  void show_choices();
  void show_difference();
  void show_comparison(const ResultComparison& comparison);
  void show_hint();
  void show_beside(bool shown);
  void rename(const QTableWidgetItem& item);
  void remove_current();
  void go_to_worst();
  void showEvent(QShowEvent* event) override;

  ColorChoice& colors_;
  KeptRuns& runs_;
  Selection& selection_;
  RunBeside& beside_;
  QTableWidget* table_;
  QLabel *hint_, *values_;
  QComboBox *first_, *second_;
  QToolButton *remove_, *go_, *side_;
  PatchId worst_ = no_patch;
};

}  // namespace transillum::viewer
