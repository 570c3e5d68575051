// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "model/per_direction_visibility.h"
#include "state/focus.h"
#include "state/selection.h"

class QLabel;
class QTableView;

namespace transillum::viewer {

class ReceivedTable;

/// The directions of the iteration in focus by what each adds to the selected patch.
class ReceivedView : public QWidget {
  Q_OBJECT

 public:
  /// `visibility` is shared with others that ask about the selected patch.
  ReceivedView(Focus& focus, Selection& selection, PerDirectionVisibility& visibility,
               QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void ask();
  void show_lights();
  void show_position();
  /// Directions of the iteration in focus that have been taken.
  int taken() const;

  Focus& focus_;
  Selection& selection_;
  PerDirectionVisibility& visibility_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLabel* words_;
  QTableView* view_;
  ReceivedTable* table_;
  class QTimer* later_;
};

}  // namespace transillum::viewer
