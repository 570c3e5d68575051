// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QImage>

#include "transillum/line_chart.h"

class QWidget;

namespace transillum::viewer {

ChartColor chart_color(const QColor& color);

/// The theme's colors and the widget's type.
ChartStyle chart_style(const QWidget& widget);

/// Paints a picture of `pixels`, `scale` of them to one of the widget.
ChartArea paint_chart(const LineChart& chart, QImage& picture, const QSize& pixels, double scale);

}  // namespace transillum::viewer
