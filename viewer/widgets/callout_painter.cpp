// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/callout_painter.h"

#include <QPainter>
#include <algorithm>

#include "widgets/theme.h"

namespace transillum::viewer {

void draw_callout(QPainter& painter, const QPointF& anchor, const QString& text,
                  const QRectF& bounds) {
  const double unit = theme::scale();
  QFont font = painter.font();
  font.setBold(true);
  painter.save();
  painter.setFont(font);
  painter.setRenderHint(QPainter::Antialiasing);
  const QSizeF size = painter.fontMetrics().size(0, text) + QSizeF(12 * unit, 6 * unit).toSize();
  // Up and to the right, or to the other side where there is no room.
  const QPointF shift(16 * unit, 16 * unit);
  QRectF plate(anchor + QPointF(shift.x(), -shift.y() - size.height()), size);
  if (plate.right() > bounds.right()) {
    plate.moveRight(anchor.x() - shift.x());
  }
  if (plate.top() < bounds.top()) {
    plate.moveTop(anchor.y() + shift.y());
  }
  plate.moveLeft(std::max(bounds.left(), plate.left()));
  plate.moveBottom(std::min(bounds.bottom(), plate.bottom()));
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
