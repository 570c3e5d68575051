// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map_canvas.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "number_text.h"
#include "theme.h"
#include "thread_priority.h"

namespace transillum::viewer {

namespace {

constexpr double smallest_zoom = 0.5, largest_zoom = 500;

}  // namespace

MapCanvas::MapCanvas(Selection& selection, QWidget* parent)
    : QWidget(parent), selection_(selection) {
  setMinimumSize(200, 90);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setToolTip(tr("Drag to move, wheel to enlarge, double click to see all, click to select"));
  painter_pool_.setMaxThreadCount(1);
  connect(&selection_, &Selection::changed, this, qOverload<>(&QWidget::update));
}

MapCanvas::~MapCanvas() { painter_pool_.waitForDone(); }

void MapCanvas::show_map(Content content) {
  content_ = std::move(content);
  repaint_map();
}

void MapCanvas::clear() {
  content_ = {};
  picture_ = nullptr;
  stale_ = false;
  zoom_ = 1;
  pan_ = {};
  update();
}

void MapCanvas::fit() {
  zoom_ = 1;
  pan_ = {};
  repaint_map();
}

void MapCanvas::fit_step() {
  if (!content_.map) return;
  const QRectF bounds = step_bounds(*content_.map, content_.step);
  if (bounds.isNull()) return;
  const MapTransform fitted = fit_map(*content_.map, size());
  const double room = 0.6 * std::min(width(), height());
  const double extent = std::max({bounds.width(), bounds.height(), 1e-12});
  zoom_ = std::clamp(room / extent / fitted.scale, smallest_zoom, largest_zoom);
  MapTransform near = fitted;
  near.scale *= zoom_;
  const QPointF middle = near.to_pixels({bounds.center().x(), bounds.center().y()});
  pan_ = fitted.middle - middle;
  repaint_map();
}

MapTransform MapCanvas::transform() const {
  MapTransform result = fit_map(*content_.map, size());
  result.scale *= zoom_;
  result.middle += pan_;
  return result;
}

void MapCanvas::repaint_map() {
  update();
  if (!content_.map) return;
  if (painting_) {
    stale_ = true;  // newest wins: painted when the one under way is done
    return;
  }
  painting_ = true;
  stale_ = false;
  const MapPictureRequest request{
      content_.map,    content_.step,   content_.phase,     content_.step_shown,
      content_.labels, content_.pixels, pixels(),           content_.patch_colors,
      transform(),     size(),          devicePixelRatioF()};
  painter_pool_.start([this, request] {
    give_way_to_the_window();
    auto picture = std::make_shared<const MapPicture>(paint_map(request));
    QMetaObject::invokeMethod(
        this, [this, picture] { take(picture); }, Qt::QueuedConnection);
  });
}

void MapCanvas::take(std::shared_ptr<const MapPicture> picture) {
  painting_ = false;
  if (!content_.map) return;
  picture_ = std::move(picture);
  update();
  if (stale_) repaint_map();
  emit painted();
}

PatchId MapCanvas::patch_at(const QPointF& position) const {
  if (!picture_) return no_patch;
  const MapRecord& record = picture_->request.map->record();
  const std::int32_t row =
      row_at(record, picture_->rows, picture_->request.transform.to_metres(position));
  return row == MapRecord::no_row ? no_patch : record.rows[static_cast<std::size_t>(row)].patch;
}

std::optional<Vec2> MapCanvas::point_at(const QPointF& position) const {
  if (!picture_) return std::nullopt;
  return picture_->request.transform.to_metres(position);
}

void MapCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  if (!picture_ || !content_.map) {
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The visibility map appears with the first direction"));
    return;
  }
  // The picture may be of an older view: put its middle and scale where they are now.
  const MapTransform& painted = picture_->request.transform;
  const MapTransform now = picture_->request.map == content_.map ? transform() : painted;
  const double share = now.scale / painted.scale;
  painter.setRenderHint(QPainter::SmoothPixmapTransform, share != 1);
  const QPointF corner = now.middle - share * painted.middle;
  painter.drawImage(QRectF(corner, share * picture_->request.size), picture_->image);
  painter.setRenderHint(QPainter::Antialiasing);
  draw_selection(painter, now);
  draw_probe(painter, now);
  draw_scale_bar(painter, now.scale);
  draw_axes(painter);
  draw_legend(painter);
}

void MapCanvas::draw_selection(QPainter& painter, const MapTransform& shown) const {
  const PatchId patch = selection_.patch();
  if (patch == no_patch) return;
  const MapRecord& record = picture_->request.map->record();
  std::vector<QPolygonF> fragments;
  for (const std::int32_t number : picture_->rows) {
    const MapRecord::Row& row = record.rows[static_cast<std::size_t>(number)];
    if (row.patch == patch) fragments.push_back(row_polygon(record, row, shown));
  }
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen :
       {QPen(Qt::black, 4 * theme::scale()), QPen(theme::selection, 2 * theme::scale())}) {
    painter.setPen(pen);
    for (const QPolygonF& fragment : fragments) painter.drawPolygon(fragment);
  }
}

void MapCanvas::draw_probe(QPainter& painter, const MapTransform& shown) const {
  if (!content_.probe) return;
  const QPointF at = shown.to_pixels(*content_.probe);
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen : {QPen(Qt::black, 3.5), QPen(theme::on_dark, 1.5)}) {
    painter.setPen(pen);
    painter.drawEllipse(at, 5, 5);
    for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(at + 5 * way, at + 10 * way);
  }
}

void MapCanvas::draw_scale_bar(QPainter& painter, double scale) const {
  // The largest 1, 2 or 5 times a power of ten that takes at most a quarter of the width.
  const double most = width() / 4.0 / scale;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  const double lead = most / power;
  const double metres = power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
  const double length = metres * scale;
  const QPointF left(14, height() - 14);
  painter.setPen(QPen(theme::on_dark, 1.5));
  painter.drawLine(left, left + QPointF(length, 0));
  painter.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
  painter.drawLine(left + QPointF(length, -4), left + QPointF(length, 4));
  painter.drawText(left + QPointF(length + 8, 4), number_text(metres) + tr(" m"));
}

void MapCanvas::draw_axes(QPainter& painter) const {
  const QPointF origin(width() - 18, height() - 16);
  constexpr double length = 22;
  painter.setPen(QPen(theme::on_dark, 1.5));
  const auto arrow = [&](const QPointF& way, const QString& name, const QPointF& name_offset) {
    const QPointF tip = origin + length * way;
    const QPointF across(-way.y(), way.x());
    painter.drawLine(origin, tip);
    painter.drawLine(tip, tip - 6 * way + 3.5 * across);
    painter.drawLine(tip, tip - 6 * way - 3.5 * across);
    painter.drawText(tip + name_offset, name);
  };
  arrow({-1, 0}, QStringLiteral("u"), {-13, 4});
  arrow({0, -1}, QStringLiteral("v"), {-4, -6});
}

void MapCanvas::draw_legend(QPainter& painter) const {
  if (width() < 330) return;  // no room between scale bar and axes
  const bool differences = picture_->pixels && picture_->request.pixels.differences;
  double x = width() / 2.0 - (differences ? 60 : 8);
  const auto entry = [&](const QBrush& brush, const QString& words) {
    const QRectF box(x, height() - 23, 16, 12);
    painter.setPen(QPen(theme::on_dark_dim, 1));
    painter.setBrush(brush);
    painter.drawRect(box);
    painter.setPen(theme::on_dark);
    painter.drawText(box.bottomRight() + QPointF(8, -1), words);
    x = box.right() + 24 + painter.fontMetrics().horizontalAdvance(words);
  };
  entry(back_side_brush(1), tr("back side"));
  if (differences) entry(theme::difference, tr("differs"));
}

void MapCanvas::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  repaint_map();
}

void MapCanvas::wheelEvent(QWheelEvent* event) {
  if (!content_.map) return;
  const double factor = std::pow(1.0015, event->angleDelta().y());
  const double zoom = std::clamp(zoom_ * factor, smallest_zoom, largest_zoom);
  // The point under the pointer stays where it is.
  const QPointF fitted_middle = fit_map(*content_.map, size()).middle;
  const QPointF arm = event->position() - fitted_middle - pan_;
  pan_ += arm * (1 - zoom / zoom_);
  zoom_ = zoom;
  repaint_map();
  event->accept();
}

void MapCanvas::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  press_position_ = last_position_ = event->pos();
  dragging_ = false;
}

void MapCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton) || !content_.map) return;
  const QPointF position = event->pos();
  const double way = (position - press_position_).manhattanLength();
  if (!dragging_ && way < QApplication::startDragDistance()) return;
  dragging_ = true;
  setCursor(Qt::ClosedHandCursor);
  pan_ += position - last_position_;
  last_position_ = position;
  repaint_map();
}

void MapCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  unsetCursor();
  if (!dragging_) {
    selection_.select(patch_at(event->pos()));
    emit clicked(event->pos());
  }
  dragging_ = false;
}

void MapCanvas::mouseDoubleClickEvent(QMouseEvent*) {
  dragging_ = true;  // the release that follows selects nothing
  fit();
}

}  // namespace transillum::viewer
