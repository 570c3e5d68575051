// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "map/map_painter.h"
#include "state/selection.h"
#include "support/request_worker.h"
#include "transillum/map_region.h"

namespace transillum::viewer {

/// The picture of a visibility map: drag moves it, the wheel enlarges it, a click selects a patch,
/// a double click shows all of it.
///
/// A thread of its own paints; until the new picture is there the old one is moved and scaled.
class MapCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit MapCanvas(Selection& selection, QWidget* parent = nullptr);

  /// What of a map is to be drawn; the canvas knows where.
  struct Content {
    std::shared_ptr<const RecordedMap> map;
    std::int32_t step = 0;
    Phase phase = Phase::after;
    bool step_shown = false;
    bool labels = false;
    PixelChoice pixels;
    std::optional<Vec2> probe;
    std::shared_ptr<const std::vector<Color8>> patch_colors;
  };
  void show_map(Content content);
  void clear();
  /// Marks a region of the map that is shown; nothing takes the mark away.
  void mark_region(const std::optional<MapRegion>& region);
  void fit();
  /// How the map is moved and enlarged, whatever the canvas' size; canvases can share it.
  struct View {
    double zoom = 1;  ///< times the scale at which all of it fits
    QPointF shift;    ///< of the middle, meters on the plane times `zoom`

    friend bool operator==(const View&, const View&) = default;
  };
  View view() const;
  /// Without view_changed().
  void set_view(const View& view);
  /// Brings the step's polygon and what it cuts near.
  void fit_step();
  /// Whether the picture on the screen is the one that was asked for.
  bool up_to_date() const { return painted_ == asked_.number; }
  /// The patch drawn at a point, in logical pixels; no_patch for none.
  PatchId patch_at(const QPointF& position) const;
  /// Meters on the plane of a point in logical pixels; nothing without a picture.
  std::optional<Vec2> point_at(const QPointF& position) const;
  /// What is drawn in pixels; null where V is drawn exactly.
  std::shared_ptr<const PixelView> pixels() const { return picture_ ? picture_->pixels : nullptr; }
  std::size_t fragment_count() const { return picture_ ? picture_->rows.size() : 0; }

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
  MapTransform transform() const;
  void repaint_map();
  void take_arrived();
  void wait_for_picture();
  void show_failure(const QString& message, quint64 number);
  void draw_failure(QPainter& painter, const QString& failure) const;
  void draw_selection(QPainter& painter, const MapTransform& shown) const;
  void draw_region(QPainter& painter, const MapTransform& shown) const;
  void draw_probe(QPainter& painter, const MapTransform& shown) const;
  void draw_scale_bar(QPainter& painter, double scale) const;
  void draw_axes(QPainter& painter) const;
  void draw_legend(QPainter& painter) const;

  Selection& selection_;
  Content content_;
  std::optional<MapRegion> region_;
  double zoom_ = 1;  // times the scale that fits
  QPointF pan_;      // pixels
  QPointF press_position_, last_position_;
  bool dragging_ = false;
  int height_hint_ = 380;

  std::shared_ptr<const MapPicture> picture_;
  struct Order {
    MapPictureRequest picture;
    quint64 number = 0;
  };
  Order asked_;          // the newest
  quint64 painted_ = 0;  // number of the order that picture_ or failure_ answers
  QString failure_;      // why there is no picture; else empty
  /// The painter's newest picture.
  struct Arrived {
    std::mutex mutex;
    std::condition_variable changed;
    std::shared_ptr<const MapPicture> picture;
    quint64 number = 0;
  };
  Arrived arrived_;
  RequestWorker<Order> painter_;
};

}  // namespace transillum::viewer
