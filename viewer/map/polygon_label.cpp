// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/polygon_label.h"

#include <cmath>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QFont small_font(const QPainter& painter, double pixel_ratio) {
  QFont font = painter.font();
  font.setPixelSize(static_cast<int>(std::lround(11 * pixel_ratio * theme::scale())));
  return font;
}

}  // namespace

PolygonLabels::PolygonLabels(QPainter& painter, double pixel_ratio)
    : painter_(painter), ratio_(pixel_ratio), metrics_(small_font(painter, pixel_ratio)) {
  painter_.setFont(small_font(painter, pixel_ratio));
}

void PolygonLabels::write(const QPolygonF& polygon, const QString& text) {
  const QRectF box = polygon.boundingRect();
  const QSizeF size(metrics_.horizontalAdvance(text) + 4 * ratio_, metrics_.height());
  // At half its height, a triangle is half as wide as its bounding box.
  if (box.width() < 1.6 * size.width() || box.height() < 1.6 * size.height()) {
    return;
  }
  QPointF middle;
  for (const QPointF& p : polygon) {
    middle += p / polygon.size();
  }
  const QRectF place(middle - QPointF(size.width(), size.height()) / 2, size);
  painter_.setPen(Qt::NoPen);
  painter_.setBrush(QColor(0, 0, 0, 150));
  painter_.drawRoundedRect(place, 2 * ratio_, 2 * ratio_);
  painter_.setPen(theme::on_dark);
  painter_.drawText(place, Qt::AlignCenter, text);
}

}  // namespace transillum::viewer
