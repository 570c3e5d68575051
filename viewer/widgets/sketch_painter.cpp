// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/sketch_painter.h"

#include <QPainter>
#include <QPainterPath>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

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

void hatch_differences(QPainter& painter, const QPolygonF& outline,
                       const std::vector<QPolygonF>& parts) {
  constexpr int least_corners = 3;
  if (parts.empty() || outline.size() < least_corners) {
    return;
  }
  // One path of all parts: the union of hundreds, part by part, would take long in each repaint.
  QPainterPath right;
  right.setFillRule(Qt::WindingFill);
  for (const QPolygonF& part : parts) {
    right.addPath(path_of(part));
  }
  const QPainterPath drawn = path_of(outline);
  hatch(painter, right.subtracted(drawn), theme::selection, Qt::BDiagPattern);
  hatch(painter, drawn.subtracted(right), theme::difference, Qt::FDiagPattern);
}

}  // namespace

// The parts share edges: without antialiasing there are no seams between them.
void fill_parts(QPainter& painter, const std::vector<QPolygonF>& parts, int alpha) {
  QColor color = theme::region;
  color.setAlpha(alpha);
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  for (const QPolygonF& part : parts) {
    painter.drawPolygon(part);
  }
  painter.setRenderHint(QPainter::Antialiasing);
}

void draw_sketch(QPainter& painter, const QPolygonF& outline, const std::vector<QPolygonF>& right) {
  fill_parts(painter, right, 170);
  hatch_differences(painter, outline, right);
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
