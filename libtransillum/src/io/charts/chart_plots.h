// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkChartXY.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkTextProperty.h>

#include <vector>

#include "transillum/line_chart.h"

namespace transillum {

/// What stands on an axis of VTK, which is linear always: the exponent of ten of a logarithmic one.
/// VTK's own logarithmic axis turns linear at a value of zero and holds floats only. NaN for what
/// has no place.
double axis_value(const ChartAxis& axis, double value);

void set_text(vtkTextProperty& text, const ChartStyle& style, double size, const ChartColor& color,
              bool bold = false);
void set_pen(vtkPen& pen, const ChartColor& color, double width);

/// Range, ticks, labels, title and grid of both axes.
void add_axes(vtkChartXY& chart, const LineChart& description);

/// A plot a series, in their order; of lines without markers as many points as `columns` pixels can
/// show.
std::vector<vtkPlot*> add_plots(vtkChartXY& chart, const LineChart& description, double columns);

}  // namespace transillum
