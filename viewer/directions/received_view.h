// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

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

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void request_visibility();
  void show_lights();
  void show_position();
  /// Directions of the iteration in focus that have been processed.
  int directions_done() const;

  Focus& focus_;
  Selection& selection_;
  PerDirectionVisibility& visibility_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLabel* caption_;
  QTableView* view_;
  ReceivedTable* table_;
  class QTimer* refresh_timer_;  ///< limits how often the table is refilled
};

}  // namespace transillum::viewer
