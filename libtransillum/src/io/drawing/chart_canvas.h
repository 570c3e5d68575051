// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cairo.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/drawing/line_chart.h"

namespace transillum {

/// How a line looks.
struct ChartPen {
  ChartColor color;
  double width;
  ChartDashes dashes = ChartDashes::solid;
};

/// Draws the parts of charts on a Cairo context, in its user units, y downward; or on another
/// device, for which the context measures texts and makes paths.
class ChartCanvas {
 public:
  /// @param cairo  must outlive this object
  /// @param font  family of all texts
  /// @param device  null for Cairo
  ChartCanvas(cairo_t* cairo, std::string font, ChartDevice* device = nullptr)
      : cairo_(cairo), font_(std::move(font)), device_(device) {}

  double width_of(const std::string& text, const ChartText& look);
  /// `text`, shortened with an ellipsis if it is wider than `room`; empty if there is no room.
  std::string elided(const std::string& text, double room, const ChartText& look);
  /// Draws a line of text.
  /// @param at  middle of its height, and of its width the fraction `align` from its begin
  /// @param upward  turned by 90 degrees, to be read from below
  void draw(const std::string& text, const ChartPoint& at, double align, const ChartText& look,
            bool upward = false);

  void fill(const ChartArea& area, const ChartColor& color);
  /// Draws a polyline. On a surface of pixels, horizontal and vertical lines are aligned with
  /// them.
  void draw(std::span<const ChartPoint> points, const ChartPen& pen);
  /// Draws the marker of a series.
  /// @param paper  color of the inside of hollow markers
  void draw_marker(const ChartPoint& center, const ChartSeries& series, const ChartColor& paper);

  /// Limits drawing to `area`, until clip_nothing().
  void clip(const ChartArea& area);
  void clip_nothing();

 private:
  void set(const ChartColor& color);
  /// Fills the path, which remains.
  void fill_path(const ChartColor& color);
  /// Draws the path, which is removed.
  /// @param dashes  lengths of dashes and gaps
  void stroke_path(const ChartColor& color, double width, const std::vector<double>& dashes);
  /// The points of the path, and whether it is closed.
  std::pair<std::vector<ChartPoint>, bool> path() const;
  void select(const ChartText& look);
  ChartPoint on_pixels(const ChartPoint& point, double width, bool is_vertical);

  cairo_t* cairo_;
  std::string font_;
  ChartDevice* device_;
};

/// Paints `chart` at the origin of `cairo`.
/// @param width, height of the chart, in user units of `cairo`
/// @param device  draws in place of `cairo`, without the paper; null for `cairo`
/// @returns the plot's area in the same units
ChartArea paint_chart(cairo_t* cairo, const LineChart& chart, double width, double height,
                      ChartDevice* device = nullptr);

}  // namespace transillum
