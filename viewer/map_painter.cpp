// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map_painter.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme.h"

namespace transillum::viewer {

namespace {

const QColor back_side{0x43, 0x4a, 0x55};
const QColor back_hatch{0x6b, 0x74, 0x80};

bool outside(const QPolygonF& polygon, const QRectF& view) {
  return !polygon.boundingRect().intersects(view);
}

double area(const QPolygonF& polygon) {
  double twice = 0;
  for (int k = 0; k < polygon.size(); ++k) {
    const QPointF& a = polygon[k];
    const QPointF& b = polygon[(k + 1) % polygon.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return std::abs(twice) / 2;
}

}  // namespace

// Diagonal lines in a tile: a pattern brush would be too coarse on a 2x screen.
QBrush back_side_brush(double pixel_ratio) {
  const int size = static_cast<int>(std::lround(6 * pixel_ratio));
  QImage tile(size, size, QImage::Format_RGB32);
  tile.fill(back_side);
  QPainter painter(&tile);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(back_hatch, pixel_ratio));
  for (const int shift : {-size, 0, size})
    painter.drawLine(QPointF(shift - 1, size + 1), QPointF(shift + size + 1, -1));
  painter.end();
  return QBrush(tile);
}

MapTransform fit_map(const RecordedMap& map, const QSizeF& size) {
  double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
  for (const Vec3& p : map.loaded->scene->points()) {
    const Vec2 q = map.record.frame.project(p);
    left = std::min(left, q.x);
    right = std::max(right, q.x);
    bottom = std::min(bottom, q.y);
    top = std::max(top, q.y);
  }
  constexpr double margin = 14, scale_bar_room = 34;  // logical pixels
  const double width = std::max(size.width() - 2 * margin, 10.0);
  const double height = std::max(size.height() - 2 * margin - scale_bar_room, 10.0);
  MapTransform transform;
  transform.center = {(left + right) / 2, (bottom + top) / 2};
  transform.middle = {margin + width / 2, margin + height / 2};
  transform.scale =
      std::min(width / std::max(right - left, 1e-12), height / std::max(top - bottom, 1e-12));
  return transform;
}

QPolygonF row_polygon(const MapRecord& record, const MapRecord::Row& row,
                      const MapTransform& transform) {
  QPolygonF polygon;
  const auto outline = record.outline(row);
  polygon.reserve(static_cast<int>(outline.size()));
  for (const Vec2& p : outline) polygon.append(transform.to_pixels(p));
  return polygon;
}

MapPicture paint_map(const MapPictureRequest& request) {
  MapPicture picture;
  picture.request = request;
  const MapRecord& record = request.map->record;
  picture.rows = record.map_after(request.step);

  const double ratio = request.pixel_ratio;
  const QSize device_size(static_cast<int>(std::lround(request.size.width() * ratio)),
                          static_cast<int>(std::lround(request.size.height() * ratio)));
  picture.image = QImage(device_size, QImage::Format_RGB32);
  picture.image.fill(theme::scene_background);
  MapTransform transform = request.transform;
  transform.scale *= ratio;
  transform.middle *= ratio;
  const QRectF view(QPointF(0, 0), QSizeF(device_size));

  QPainter painter(&picture.image);
  const QBrush hatch = back_side_brush(ratio);
  // Polygons that share an edge are filled without antialiasing: no seams. Thin lines over the
  // edges, drawn afterwards where polygons are large enough to bear them, smooth the steps.
  std::vector<QPolygonF> outlines;
  for (const std::int32_t number : picture.rows) {
    const MapRecord::Row& row = record.rows[static_cast<std::size_t>(number)];
    const QPolygonF polygon = row_polygon(record, row, transform);
    if (outside(polygon, view)) continue;
    const Color8& c = (*request.patch_colors)[static_cast<std::size_t>(row.patch)];
    painter.setPen(Qt::NoPen);
    painter.setBrush(row.front_facing ? hatch : QBrush(QColor(c[0], c[1], c[2])));
    painter.drawPolygon(polygon);
    if (area(polygon) > 30 * ratio * ratio) outlines.push_back(polygon);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 80), 0.6 * ratio));
  for (const QPolygonF& polygon : outlines) painter.drawPolygon(polygon);
  painter.end();
  picture.image.setDevicePixelRatio(ratio);
  return picture;
}

std::int32_t row_at(const MapRecord& record, const std::vector<std::int32_t>& rows, const Vec2& p) {
  for (const std::int32_t number : rows) {
    const auto outline = record.outline(record.rows[static_cast<std::size_t>(number)]);
    // Convex, of either orientation: p lies on one side of all edges.
    bool left = true, right = true;
    for (std::size_t k = 0; k < outline.size() && (left || right); ++k) {
      const Vec2& a = outline[k];
      const Vec2& b = outline[(k + 1) % outline.size()];
      const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      left = left && side >= 0;
      right = right && side <= 0;
    }
    if (left != right) return number;
  }
  return MapRecord::no_row;
}

}  // namespace transillum::viewer
