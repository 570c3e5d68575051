// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QImage>

#include "io/drawing/line_chart.h"

class QWidget;

namespace transillum::viewer {

ChartColor chart_color(const QColor& color);

/// The theme's colors and the widget's font.
ChartStyle chart_style(const QWidget& widget);

/// Paints `chart` to `picture`, which gets the size `pixels`.
/// @param scale  device pixels per logical pixel
/// @return the plotted area, in logical pixels
ChartArea paint_chart(const LineChart& chart, QImage& picture, const QSize& pixels, double scale);

}  // namespace transillum::viewer
