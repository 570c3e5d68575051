// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// From the description of a LineChart to the axes and plots of a vtkChartXY.
#include "io/vtk/chart_plots.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlotGrid.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/vtk/cairo_context_device.h"

namespace transillum {
namespace {

constexpr double not_shown = std::numeric_limits<double>::quiet_NaN();

int marker_of(ChartMarker marker) {
  switch (marker) {
    case ChartMarker::none:
      return VTK_MARKER_NONE;
    case ChartMarker::dot:
      return marker_dot;
    case ChartMarker::pointer:
      return marker_pointer;
    case ChartMarker::circle:
      return VTK_MARKER_CIRCLE;
    case ChartMarker::square:
      return VTK_MARKER_SQUARE;
    case ChartMarker::triangle:
      return marker_triangle;
    case ChartMarker::diamond:
      return VTK_MARKER_DIAMOND;
    case ChartMarker::down:
      return marker_down;
    case ChartMarker::cross:
      return VTK_MARKER_CROSS;
    case ChartMarker::plus:
      return VTK_MARKER_PLUS;
  }
  return VTK_MARKER_NONE;
}

int line_type_of(ChartDashes dashes) {
  switch (dashes) {
    case ChartDashes::solid:
      return vtkPen::SOLID_LINE;
    case ChartDashes::dashes:
      return vtkPen::DASH_LINE;
    case ChartDashes::dots:
      return vtkPen::DOT_LINE;
    case ChartDashes::dash_dot:
      return vtkPen::DASH_DOT_LINE;
    case ChartDashes::dash_dot_dot:
      return vtkPen::DASH_DOT_DOT_LINE;
    case ChartDashes::fine_dots:
      return vtkPen::DENSE_DOT_LINE;
  }
  return vtkPen::SOLID_LINE;
}

/// Sets the minor ticks, or the others.
void set_ticks(vtkAxis& axis, const ChartAxis& description, bool minor) {
  const vtkNew<vtkDoubleArray> positions;
  const vtkNew<vtkStringArray> labels;
  for (const ChartTick& tick : description.ticks) {
    const double position = axis_value(description, tick.value);
    if (tick.minor != minor || std::isnan(position)) {
      continue;
    }
    positions->InsertNextValue(position);
    labels->InsertNextValue(tick.label);
  }
  axis.SetBehavior(vtkAxis::CUSTOM);
  axis.SetMinimum(axis_value(description, description.low));
  axis.SetMaximum(axis_value(description, description.high));
  axis.SetCustomTickPositions(positions, labels);
}

void set_axis(vtkAxis& axis, const ChartAxis& description, const LineChart& chart) {
  const ChartStyle& style = chart.style;
  set_ticks(axis, description, false);
  axis.SetTitle(chart.axis_titles ? description.title : std::string());
  axis.SetGridVisible(description.grid);
  axis.SetTickLength(4);
  axis.SetLabelOffset(6);
  set_pen(*axis.GetPen(), style.framed ? style.dim : style.ink, style.line_width);
  set_pen(*axis.GetGridPen(), style.grid, style.line_width);
  set_text(*axis.GetLabelProperties(), style, style.label_size, style.ink);
  set_text(*axis.GetTitleProperties(), style, style.text_size, style.dim);
}

/// Sets the opposite axis, which has the fine grid.
void set_fine_axis(vtkAxis& axis, const ChartAxis& description, const ChartStyle& style) {
  set_ticks(axis, description, true);
  axis.SetTitle("");
  axis.SetVisible(true);
  axis.SetAxisVisible(style.framed);
  axis.SetTicksVisible(false);
  axis.SetLabelsVisible(false);
  set_pen(*axis.GetPen(), style.dim, style.line_width);
  set_pen(*axis.GetGridPen(), style.grid, 0.4 * style.line_width);
}

/// Keeps the lowest and highest point per column of pixels, which looks the same and draws faster.
std::vector<ChartPoint> thinned(const std::vector<ChartPoint>& points, double left,
                                double column_width) {
  std::vector<ChartPoint> kept;
  std::size_t begin = 0;
  const auto column_of = [&](std::size_t k) {
    return std::floor((points[k].x - left) / column_width);
  };
  while (begin < points.size()) {
    std::size_t end = begin, low = points.size(), high = low;
    for (; end < points.size() && column_of(end) == column_of(begin); ++end) {
      if (std::isnan(points[end].y)) {
        continue;
      }
      if (low == points.size() || points[end].y < points[low].y) {
        low = end;
      }
      if (high == points.size() || points[end].y > points[high].y) {
        high = end;
      }
    }
    end = std::max(end, begin + 1);
    if (low == points.size()) {
      kept.push_back({points[begin].x, not_shown});
    } else {
      kept.push_back(points[std::min(low, high)]);
      if (low != high) {
        kept.push_back(points[std::max(low, high)]);
      }
    }
    begin = end;
  }
  return kept;
}

std::vector<ChartPoint> placed_points(const ChartSeries& series, const LineChart& chart,
                                      double columns) {
  std::vector<ChartPoint> points;
  points.reserve(series.points.size());
  for (const ChartPoint& point : series.points) {
    points.push_back({axis_value(chart.x, point.x), axis_value(chart.y, point.y)});
  }
  if (series.marker != ChartMarker::none || static_cast<double>(points.size()) <= 2 * columns) {
    return points;
  }
  const double left = axis_value(chart.x, chart.x.low), right = axis_value(chart.x, chart.x.high);
  return thinned(points, left, (right - left) / columns);
}

}  // namespace

double axis_value(const ChartAxis& axis, double value) {
  const double at = axis.logarithmic ? (value > 0 ? std::log10(value) : not_shown) : value;
  return std::abs(at) < 1e30 ? at : not_shown;
}

void set_text(vtkTextProperty& text, const ChartStyle& style, double size, const ChartColor& color,
              bool bold) {
  text.SetFontFamilyAsString(style.font.c_str());
  text.SetFontSize(static_cast<int>(std::lround(size)));
  text.SetBold(bold ? 1 : 0);
  text.SetColor(color.red / 255.0, color.green / 255.0, color.blue / 255.0);
}

void set_pen(vtkPen& pen, const ChartColor& color, double width) {
  pen.SetColor(color.red, color.green, color.blue, 255);
  pen.SetWidth(static_cast<float>(width));
}

void add_axes(vtkChartXY& chart, const LineChart& description) {
  chart.SetAutoAxes(false);
  vtkAxis& x = *chart.GetAxis(vtkAxis::BOTTOM);
  vtkAxis& y = *chart.GetAxis(vtkAxis::LEFT);
  set_axis(x, description.x, description);
  set_axis(y, description.y, description);
  y.SetTicksVisible(false);  // the grid's lines end there
  vtkAxis& fine_x = *chart.GetAxis(vtkAxis::TOP);
  vtkAxis& fine_y = *chart.GetAxis(vtkAxis::RIGHT);
  set_fine_axis(fine_x, description.x, description.style);
  set_fine_axis(fine_y, description.y, description.style);
  const vtkNew<vtkPlotGrid> fine_grid;
  fine_grid->SetXAxis(&fine_x);
  fine_grid->SetYAxis(&fine_y);
  chart.Lower(chart.AddItem(fine_grid));
}

std::vector<vtkPlot*> add_plots(vtkChartXY& chart, const LineChart& description, double columns) {
  std::vector<vtkPlot*> plots;
  for (const ChartSeries& series : description.series) {
    std::vector<ChartPoint> points = placed_points(series, description, columns);
    if (points.size() == 1) {
      points.push_back(points.front());  // VTK requires two points per line
    }
    const vtkNew<vtkDoubleArray> x, y;
    x->SetName("x");
    y->SetName("y");
    bool any = false;
    for (const ChartPoint& point : points) {
      x->InsertNextValue(point.x);
      y->InsertNextValue(point.y);
      any = any || !(std::isnan(point.x) || std::isnan(point.y));
    }
    const vtkNew<vtkTable> table;
    table->AddColumn(x);
    table->AddColumn(y);
    vtkPlot* plot = chart.AddPlot(vtkChart::LINE);
    plot->SetInputData(table, 0, 1);
    plot->SetVisible(any);
    set_pen(*plot->GetPen(), series.color, series.width);
    plot->GetPen()->SetLineType(line_type_of(series.dashes));
    const ChartColor fill = series.hollow ? description.style.paper : series.color;
    plot->GetBrush()->SetColor(fill.red, fill.green, fill.blue, 255);
    vtkPlotPoints::SafeDownCast(plot)->SetMarkerStyle(marker_of(series.marker));
    plots.push_back(plot);
  }
  return plots;
}

}  // namespace transillum
