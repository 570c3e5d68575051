// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "colors/color_choice.h"
#include "model/snapshot.h"
#include "state/focus.h"
#include "state/selection.h"

class QButtonGroup;
class QLabel;
class QStackedWidget;
class QTimer;
class QToolButton;

namespace transillum::viewer {

class HemicubeView;
class MapCanvas;
class EngineMenu;
class PhasePair;

/// The visibility map V of the direction in focus, and its changes by the current step.
class MapView : public QWidget {
  Q_OBJECT

 public:
  MapView(Focus& focus, Selection& selection, const ColorChoice& colors, QWidget* parent = nullptr);

  /// New colors; shown with the next map or after a short delay.
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();

  /// Patch numbers on the polygons.
  void set_labels_shown(bool shown);
  bool labels_shown() const;

  bool up_to_date() const;
  MapCanvas* canvas() const { return canvas_; }
  PhasePair* pair() const { return pair_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* make_controls();
  MapCanvas* make_canvas(Selection& selection, const char* name);
  void show_context_menu(const MapCanvas& canvas, const QPoint& position);
  void show_position();
  void show_title();
  QString pixel_text() const;
  bool shows_hemicube() const;
  /// Whether both phases of the step are shown, at once or in turn.
  bool shows_pair() const;
  /// In canvas_.
  Phase shown_phase() const;

  Focus& focus_;
  const ColorChoice& colors_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLabel* title_;
  QLabel* step_text_;
  MapCanvas* canvas_;
  MapCanvas* before_;  ///< beside canvas_; hidden unless two phases are shown side by side
  QWidget* canvases_;
  PhasePair* pair_;
  HemicubeView* hemicube_;
  QStackedWidget* pictures_;
  QButtonGroup* phases_;
  QToolButton* labels_;
  QToolButton* zoom_;
  std::vector<QWidget*> extras_;  ///< controls that a narrow view omits
  EngineMenu* engine_menu_;
  QTimer* recolor_timer_;
};

}  // namespace transillum::viewer
