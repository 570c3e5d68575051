// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Implementation of the map widget: requests pictures from the painter thread, draws selection,
// scale bar, axes and legend over them, and handles the mouse.
#include "map/map_canvas.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "map/engine_drawing.h"
#include "model/snapshot_values.h"
#include "state/callout.h"
#include "transillum/at.h"
#include "widgets/callout_painter.h"
#include "widgets/sketch_painter.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double min_zoom = 0.5, max_zoom = 500;
constexpr std::chrono::milliseconds max_wait{20};

QPolygonF in_pixels(std::span<const Vec2> corners, const MapTransform& shown) {
  QPolygonF polygon;
  for (const Vec2& p : corners) {
    polygon.append(shown.to_pixels(p));
  }
  return polygon;
}

std::vector<QPolygonF> in_pixels(const std::vector<std::vector<Vec2>>& parts,
                                 const MapTransform& shown) {
  std::vector<QPolygonF> polygons;
  for (const std::vector<Vec2>& part : parts) {
    polygons.push_back(in_pixels(std::span(part), shown));
  }
  return polygons;
}

}  // namespace

MapCanvas::MapCanvas(Selection& selection, QWidget* parent)
    : QWidget(parent),
      selection_(selection),
      painter_(
          [this](const Task& task, const Cancellation& cancellation) {
            auto picture =
                std::make_shared<const MapPicture>(paint_map(task.picture, cancellation));
            {
              const std::lock_guard lock(newest_.mutex);
              newest_.picture = std::move(picture);
              newest_.number = task.number;
            }
            newest_.changed.notify_one();
            QMetaObject::invokeMethod(this, &MapCanvas::show_newest, Qt::QueuedConnection);
          },
          [this](const Task& task, const QString& message) {
            const auto show = [this, message, number = task.number] {
              show_failure(message, number);
            };
            QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
          }) {
  setMinimumSize(120, 80);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  connect(&selection_, &Selection::patches_changed, this, qOverload<>(&QWidget::update));
}

void MapCanvas::show_map(Content content) {
  content_ = std::move(content);
  repaint_map();
  // A queued call runs after all other views have the new step, before the window is next painted.
  if (content_.step_shown) {
    QMetaObject::invokeMethod(this, &MapCanvas::wait_for_picture, Qt::QueuedConnection);
  }
}

void MapCanvas::clear() {
  content_ = {};
  region_ = {};
  picture_ = nullptr;
  failure_.clear();
  painter_.clear();
  painted_ = ++sent_.number;  // drops pictures that are still being painted
  zoom_ = 1;
  pan_ = {};
  update();
}

void MapCanvas::mark_region(const std::optional<MapRegion>& region) {
  if (!region && !region_) {
    return;
  }
  region_ = region;
  update();
}

void MapCanvas::show_sketch(const MapSketch& sketch) {
  sketch_ = sketch;
  update();
}

void MapCanvas::show_callouts(const std::vector<Callout>& callouts) {
  callouts_ = callouts;
  update();
}

void MapCanvas::fit() {
  set_view({});
  emit view_changed();
}

MapCanvas::View MapCanvas::view() const {
  if (!content_.map) {
    return {};
  }
  return {zoom_, pan_ / fit_map(*content_.map, size()).scale};
}

void MapCanvas::set_view(const View& view) {
  zoom_ = view.zoom;
  pan_ = content_.map ? view.shift * fit_map(*content_.map, size()).scale : QPointF();
  repaint_map();
}

void MapCanvas::fit_step() {
  if (!content_.map) {
    return;
  }
  const QRectF bounds = step_bounds(*content_.map, content_.step);
  if (bounds.isNull()) {
    return;
  }
  const MapTransform fitted = fit_map(*content_.map, size());
  const double room = 0.6 * std::min(width(), height());
  const double extent = std::max({bounds.width(), bounds.height(), 1e-12});
  zoom_ = std::clamp(room / extent / fitted.scale, min_zoom, max_zoom);
  MapTransform near = fitted;
  near.scale *= zoom_;
  const QPointF middle = near.to_pixels({bounds.center().x(), bounds.center().y()});
  pan_ = fitted.middle - middle;
  repaint_map();
  emit view_changed();
}

MapTransform MapCanvas::transform(const QSizeF& size) const {
  MapTransform result = fit_map(*content_.map, size);
  // A picture of another size shows the same part.
  const QPointF shift = view().shift * result.scale;
  result.scale *= zoom_;
  result.middle += shift;
  return result;
}

MapPictureRequest MapCanvas::request_for(const QSizeF& size, double pixel_ratio) const {
  return {content_.map,    content_.step,
          content_.phase,  content_.step_shown,
          content_.labels, content_.choice,
          pixels(),        content_.patch_colors,
          transform(size), size,
          pixel_ratio,     content_.receiver,
          content_.extent};
}

void MapCanvas::repaint_map() {
  update();
  if (!content_.map) {
    return;
  }
  // While the view moves or new directions arrive, pictures being painted are finished: an
  // occasional old picture is better than none. A change by the user cancels them.
  const bool cancels = content_.choice != sent_.picture.choice ||
                       (content_.step_shown && content_.map != sent_.picture.map);
  sent_ = {request_for(size(), devicePixelRatioF()), sent_.number + 1};
  painter_.request(sent_, cancels ? CurrentJob::cancel : CurrentJob::finish);
}

void MapCanvas::show_newest() {
  {
    const std::lock_guard lock(newest_.mutex);
    if (!content_.map || newest_.number <= painted_) {
      return;
    }
    painted_ = newest_.number;
    picture_ = newest_.picture;
  }
  failure_.clear();
  update();
  emit painted();
}

void MapCanvas::show_failure(const QString& message, quint64 number) {
  if (!content_.map || number <= painted_) {
    return;
  }
  painted_ = number;
  failure_ = message;
  update();
  emit painted();
}

/// Waits so that the step's map is painted together with everything else that the step changes:
/// without a GPU, painting the window twice takes longer than painting a map.
void MapCanvas::wait_for_picture() {
  if (up_to_date()) {
    return;
  }
  {
    std::unique_lock lock(newest_.mutex);
    newest_.changed.wait_for(lock, max_wait, [this] { return newest_.number >= sent_.number; });
  }
  show_newest();
}

PatchId MapCanvas::patch_at(const QPointF& position) const {
  if (!picture_) {
    return no_patch;
  }
  const MapRecord& record = picture_->request.map->record();
  const std::int32_t row =
      viewer::row_at(record, picture_->rows, picture_->request.transform.to_meters(position));
  return row == MapRecord::no_row ? no_patch : at(record.rows, row).patch;
}

std::optional<Vec3> MapCanvas::patch_point_at(const QPointF& position) const {
  const PatchId patch = patch_at(position);
  if (patch == no_patch) {
    return std::nullopt;
  }
  const RecordedMap& map = *picture_->request.map;
  return map.record().frame.point_on(map.loaded->scene->patch(patch),
                                     picture_->request.transform.to_meters(position));
}

std::int32_t MapCanvas::row_at(const QPointF& position) const {
  if (!picture_ || picture_->pixels) {
    return MapRecord::no_row;
  }
  return viewer::row_at(picture_->request.map->record(), picture_->rows,
                        picture_->request.transform.to_meters(position));
}

QRect MapCanvas::box_of_row(std::int32_t row) const {
  if (!picture_ || row == MapRecord::no_row) {
    return {};
  }
  const MapPictureRequest& shown = picture_->request;
  return row_polygon(shown.map->record(), shown.map->row(row), shown.transform)
      .boundingRect()
      .toAlignedRect();
}

void MapCanvas::mark_row(std::int32_t row) {
  marked_map_ = picture_ ? picture_->request.map : nullptr;
  marked_row_ = row;
  update();
}

std::optional<Vec2> MapCanvas::point_at(const QPointF& position) const {
  if (!picture_) {
    return std::nullopt;
  }
  return picture_->request.transform.to_meters(position);
}

void MapCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  if (!failure_.isEmpty() && content_.map && !picture_) {
    draw_failure(painter, failure_);
    return;
  }
  if (!picture_ || !content_.map) {
    draw_note(painter, tr("The visibility map appears after the first direction"));
    return;
  }
  // The picture may be of an older view: move and scale it to the current one.
  const MapTransform& painted = picture_->request.transform;
  const MapTransform now = picture_->request.map == content_.map ? transform(size()) : painted;
  const double fraction = now.scale / painted.scale;
  painter.setRenderHint(QPainter::SmoothPixmapTransform, fraction != 1);
  const QPointF corner = now.middle - fraction * painted.middle;
  painter.setClipRect(map_rect(size()));
  painter.drawImage(QRectF(corner, fraction * picture_->request.size), picture_->image);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!failure_.isEmpty()) {
    draw_failure(painter, failure_);
    return;
  }
  if (pixels() && !pixels()->failure.empty()) {
    draw_failure(painter, QString::fromStdString(pixels()->failure));
    return;
  }
  draw_marks({painter, size()}, *picture_, now);
  const MapPictureRequest& shown = picture_->request;
  if (shown.step == 0 && !shown.step_shown && shown.extent == MapExtent::step &&
      shown.receiver == no_patch) {
    draw_note(painter, tr("V is empty before the first step"));
  }
}

void MapCanvas::draw_note(QPainter& painter, const QString& text) const {
  painter.setPen(theme::on_dark_dim);
  painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap, text);
}

void MapCanvas::draw_marks(const MapSheet& sheet, const MapPicture& picture,
                           const MapTransform& shown) const {
  draw_selection(sheet.painter, picture, shown);
  draw_region(sheet.painter, shown);
  draw_sketch(sheet.painter, in_pixels(std::span(sketch_.outline), shown),
              in_pixels(sketch_.right, shown));
  draw_probe(sheet.painter, shown);
  draw_marked_row(sheet, picture, shown);
  sheet.draw_caption(content_.caption);
  sheet.painter.setClipping(false);
  sheet.draw_scale_bar(shown.scale);
  sheet.draw_axes();
  sheet.draw_legend(picture.request, back_side_brush(1));
  draw_callouts(sheet, picture, shown);
}

QImage MapCanvas::picture(const QSize& pixels) const {
  QImage image(pixels, QImage::Format_RGB32);
  image.fill(theme::scene_background);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(font());
  if (content_.map) {
    const MapPicture drawn = paint_map(request_for(pixels, 1));
    painter.drawImage(0, 0, drawn.image);
    draw_marks({painter, pixels}, drawn, drawn.request.transform);
  }
  return image;
}

void MapCanvas::draw(QPainter& painter, const QSizeF& size, const QColor& ink,
                     bool explained) const {
  if (!content_.map) {
    return;
  }
  const MapPictureRequest request = request_for(size, 1);
  paint_map(request, painter);
  if (explained) {
    const MapSheet sheet{painter, size, ink, ink, Qt::transparent};
    sheet.draw_caption(content_.caption);
    sheet.draw_scale_bar(request.transform.scale);
    sheet.draw_axes();
    sheet.draw_legend(request, plain_back_side);
  }
}

void MapCanvas::draw_failure(QPainter& painter, const QString& failure) const {
  painter.setPen(theme::on_dark);
  painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
                   tr("The engine failed, so nothing is drawn:\n\n%1").arg(failure));
}

QPainterPath MapCanvas::selection_path(const MapPicture& picture, const MapTransform& shown) const {
  const MapRecord& record = picture.request.map->record();
  const bool covers = picture.request.extent != MapExtent::step;
  QPainterPath all;
  std::vector<QPolygonF> nearer;
  for (const std::int32_t number : picture.rows) {
    const MapRecord::Row& row = at(record.rows, number);
    const bool selected = selection_.contains(row.patch);
    if (!selected && !covers) {
      continue;
    }
    const QPolygonF polygon = row_polygon(record, row, shown);
    if (!selected) {
      nearer.push_back(polygon);
      continue;
    }
    QPainterPath seen;
    seen.addPolygon(polygon);
    seen.closeSubpath();
    for (const QPolygonF& other : nearer) {
      if (other.boundingRect().intersects(seen.boundingRect())) {
        QPainterPath cover;
        cover.addPolygon(other);
        seen -= cover;
      }
    }
    all.addPath(seen);
  }
  return all;
}

void MapCanvas::draw_selection(QPainter& painter, const MapPicture& picture,
                               const MapTransform& shown) const {
  if (selection_.patches().empty()) {
    return;
  }
  const QPainterPath edges = selection_path(picture, shown);
  for (const QPen& pen :
       {QPen(Qt::black, 4 * theme::scale()), QPen(theme::selection, 2 * theme::scale())}) {
    painter.strokePath(edges, pen);
  }
}

void MapCanvas::draw_region(QPainter& painter, const MapTransform& shown) const {
  if (region_) {
    fill_parts(painter, in_pixels(region_->parts, shown), 230);
  }
}

void MapCanvas::draw_callouts(const MapSheet& sheet, const MapPicture& picture,
                              const MapTransform& shown) const {
  const QRectF bounds(QPointF(0, 0), sheet.size);
  for (const Callout& callout : callouts_) {
    mark_callout(sheet, picture, shown, callout);
  }
  std::vector<QRectF> taken;
  for (const Callout& callout : callouts_) {
    const auto place = place_of(callout, picture, shown);
    if (place && bounds.contains(*place)) {
      draw_callout(sheet.painter, *place, QString::fromStdString(callout.text),
                   map_rect(sheet.size).adjusted(2, 2, -2, -2), taken);
    }
  }
}

// A region that is the whole V has a frame; an inside list is filled.
void MapCanvas::mark_callout(const MapSheet& sheet, const MapPicture& picture,
                             const MapTransform& shown, const Callout& callout) const {
  QPainter& painter = sheet.painter;
  if (callout.anchor == Callout::Anchor::map) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(theme::region, 4 * theme::scale()));
    painter.drawRect(QRectF(QPointF(0, 0), sheet.size).adjusted(2, 2, -3, -3));
  }
  if (callout.anchor != Callout::Anchor::inside || content_.step < 0) {
    return;
  }
  const RecordedMap& map = *picture.request.map;
  std::vector<QPolygonF> parts;
  for (const std::int32_t r : map.history.inside_at(content_.step)) {
    parts.push_back(in_pixels(map.record().outline(map.row(r)), shown));
  }
  fill_parts(painter, parts, 170);
}

std::optional<QPointF> MapCanvas::place_of(const Callout& callout, const MapPicture& picture,
                                           const MapTransform& shown) const {
  const QSizeF& size = picture.request.size;
  if (callout.anchor == Callout::Anchor::direction) {
    return axes_origin(size);
  }
  if (callout.anchor == Callout::Anchor::map) {
    return QPointF(8, size.height() / 2);
  }
  const auto place = place_in_map(callout, *picture.request.map, picture.rows, content_.step);
  return place ? std::optional(shown.to_pixels(*place)) : std::nullopt;
}

void MapCanvas::draw_probe(QPainter& painter, const MapTransform& shown) const {
  if (!content_.probe) {
    return;
  }
  const QPointF at = shown.to_pixels(*content_.probe);
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen : {QPen(Qt::black, 3.5), QPen(theme::on_dark, 1.5)}) {
    painter.setPen(pen);
    painter.drawEllipse(at, 5, 5);
    for (const QPointF& axis : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
      painter.drawLine(at + 5 * axis, at + 10 * axis);
    }
  }
}

void MapCanvas::draw_marked_row(const MapSheet& sheet, const MapPicture& picture,
                                const MapTransform& shown) const {
  if (marked_row_ == MapRecord::no_row || marked_map_ != picture.request.map) {
    return;
  }
  QPainter& painter = sheet.painter;
  const QPolygonF outline =
      row_polygon(marked_map_->record(), marked_map_->row(marked_row_), shown);
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen :
       {QPen(Qt::black, 4 * theme::scale()), QPen(theme::on_dark, 2 * theme::scale())}) {
    painter.setPen(pen);
    painter.drawPolygon(outline);
  }
  for (int k = 0; k < outline.size(); ++k) {
    sheet.draw_text(outline[k] + QPointF(4, -4), QString::number(k + 1));
  }
}

QRectF MapCanvas::map_rect(const QSizeF& size) {
  return {0, 0, size.width(), size.height() - scale_bar_room(size.height())};
}

void MapCanvas::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  repaint_map();
}

void MapCanvas::wheelEvent(QWheelEvent* event) {
  if (!content_.map) {
    return;
  }
  const double factor = std::pow(1.0015, event->angleDelta().y());
  const double zoom = std::clamp(zoom_ * factor, min_zoom, max_zoom);
  // The point under the pointer stays where it is.
  const QPointF fitted_middle = fit_map(*content_.map, size()).middle;
  const QPointF from_center = event->position() - fitted_middle - pan_;
  pan_ += from_center * (1 - zoom / zoom_);
  zoom_ = zoom;
  repaint_map();
  emit view_changed();
  event->accept();
}

void MapCanvas::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) {
    return;
  }
  press_position_ = last_position_ = event->pos();
  dragging_ = false;
}

void MapCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton) || !content_.map) {
    return;
  }
  const QPointF position = event->pos();
  const double moved = (position - press_position_).manhattanLength();
  if (!dragging_ && moved < QApplication::startDragDistance()) {
    return;
  }
  dragging_ = true;
  setCursor(Qt::ClosedHandCursor);
  pan_ += position - last_position_;
  last_position_ = position;
  repaint_map();
  emit view_changed();
}

void MapCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) {
    return;
  }
  unsetCursor();
  if (!dragging_) {
    const PatchId patch = patch_at(event->pos());
    const PatchId clicked_patch = patch < content_.patches ? patch : no_patch;
    if (event->modifiers() & Qt::ControlModifier) {
      selection_.toggle(clicked_patch);
    } else {
      selection_.select(clicked_patch);
    }
    emit clicked(event->pos());
  }
  dragging_ = false;
}

void MapCanvas::mouseDoubleClickEvent(QMouseEvent*) {
  dragging_ = true;  // so that the release that follows selects nothing
  fit();
}

}  // namespace transillum::viewer
