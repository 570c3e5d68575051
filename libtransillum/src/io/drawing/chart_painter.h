// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cairo.h>

#include "io/drawing/line_chart.h"

namespace transillum {

/// Paints `chart` at the origin of `cairo`.
/// @param width, height of the chart, in user units of `cairo`
/// @returns the plot's area in the same units
ChartArea paint_chart(cairo_t* cairo, const LineChart& chart, double width, double height);

}  // namespace transillum
