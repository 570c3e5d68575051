// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "colors/color_choice.h"
#include "map/map_canvas.h"
#include "model/snapshot.h"
#include "state/focus.h"
#include "state/selection.h"

class QBoxLayout;
class QButtonGroup;
class QStackedWidget;
class QTimer;
class QToolButton;

namespace transillum::viewer {

class ClauseLabel;
class HemicubeView;
class EngineMenu;
class PhasePair;
class RunBeside;
struct DirectionComparison;

/// The visibility map of the direction in focus: V and its changes by the current step, or, where
/// no step is shown, the whole direction.
class MapView : public QWidget {
  Q_OBJECT

 public:
  /// @param beside  its map is shown beside the map of the open scene
  MapView(Focus& focus, Selection& selection, const ColorChoice& colors, const RunBeside& beside,
          QWidget* parent = nullptr);

  /// New colors; shown with the next map or after a short delay.
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();

  /// Patch numbers on the polygons.
  void set_labels_shown(bool shown);
  bool labels_shown() const;

  /// The part of a whole direction that is shown.
  enum class Whole { complete, receivers, patch };
  void choose_whole(Whole whole);

  /// The patch whose map is shown; no_patch while V or both sides are.
  PatchId receiver() const;

  bool up_to_date() const;
  MapCanvas* canvas() const { return canvas_; }
  PhasePair* pair() const { return pair_; }
  /// MapCanvas::picture() of what is shown: of both sides of a direction, or of two phases, each
  /// has its part.
  QImage picture(const QSize& pixels) const;
  /// MapCanvas::draw() likewise.
  void draw(QPainter& painter, const QSizeF& size, const QColor& ink, bool explained) const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* make_controls();
  QWidget* make_whole_buttons();
  QWidget* make_phase_buttons();
  MapCanvas* make_canvas(Selection& selection, const char* name);
  void show_context_menu(const MapCanvas& canvas, const QPoint& position);
  void show_position();
  void show_title();
  void show_buttons();
  QStringList direction_clauses() const;
  QString whole_text() const;
  QStringList step_clauses() const;
  QString pixel_text() const;
  bool shows_hemicube() const;
  /// Whether both phases of the step are shown, at once or in turn.
  bool shows_pair() const;
  /// In canvas_.
  Phase shown_phase() const;
  /// The part of a whole direction that is drawn; not set while a step is shown, or the V of an
  /// engine.
  std::optional<Whole> shown_whole() const;
  /// Sets the content of the canvases for a whole direction. @returns whether both are needed
  bool set_whole(Whole whole, MapCanvas::Content& content, MapCanvas::Content& second) const;
  /// Whether the map of another run is, or will be, in second_.
  bool shows_beside() const;
  /// Sets their content to V of the open scene and of the run beside it.
  void set_beside(const DirectionComparison& compared, MapCanvas::Content& open,
                  MapCanvas::Content& other) const;
  /// The canvases that are shown, and their parts of a picture of this size.
  std::vector<std::pair<const MapCanvas*, QRectF>> parts_of(const QSizeF& size) const;
  /// Places the canvases so that two maps are as large as possible.
  void arrange();

  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  const RunBeside& beside_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  ClauseLabel* title_;
  ClauseLabel* step_text_;
  MapCanvas* canvas_;
  MapCanvas* second_;  ///< beside canvas_: V before the step, or what receives; else hidden
  QWidget* canvases_;
  QBoxLayout* side_by_side_;  ///< layout of canvases_
  PhasePair* pair_;
  HemicubeView* hemicube_;
  QStackedWidget* pictures_;
  QBoxLayout* rows_;  ///< rows of buttons
  QWidget *whole_buttons_, *phase_buttons_;
  QButtonGroup* wholes_;  ///< ids are of type Whole
  QButtonGroup* phases_;
  QToolButton* whole_;
  QToolButton* labels_;
  QToolButton* zoom_;
  EngineMenu* engine_menu_;
  QTimer* recolor_timer_;
};

}  // namespace transillum::viewer
