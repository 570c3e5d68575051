// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/callout_painter.h"

#include <QPainter>
#include <algorithm>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

// The first of the four places around `anchor` that is within `bounds` and free; else the first
// place, moved into `bounds`.
QRectF place_for(const QSizeF& size, const QPointF& anchor, const QRectF& bounds,
                 const std::vector<QRectF>& taken) {
  const double shift = 16 * theme::scale();
  QRectF first;
  for (const QPointF& side : {QPointF(1, -1), QPointF(-1, -1), QPointF(1, 1), QPointF(-1, 1)}) {
    const QPointF corner(side.x() > 0 ? anchor.x() + shift : anchor.x() - shift - size.width(),
                         side.y() > 0 ? anchor.y() + shift : anchor.y() - shift - size.height());
    const QRectF plate(corner, size);
    const bool is_free = std::none_of(taken.begin(), taken.end(),
                                      [&](const QRectF& other) { return other.intersects(plate); });
    if (bounds.contains(plate) && is_free) {
      return plate;
    }
    first = first.isNull() ? plate : first;
  }
  first.moveLeft(std::clamp(first.left(), bounds.left(),
                            std::max(bounds.left(), bounds.right() - size.width())));
  first.moveTop(std::clamp(first.top(), bounds.top(),
                           std::max(bounds.top(), bounds.bottom() - size.height())));
  return first;
}

}  // namespace

void draw_callout(QPainter& painter, const QPointF& anchor, const QString& text,
                  const QRectF& bounds, std::vector<QRectF>& taken) {
  const double unit = theme::scale();
  QFont font = painter.font();
  font.setBold(true);
  painter.save();
  painter.setFont(font);
  painter.setRenderHint(QPainter::Antialiasing);
  const QSizeF size = painter.fontMetrics().size(0, text) + QSizeF(12 * unit, 6 * unit).toSize();
  const QRectF plate = place_for(size, anchor, bounds, taken);
  taken.push_back(plate);
  const QPointF end(std::clamp(anchor.x(), plate.left(), plate.right()),
                    std::clamp(anchor.y(), plate.top(), plate.bottom()));
  painter.setPen(QPen(Qt::black, 4 * unit));
  painter.drawLine(anchor, end);
  painter.setPen(QPen(theme::on_dark, 2 * unit));
  painter.drawLine(anchor, end);
  painter.setBrush(theme::on_dark);
  painter.drawEllipse(anchor, 3 * unit, 3 * unit);
  painter.setPen(QPen(Qt::black, unit));
  painter.drawRoundedRect(plate, 4 * unit, 4 * unit);
  painter.setPen(theme::on_yellow);
  painter.drawText(plate, Qt::AlignCenter, text);
  painter.restore();
}

}  // namespace transillum::viewer
