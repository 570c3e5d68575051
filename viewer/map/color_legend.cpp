// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/color_legend.h"

#include <QPainter>
#include <utility>

#include "widgets/theme.h"

namespace transillum::viewer {

ColorLegend::ColorLegend(std::function<QColor(double)> color, const QString& range)
    : color_(std::move(color)), range_(range) {
  setFixedHeight(fontMetrics().height() + 12);
}

void ColorLegend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  const QRect bar(10, (height() - 12) / 2, width() / 3, 12);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  constexpr int stops = 8;
  for (int k = 0; k <= stops; ++k) {
    gradient.setColorAt(k / double{stops}, color_(k / double{stops}));
  }
  painter.setPen(theme::on_dark_dim);
  painter.fillRect(bar, gradient);
  painter.drawRect(bar);
  painter.setPen(theme::on_dark);
  painter.drawText(rect().adjusted(bar.right() + 8, 0, -4, 0), Qt::AlignVCenter | Qt::AlignLeft,
                   range_);
}

}  // namespace transillum::viewer
