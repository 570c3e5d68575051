// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "color_choice.h"
#include "map_recorder.h"
#include "selection.h"
#include "snapshot.h"

class QLabel;
class QSlider;
class QTimer;
class QToolButton;

namespace transillum::viewer {

class MapCanvas;

/// The visibility map V of the latest direction, after any of its steps.
class MapView : public QWidget {
  Q_OBJECT

 public:
  MapView(Selection& selection, const ColorChoice& colors, QWidget* parent = nullptr);

  void show_map(std::shared_ptr<const RecordedMap> map);
  /// The colours to come: shown with the next map, or soon.
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();

  bool up_to_date() const;
  MapCanvas* canvas() const { return canvas_; }
  std::shared_ptr<const RecordedMap> map() const { return map_; }
  std::int32_t step() const;

 private:
  void show_step();
  void show_title();

  const ColorChoice& colors_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::shared_ptr<const RecordedMap> map_;
  QLabel* title_;
  QLabel* step_text_;
  MapCanvas* canvas_;
  QSlider* slider_;
  QToolButton* fullest_;
  QTimer* recolor_timer_;
};

}  // namespace transillum::viewer
