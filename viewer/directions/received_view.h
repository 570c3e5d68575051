// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "model/requests/per_direction_visibility.h"
#include "state/focus.h"
#include "state/selection.h"

class QLabel;
class QTableView;

namespace transillum::viewer {

class ReceivedTable;

/// A table of the directions of the iteration in focus and what each contributes to the irradiance
/// of the selected patch.
class ReceivedView : public QWidget {
  Q_OBJECT

 public:
  /// @param visibility shared with other views of the selected patch
  ReceivedView(Focus& focus, Selection& selection, PerDirectionVisibility& visibility,
               QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Selects the rows in which one of these sources of the selected patch is the brightest, until
  /// another patch or row is selected.
  void mark_sources(const std::vector<PatchId>& sources);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void request_visibility();
  void show_lights();
  void show_position();
  /// Returns what the caption adds about the marked rows.
  /// @param complete  all directions processed are in the table
  QString mark_rows(bool complete);
  /// Directions of the iteration in focus that have been processed.
  int directions_done() const;

  Focus& focus_;
  Selection& selection_;
  PerDirectionVisibility& visibility_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLabel* caption_;
  QTableView* view_;
  ReceivedTable* table_;
  std::vector<PatchId> marked_;  ///< sources whose rows are selected
  bool marks_rows_ = false;      ///< mark_rows() is selecting
  bool reveals_marked_ = false;  ///< scroll to the first of their rows
  class QTimer* refresh_timer_;  ///< limits how often the table is refilled
};

}  // namespace transillum::viewer
