// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Line charts as a description (LineChart) and its drawing, to pixels or to a file
// (decisions/0082-charts-without-vtk.md). The library makes them for studies, the viewer also for
// the convergence of a solve run. Lengths are in pixels of a screen with scale 1. Texts are UTF-8;
// invalid sequences are replaced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace transillum {

/// An sRGB color.
struct ChartColor {
  std::uint8_t red = 0;    ///< 0 … 255
  std::uint8_t green = 0;  ///< 0 … 255
  std::uint8_t blue = 0;   ///< 0 … 255

  /// Exact comparison of all members.
  friend bool operator==(const ChartColor&, const ChartColor&) = default;
};

/// The symbol drawn at each point of a series.
enum class ChartMarker {
  none,      ///< no symbol
  dot,       ///< a small disk
  pointer,   ///< a small triangle with its tip at the point
  circle,    ///< a disk
  square,    ///< a square
  triangle,  ///< a triangle, tip up
  diamond,   ///< a square on its corner
  down,      ///< a triangle, tip down
  cross,     ///< an x
  plus,      ///< a +
};
/// The pattern of a series' line.
enum class ChartDashes {
  solid,         ///< continuous
  dashes,        ///< dashes
  dots,          ///< dots
  dash_dot,      ///< a dash and a dot in turn
  dash_dot_dot,  ///< a dash and two dots in turn
  fine_dots,     ///< small dots, close together
};

/// A point in the coordinates of the axes.
struct ChartPoint {
  double x = 0;  ///< on the horizontal axis
  double y = 0;  ///< on the vertical axis
};

/// A polyline through points, from left to right. Points that are not finite, or not positive on a
/// logarithmic axis, are omitted and leave a gap.
struct ChartSeries {
  std::string name;                         ///< in the legend; empty: not in the legend
  std::string note;                         ///< in the legend's second column
  ChartColor color{};                       ///< color of line and markers
  double width = 2;                         ///< width of the line
  ChartDashes dashes = ChartDashes::solid;  ///< dashes of the line
  ChartMarker marker = ChartMarker::none;   ///< at every point
  bool hollow = false;                      ///< markers are outlines
  std::vector<ChartPoint> points;           ///< x ascending
};

/// A tick of an axis.
struct ChartTick {
  double value = 0;    ///< in the axis's coordinate
  std::string label;   ///< omitted where it would touch another label
  bool minor = false;  ///< without a label: a line of the fine grid only
};

/// An axis. Ticks outside its range are not drawn.
struct ChartAxis {
  std::string title;             ///< beside the axis
  double low = 0;                ///< lower end of the range
  double high = 1;               ///< upper end, > low; both are positive on a logarithmic axis
  bool logarithmic = false;      ///< else linear
  bool grid = true;              ///< draw a grid line at every tick
  std::vector<ChartTick> ticks;  ///< ascending
};

/// Colors, font and sizes of a chart.
struct ChartStyle {
  ChartColor paper{255, 255, 255};  ///< background
  ChartColor ink{26, 26, 31};       ///< title, labels, legend, and axes if not `framed`
  ChartColor dim{26, 26, 31};       ///< titles of axes, hint, and axes if `framed`
  ChartColor grid{219, 222, 227};   ///< grid lines
  std::string font = "sans-serif";  ///< font family
  double title_size = 18;           ///< font size of the chart's title
  double text_size = 15;            ///< font size of axis titles and legend
  double label_size = 14;           ///< font size of tick labels
  double margin = 12;               ///< on all four sides
  double line_width = 1.25;         ///< width of axes, and of grid lines with a label
  bool bold_title = false;          ///< whether the chart's title is bold
  bool framed = false;              ///< axis lines on all four sides, not only left and bottom
};

/// A line chart.
struct LineChart {
  std::string title;                ///< above the plot
  std::string hint;                 ///< text in the middle of the plot, if there are no points
  ChartAxis x;                      ///< horizontal axis
  ChartAxis y;                      ///< vertical axis
  std::vector<ChartSeries> series;  ///< drawn in this order, the last on top
  std::vector<std::size_t> legend;  ///< order of the series in the legend; as drawn if empty
  std::string note_title;           ///< heading of the legend's second column
  bool legend_below_title = false;  ///< in rows; otherwise a column at the right
  bool axis_titles = true;          ///< false: only x's, beside the chart's title; for low charts
  ChartStyle style;                 ///< colors, font and sizes
};

/// The plot area inside the axes, from the top left corner of the picture.
struct ChartArea {
  double left = 0;    ///< x of the left side
  double top = 0;     ///< y of the upper side
  double right = 0;   ///< x of the right side
  double bottom = 0;  ///< y of the lower side
};

/// A buffer of 0x..rrggbb pixels, rows from the top.
struct ChartPixels {
  std::uint32_t* first = nullptr;  ///< top left pixel
  int width = 0;                   ///< pixels
  int height = 0;                  ///< pixels
  int stride = 0;                  ///< from row to row, pixels
};

/// Draws a chart into all pixels of the buffer: the same bits each time.
/// @param chart the chart.
/// @param pixels the buffer; it determines the size.
/// @param scale pixels per pixel of a screen with scale 1.
/// @returns the plot area, in pixels of a screen with scale 1.
/// @throws std::runtime_error if drawing fails.
ChartArea paint_chart(const LineChart& chart, const ChartPixels& pixels, double scale = 1);

/// How a text looks.
struct ChartText {
  double size;        ///< size of the font
  ChartColor color;   ///< color of the letters
  bool bold = false;  ///< else of normal weight
};

/// Draws charts in place of Cairo, y downward.
class ChartDevice {
 public:
  virtual ~ChartDevice() = default;
  /// Fills a polygon.
  virtual void fill(std::span<const ChartPoint> corners, const ChartColor& color) = 0;
  /// Draws a polyline, or the edges of a polygon.
  /// @param dashes lengths of dashes and gaps in turn; empty for a continuous line.
  virtual void stroke(std::span<const ChartPoint> points, bool closed, const ChartColor& color,
                      double width, std::span<const double> dashes) = 0;
  /// Draws a line of text.
  /// @param at middle of its height, and of its width the fraction `align` from its begin.
  /// @param upward turned by 90 degrees, to be read from below.
  virtual void text(const std::string& text, const ChartPoint& at, double align,
                    const ChartText& look, bool upward) = 0;
  /// Limits drawing to an area until clip_nothing().
  virtual void clip(const ChartArea& area) = 0;
  /// Ends the limit.
  virtual void clip_nothing() = 0;
};
/// Draws a chart, without its paper, at the origin of a device. Texts are measured with Cairo's
/// fonts.
/// @param chart the chart.
/// @param width width of the chart.
/// @param height height of the chart.
/// @param device the device; it has the font of the chart's style.
/// @throws std::runtime_error if drawing fails.
void draw_chart(const LineChart& chart, double width, double height, ChartDevice& device);

/// The size of a chart in a file.
struct ChartPage {
  double width = 800;   ///< width of each chart
  double height = 480;  ///< height of each chart
  double scale = 2;     ///< pixels of a PNG per pixel of a screen with scale 1
};

/// Checks that `path` is writable and ends in .svg, .pdf or .png.
/// @throws InputError
void check_chart_path(const std::filesystem::path& path);
/// Writes charts of equal size, one below another, in the format given by the extension of `path`,
/// completely or not at all. SVG and PDF contain lines and text; SVG has the texts again as its
/// description.
/// @throws InputError as check_chart_path; std::runtime_error if it cannot be written.
void write_charts(const std::filesystem::path& path, const std::vector<LineChart>& charts,
                  const ChartPage& page = {});

}  // namespace transillum
