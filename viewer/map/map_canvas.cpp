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
#include <utility>

#include "map/engine_drawing.h"
#include "map/sketch_painter.h"
#include "model/snapshot_values.h"
#include "state/callout.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/callout_painter.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double min_zoom = 0.5, max_zoom = 500;
constexpr std::chrono::milliseconds max_wait{20};

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
  setMinimumSize(200, 80);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setToolTip(tr("Drag to move, wheel to zoom, double-click to show all, click to select a patch"));
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

MapTransform MapCanvas::transform() const {
  MapTransform result = fit_map(*content_.map, size());
  result.scale *= zoom_;
  result.middle += pan_;
  return result;
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
  sent_ = {{content_.map, content_.step, content_.phase, content_.step_shown, content_.labels,
            content_.choice, pixels(), content_.patch_colors, transform(), size(),
            devicePixelRatioF(), content_.receiver},
           sent_.number + 1};
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
  return point_of_patch(map.record().frame, picture_->request.transform.to_meters(position),
                        map.loaded->scene->patch(patch));
}

std::int32_t MapCanvas::row_at(const QPointF& position) const {
  if (!picture_ || picture_->pixels) {
    return MapRecord::no_row;
  }
  return viewer::row_at(picture_->request.map->record(), picture_->rows,
                        picture_->request.transform.to_meters(position));
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
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The visibility map appears after the first direction"));
    return;
  }
  // The picture may be of an older view: move and scale it to the current one.
  const MapTransform& painted = picture_->request.transform;
  const MapTransform now = picture_->request.map == content_.map ? transform() : painted;
  const double fraction = now.scale / painted.scale;
  painter.setRenderHint(QPainter::SmoothPixmapTransform, fraction != 1);
  const QPointF corner = now.middle - fraction * painted.middle;
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
  draw_selection(painter, now);
  draw_region(painter, now);
  draw_sketch(painter, sketch_, now);
  draw_callouts(painter, now);
  draw_probe(painter, now);
  draw_marked_row(painter, now);
  draw_caption(painter);
  draw_scale_bar(painter, now.scale);
  draw_axes(painter);
  draw_legend(painter);
}

void MapCanvas::draw_failure(QPainter& painter, const QString& failure) const {
  painter.setPen(theme::on_dark);
  painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
                   tr("The engine failed, so nothing is drawn:\n\n%1").arg(failure));
}

void MapCanvas::draw_selection(QPainter& painter, const MapTransform& shown) const {
  if (selection_.patches().empty()) {
    return;
  }
  const MapRecord& record = picture_->request.map->record();
  std::vector<QPolygonF> fragments;
  for (const std::int32_t number : picture_->rows) {
    const MapRecord::Row& row = at(record.rows, number);
    if (selection_.contains(row.patch)) {
      fragments.push_back(row_polygon(record, row, shown));
    }
  }
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen :
       {QPen(Qt::black, 4 * theme::scale()), QPen(theme::selection, 2 * theme::scale())}) {
    painter.setPen(pen);
    for (const QPolygonF& fragment : fragments) {
      painter.drawPolygon(fragment);
    }
  }
}

void MapCanvas::draw_region(QPainter& painter, const MapTransform& shown) const {
  if (region_) {
    fill_parts(painter, region_->parts, shown, 230);
  }
}

void MapCanvas::draw_callouts(QPainter& painter, const MapTransform& shown) const {
  for (const Callout& callout : callouts_) {
    mark_callout(painter, shown, callout);
  }
  std::vector<QRectF> taken;
  for (const Callout& callout : callouts_) {
    if (const auto place = place_of(callout, shown); place && rect().contains(place->toPoint())) {
      draw_callout(painter, *place, QString::fromStdString(callout.text),
                   rect().adjusted(2, 2, -2, -2), taken);
    }
  }
}

// A region that is the whole V has a frame; an inside list is filled.
void MapCanvas::mark_callout(QPainter& painter, const MapTransform& shown,
                             const Callout& callout) const {
  if (callout.anchor == Callout::Anchor::map) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(theme::region, 4 * theme::scale()));
    painter.drawRect(rect().adjusted(2, 2, -3, -3));
  }
  if (callout.anchor != Callout::Anchor::inside || content_.step < 0) {
    return;
  }
  const RecordedMap& map = *picture_->request.map;
  std::vector<std::vector<Vec2>> parts;
  for (const std::int32_t r : map.history.inside_at(content_.step)) {
    const auto outline = map.record().outline(map.row(r));
    parts.emplace_back(outline.begin(), outline.end());
  }
  fill_parts(painter, parts, shown, 170);
}

std::optional<QPointF> MapCanvas::place_of(const Callout& callout,
                                           const MapTransform& shown) const {
  if (callout.anchor == Callout::Anchor::direction) {
    return QPointF(width() / 2.0, 26 * theme::scale());
  }
  if (callout.anchor == Callout::Anchor::map) {
    return QPointF(8, height() / 2.0);
  }
  const auto place = place_in_map(callout, *picture_->request.map, picture_->rows, content_.step);
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

namespace {

// The text has a plate behind it: in a low picture it covers the map.
void draw_text(QPainter& painter, const QPointF& baseline, const QString& text) {
  QColor plate = theme::scene_background;
  plate.setAlphaF(0.7);
  const QRectF box = painter.fontMetrics().boundingRect(text).adjusted(-3, -1, 3, 1);
  painter.fillRect(box.translated(baseline), plate);
  painter.drawText(baseline, text);
}

}  // namespace

void MapCanvas::draw_marked_row(QPainter& painter, const MapTransform& shown) const {
  if (marked_row_ == MapRecord::no_row || marked_map_ != picture_->request.map) {
    return;
  }
  const QPolygonF outline =
      row_polygon(marked_map_->record(), marked_map_->row(marked_row_), shown);
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen :
       {QPen(Qt::black, 4 * theme::scale()), QPen(theme::on_dark, 2 * theme::scale())}) {
    painter.setPen(pen);
    painter.drawPolygon(outline);
  }
  for (int k = 0; k < outline.size(); ++k) {
    draw_text(painter, outline[k] + QPointF(4, -4), QString::number(k + 1));
  }
}

void MapCanvas::draw_caption(QPainter& painter) const {
  if (content_.caption.isEmpty()) {
    return;
  }
  painter.setPen(theme::on_dark);
  draw_text(painter, QPointF(12, 8 + painter.fontMetrics().ascent()), content_.caption);
}

void MapCanvas::draw_scale_bar(QPainter& painter, double scale) const {
  // The largest length of 1, 2 or 5 times a power of ten within a quarter of the width.
  const double max_meters = width() / 4.0 / scale;
  const double power = std::pow(10.0, std::floor(std::log10(max_meters)));
  const double lead = max_meters / power;
  const double meters = power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
  const double length = meters * scale;
  const QPointF left(14, height() - 14);
  painter.setPen(QPen(theme::on_dark, 1.5));
  painter.drawLine(left, left + QPointF(length, 0));
  painter.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
  painter.drawLine(left + QPointF(length, -4), left + QPointF(length, 4));
  draw_text(painter, left + QPointF(length + 8, 4), number_text(meters) + tr(" m"));
}

void MapCanvas::draw_axes(QPainter& painter) const {
  const QPointF origin(width() - 18, height() - 16);
  constexpr double length = 22;
  painter.setPen(QPen(theme::on_dark, 1.5));
  const auto arrow = [&](const QPointF& axis, const QString& name, const QPointF& name_offset) {
    const QPointF tip = origin + length * axis;
    const QPointF across(-axis.y(), axis.x());
    painter.drawLine(origin, tip);
    painter.drawLine(tip, tip - 6 * axis + 3.5 * across);
    painter.drawLine(tip, tip - 6 * axis - 3.5 * across);
    painter.drawText(tip + name_offset, name);
  };
  arrow({-1, 0}, QStringLiteral("u"), {-13, 4});
  arrow({0, -1}, QStringLiteral("v"), {-4, -6});
}

void MapCanvas::draw_legend(QPainter& painter) const {
  if (width() < 330) {
    return;  // no room between scale bar and axes
  }
  std::vector<std::pair<QBrush, QString>> entries{{back_side_brush(1), tr("back side")}};
  const MapEngineChoice& choice = picture_->request.choice;
  if (choice.shows(EngineTraits::Picture::corrected) && choice.differences) {
    entries.emplace_back(theme::inside, tr("too much"));
    entries.emplace_back(theme::outside, tr("too little"));
  } else if (choice.engine && choice.differences) {
    entries.emplace_back(theme::difference, tr("differs"));
  }
  constexpr double box_width = 16, gap = 8, axes = 64;
  const auto width_of = [&](const QString& text) {
    return box_width + 2 * gap + painter.fontMetrics().horizontalAdvance(text);
  };
  double total = 0;
  for (const auto& [brush, text] : entries) {
    total += width_of(text);
  }
  // The legend is between the scale bar with its text and the axes; without room, back sides are
  // omitted.
  const double left = width() / 4.0 + 80, right = width() - axes;
  if (entries.size() > 1 && left + total > right) {
    total -= width_of(entries.front().second);
    entries.erase(entries.begin());
  }
  // In a low map that leaves its sides free, the entries are one above the other at the left.
  constexpr int low = 140, row = 20, side = 130;
  const auto scale_in = [this](int room) {
    return fit_map(*content_.map, QSizeF(room, height())).scale;
  };
  const bool stacked = height() < low && scale_in(width() - 2 * side) == scale_in(width());
  double x = stacked ? 12 : std::min(std::max(width() / 2.0 - 8, left), right - total);
  int y = height() - 23 - (stacked ? row : 0);
  for (const auto& [brush, text] : entries) {
    const QRectF box(x, y, box_width, 12);
    painter.setPen(QPen(theme::on_dark_dim, 1));
    painter.setBrush(brush);
    painter.drawRect(box);
    painter.setPen(theme::on_dark);
    draw_text(painter, box.bottomRight() + QPointF(gap, -1), text);
    x += stacked ? 0 : width_of(text);
    y -= stacked ? row : 0;
  }
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
    if (event->modifiers() & Qt::ControlModifier) {
      selection_.toggle(patch_at(event->pos()));
    } else {
      selection_.select(patch_at(event->pos()));
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
