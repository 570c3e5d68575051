// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The widget that shows a visibility map. Content comes from MapView, CompareView or
// DifferencePicture; paint_map() paints it on a worker thread.
#pragma once

#include <QPainterPath>
#include <QWidget>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "map/map_painter.h"
#include "map/map_sheet.h"
#include "state/callout.h"
#include "state/map_sketch.h"
#include "state/selection.h"
#include "support/request_worker.h"
#include "visibility/map/map_region.h"

namespace transillum::viewer {

/// The picture of a visibility map: drag moves it, the wheel zooms, a click selects a patch, a
/// double-click shows the whole map.
///
/// A worker thread paints; until the new picture arrives, the old one is moved and scaled.
class MapCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit MapCanvas(Selection& selection, QWidget* parent = nullptr);

  /// The content to draw; zoom and shift belong to the canvas.
  struct Content {
    std::shared_ptr<const RecordedMap> map;
    std::int32_t step = 0;
    Phase phase = Phase::after;
    bool step_shown = false;  ///< mark the changes of the step
    bool labels = false;      ///< patch numbers on polygons
    MapEngineChoice choice;
    std::optional<Vec2> probe;  ///< marked by crosshairs, meters on the plane
    std::shared_ptr<const std::vector<Color8>> patch_colors;
    QString caption = {};         ///< at the top
    PatchId receiver = no_patch;  ///< draw what this patch sees along the direction, instead of V
    MapExtent extent = MapExtent::step;
    PatchId patches = std::numeric_limits<PatchId>::max();  ///< only patches below are selected
  };
  void show_map(Content content);
  void clear();
  /// Highlights a region of the map shown; nullopt removes the highlight.
  void mark_region(const std::optional<MapRegion>& region);
  /// Draws a polygon, and the region that it should match, over the map until the next call.
  void show_sketch(const MapSketch& sketch);
  /// Shows these callouts until the next call.
  void show_callouts(const std::vector<Callout>& callouts);
  const std::vector<Callout>& callouts() const { return callouts_; }
  /// Shows the whole map.
  void fit();
  /// Zoom and shift, independent of the size of the canvas, so that canvases can share them.
  struct View {
    double zoom = 1;  ///< relative to the scale at which the whole map fits
    QPointF shift;    ///< shift of the center, meters on the plane times `zoom`

    friend bool operator==(const View&, const View&) = default;
  };
  View view() const;
  /// Does not emit view_changed().
  void set_view(const View& view);
  /// Zooms to the step's fragment and the polygons of V that it cuts.
  void fit_step();
  /// Whether the picture shown is the one requested last.
  bool up_to_date() const { return painted_ == sent_.number; }
  /// The patch drawn at a point in logical pixels; no_patch if none.
  PatchId patch_at(const QPointF& position) const;
  /// The point of that patch, m; not set without a patch.
  std::optional<Vec3> patch_point_at(const QPointF& position) const;
  /// The row of the record whose polygon is drawn at a point; MapRecord::no_row if none, or if V
  /// is not drawn exactly.
  std::int32_t row_at(const QPointF& position) const;
  /// The box around that row's polygon, logical pixels; empty for MapRecord::no_row.
  QRect box_of_row(std::int32_t row) const;
  /// Outlines the polygon of a row of the map shown, and numbers its corners; MapRecord::no_row
  /// outlines nothing.
  void mark_row(std::int32_t row);
  /// The point on the plane, meters, at a point in logical pixels; nullopt without a picture.
  std::optional<Vec2> point_at(const QPointF& position) const;
  /// The other engine's map that is drawn; null if V is drawn exactly.
  std::shared_ptr<const PixelView> pixels() const { return picture_ ? picture_->pixels : nullptr; }
  /// The map drawn; null without a picture.
  std::shared_ptr<const RecordedMap> map_shown() const {
    return picture_ ? picture_->request.map : nullptr;
  }
  /// The map as it is shown now, in another size: what is to be painted, and all marks.
  QImage picture(const QSize& pixels) const;
  /// Draws the map as it is shown now, without marks, as vector graphics.
  /// @param explained  with scale bar, axes and legend
  void draw(QPainter& painter, const QSizeF& size, const QColor& ink, bool explained) const;
  /// Number of polygons drawn.
  std::size_t polygon_count() const { return picture_ ? picture_->rows.size() : 0; }

  QSize sizeHint() const override { return {420, height_hint_}; }
  void set_height_hint(int pixels) { height_hint_ = pixels; }

 signals:
  void painted();
  void clicked(const QPointF& position);
  void view_changed();  ///< by the user

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  MapTransform transform(const QSizeF& size) const;
  MapPictureRequest request_for(const QSizeF& size, double pixel_ratio) const;
  void repaint_map();
  void show_newest();
  void wait_for_picture();
  void show_failure(const QString& message, quint64 number);
  void draw_failure(QPainter& painter, const QString& failure) const;
  void draw_note(QPainter& painter, const QString& text) const;
  /// Draws what is over the picture of a map.
  void draw_marks(const MapSheet& sheet, const MapPicture& picture,
                  const MapTransform& shown) const;
  void draw_selection(QPainter& painter, const MapPicture& picture,
                      const MapTransform& shown) const;
  /// The edges of the selected fragments, without what nearer ones cover.
  QPainterPath selection_path(const MapPicture& picture, const MapTransform& shown) const;
  void draw_region(QPainter& painter, const MapTransform& shown) const;
  void draw_callouts(const MapSheet& sheet, const MapPicture& picture,
                     const MapTransform& shown) const;
  void mark_callout(const MapSheet& sheet, const MapPicture& picture, const MapTransform& shown,
                    const Callout& callout) const;
  std::optional<QPointF> place_of(const Callout& callout, const MapPicture& picture,
                                  const MapTransform& shown) const;
  void draw_probe(QPainter& painter, const MapTransform& shown) const;
  void draw_marked_row(const MapSheet& sheet, const MapPicture& picture,
                       const MapTransform& shown) const;
  /// The part above the strip with scale bar, legend and axes. A low canvas has no strip.
  static QRectF map_rect(const QSizeF& size);

  Selection& selection_;
  Content content_;
  std::optional<MapRegion> region_;
  std::shared_ptr<const RecordedMap> marked_map_;  ///< the map of marked_row_
  std::int32_t marked_row_ = MapRecord::no_row;
  MapSketch sketch_;
  std::vector<Callout> callouts_;
  double zoom_ = 1;  // relative to the scale that fits
  QPointF pan_;      // pixels
  QPointF press_position_, last_position_;
  bool dragging_ = false;
  int height_hint_ = 380;

  std::shared_ptr<const MapPicture> picture_;
  struct Task {
    MapPictureRequest picture;
    quint64 number = 0;
  };
  Task sent_;            // the newest
  quint64 painted_ = 0;  // number of the task whose result is picture_ or failure_
  QString failure_;      // why there is no picture; empty on success
  /// The painter's newest picture.
  struct Result {
    std::mutex mutex;
    std::condition_variable changed;
    std::shared_ptr<const MapPicture> picture;
    quint64 number = 0;
  };
  Result newest_;
  RequestWorker<Task> painter_;
};

}  // namespace transillum::viewer
