// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/sketch_painter.h"

#include <QPainter>
#include <QPainterPath>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QPolygonF in_pixels(const std::vector<Vec2>& corners, const MapTransform& shown) {
  QPolygonF polygon;
  for (const Vec2& p : corners) {
    polygon.append(shown.to_pixels(p));
  }
  return polygon;
}

QPainterPath path_of(const QPolygonF& polygon) {
  QPainterPath path;
  path.addPolygon(polygon);
  path.closeSubpath();
  return path;
}

void hatch(QPainter& painter, const QPainterPath& path, const QColor& color, Qt::BrushStyle style) {
  QColor ground = color;
  ground.setAlpha(110);
  painter.fillPath(path, ground);
  painter.fillPath(path, QBrush(color, style));
}

void hatch_differences(QPainter& painter, const MapSketch& sketch, const MapTransform& shown) {
  constexpr std::size_t least_corners = 3;
  if (sketch.right.empty() || sketch.outline.size() < least_corners) {
    return;
  }
  // One path of all parts: the union of hundreds, part by part, would take long in each repaint.
  QPainterPath right;
  right.setFillRule(Qt::WindingFill);
  for (const std::vector<Vec2>& part : sketch.right) {
    right.addPath(path_of(in_pixels(part, shown)));
  }
  const QPainterPath drawn = path_of(in_pixels(sketch.outline, shown));
  hatch(painter, right.subtracted(drawn), theme::selection, Qt::BDiagPattern);
  hatch(painter, drawn.subtracted(right), theme::difference, Qt::FDiagPattern);
}

}  // namespace

// The parts share edges: without antialiasing there are no seams between them.
void fill_parts(QPainter& painter, const std::vector<std::vector<Vec2>>& parts,
                const MapTransform& shown, int alpha) {
  QColor color = theme::region;
  color.setAlpha(alpha);
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  for (const std::vector<Vec2>& part : parts) {
    painter.drawPolygon(in_pixels(part, shown));
  }
  painter.setRenderHint(QPainter::Antialiasing);
}

void draw_sketch(QPainter& painter, const MapSketch& sketch, const MapTransform& shown) {
  fill_parts(painter, sketch.right, shown, 170);
  hatch_differences(painter, sketch, shown);
  const QPolygonF outline = in_pixels(sketch.outline, shown);
  painter.setBrush(Qt::NoBrush);
  for (const QPen& pen :
       {QPen(Qt::black, 4 * theme::scale()), QPen(theme::on_dark, 2 * theme::scale())}) {
    painter.setPen(pen);
    painter.drawPolygon(outline);
    for (const QPointF& corner : outline) {
      painter.drawEllipse(corner, 3 * theme::scale(), 3 * theme::scale());
    }
  }
}

}  // namespace transillum::viewer
