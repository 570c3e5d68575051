// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkChartXY.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkTextProperty.h>

#include <vector>

#include "transillum/line_chart.h"

namespace transillum {

/// Coordinate of a value on VTK's axis, which is always linear here: log10(value) for a logarithmic
/// axis, NaN for values that cannot be shown. VTK's own logarithmic axis becomes linear at a value
/// of zero and keeps floats only.
double axis_value(const ChartAxis& axis, double value);

void set_text(vtkTextProperty& text, const ChartStyle& style, double size, const ChartColor& color,
              bool bold = false);
void set_pen(vtkPen& pen, const ChartColor& color, double width);

/// Sets range, ticks, labels, title and grid of both axes.
void add_axes(vtkChartXY& chart, const LineChart& description);

/// Adds one plot per series, in their order. Lines without markers are thinned to what `columns`
/// pixels can show.
std::vector<vtkPlot*> add_plots(vtkChartXY& chart, const LineChart& description, double columns);

}  // namespace transillum
