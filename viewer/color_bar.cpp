// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "color_bar.h"

#include <QPainter>
#include <cmath>

#include "number_text.h"
#include "theme.h"

namespace transillum::viewer {

namespace {

QString name_of_shown(ColorMode mode) {
  switch (mode) {
    case ColorMode::red:
      return ColorBar::tr("Red");
    case ColorMode::green:
      return ColorBar::tr("Green");
    case ColorMode::blue:
      return ColorBar::tr("Blue");
    case ColorMode::true_color:
    case ColorMode::luminance:
      break;
  }
  return ColorBar::tr("Luminance");
}

QString tick_text(double value, bool logarithmic) {
  if (logarithmic && (value < 1e-3 || value >= 1e5)) {
    const double exponent = std::log10(value);
    if (std::abs(exponent - std::round(exponent)) < 1e-6)
      return power_of_ten_text(static_cast<int>(std::lround(exponent)));
  }
  return number_text(value);
}

}  // namespace

ColorBar::ColorBar(const ColorChoice& colors, QWidget* parent) : QWidget(parent), colors_(colors) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  const auto show = [this] {
    setVisible(colors_.scale().mode != ColorMode::true_color);
    update();
  };
  connect(&colors, &ColorChoice::changed, this, show);
  connect(&colors, &ColorChoice::fitted, this, qOverload<>(&QWidget::update));
  show();
}

void ColorBar::paintEvent(QPaintEvent*) {
  const ColorScale& scale = colors_.scale();
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  painter.setPen(theme::on_dark);

  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  const int line = fontMetrics().height();
  painter.drawText(QRect(0, 12, width(), line), Qt::AlignHCenter, tr("B (W/m²)"));
  painter.setFont(font());
  painter.setPen(theme::on_dark_dim);
  painter.drawText(QRect(0, 12 + line, width(), line), Qt::AlignHCenter, name_of_shown(scale.mode));

  const QRectF bar(12, 12 + 2 * line + 22, 20, height() - (12 + 2 * line + 22) - 22);
  if (bar.height() < 20) return;
  const auto rows = static_cast<int>(bar.height() * devicePixelRatioF());
  const double row_height = bar.height() / rows;
  for (int row = 0; row < rows; ++row) {
    const Color8 c = color_of(scale.map, 1 - (row + 0.5) / rows);
    painter.fillRect(
        QRectF(bar.left(), bar.top() + row * row_height, bar.width(), 1.01 * row_height),
        QColor(c[0], c[1], c[2]));
  }
  if (scale.above) {
    // A tip on the bar: there is more beyond its end.
    const Color8 c = color_of(scale.map, 1);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(c[0], c[1], c[2]));
    painter.drawPolygon(QPolygonF({bar.topLeft() - QPointF(0, 2), bar.topRight() - QPointF(0, 2),
                                   QPointF(bar.center().x(), bar.top() - 12)}));
    painter.setBrush(Qt::NoBrush);
    painter.setRenderHint(QPainter::Antialiasing, false);
  }
  painter.setPen(QPen(theme::on_dark_dim, 1));
  painter.drawRect(bar.adjusted(-0.5, -0.5, 0.5, 0.5));

  painter.setPen(theme::on_dark);
  for (const double value : scale.ticks()) {
    const double y = bar.bottom() - scale.position(value) * bar.height();
    painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + 5, y));
    painter.drawText(QRectF(bar.right() + 9, y - line / 2.0, width() - bar.right() - 9, line),
                     Qt::AlignLeft | Qt::AlignVCenter, tick_text(value, scale.logarithmic));
  }
}

}  // namespace transillum::viewer
