// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace transillum {

// Line charts, as VTK draws them (decisions/0019). Lengths are in pixels of a common screen; texts
// are UTF-8, and what is not is replaced.

struct ChartColor {
  std::uint8_t red = 0, green = 0, blue = 0;

  friend bool operator==(const ChartColor&, const ChartColor&) = default;
};

/// dot and pointer are small, pointer a triangle whose tip is at the point.
enum class ChartMarker { none, dot, pointer, circle, square, triangle, diamond, down, cross, plus };
enum class ChartDashes { solid, dashes, dots, dash_dot, dash_dot_dot, fine_dots };

struct ChartPoint {
  double x = 0, y = 0;
};

/// A line through points, from left to right. Points that are not finite, or not positive on a
/// logarithmic axis, are left out and leave a gap.
struct ChartSeries {
  std::string name;  ///< in the legend; empty: not there
  std::string note;  ///< in the legend's second column
  ChartColor color{};
  double width = 2;
  ChartDashes dashes = ChartDashes::solid;
  ChartMarker marker = ChartMarker::none;
  bool hollow = false;  ///< the markers
  std::vector<ChartPoint> points;
};

struct ChartTick {
  double value = 0;
  std::string label;   ///< left out where it would touch another
  bool minor = false;  ///< only a line of the fine grid
};

/// An axis; ticks outside of it are not drawn.
struct ChartAxis {
  std::string title;
  double low = 0, high = 1;  ///< low < high; logarithmic: both positive
  bool logarithmic = false;
  bool grid = true;
  std::vector<ChartTick> ticks;
};

struct ChartStyle {
  ChartColor paper{255, 255, 255}, ink{26, 26, 31}, dim{26, 26, 31}, grid{219, 222, 227};
  std::string font = "sans-serif";
  double title_size = 18, text_size = 15, label_size = 14;
  double margin = 12;
  double line_width = 1.25;  ///< of axes; of the grid where a label stands
  bool bold_title = false;
  bool framed = false;  ///< all round, not only at left and below
};

struct LineChart {
  std::string title;
  std::string hint;  ///< words in the middle of the plot, where there is nothing else
  ChartAxis x, y;
  std::vector<ChartSeries> series;  ///< the last is on top
  std::vector<std::size_t> legend;  ///< order of series there; empty: as they are
  std::string note_title;           ///< of the legend's second column
  bool legend_below_title = false;  ///< in a row; otherwise a column at the right
  bool axis_titles = true;          ///< false: only that of x, beside the title; for low charts
  ChartStyle style;
};

/// Where the plot, inside its axes, lies: from the picture's left and top.
struct ChartArea {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Rows from the top of 0x..rrggbb, `stride` pixels apart.
struct ChartPixels {
  std::uint32_t* first = nullptr;
  int width = 0, height = 0, stride = 0;
};

/// Fills all pixels, `scale` to a pixel of a common screen: the same bits each time.
/// @returns the plot's area in pixels of a common screen
/// @throws std::runtime_error
ChartArea paint_chart(const LineChart& chart, const ChartPixels& pixels, double scale = 1);

struct ChartPage {
  double width = 800, height = 480;
  double scale = 2;  ///< pixels of a PNG to one of a common screen
};

/// check_writable, and @throws InputError unless `path` ends in .svg or .png.
void check_chart_path(const std::filesystem::path& path);
/// Writes charts below one another, each as high as the others, as the ending of `path` says, whole
/// or not at all. SVG: lines and outlines of letters, and the words once more as its description.
/// @throws InputError as check_chart_path; std::runtime_error where it cannot be written.
void write_charts(const std::filesystem::path& path, const std::vector<LineChart>& charts,
                  const ChartPage& page = {});

}  // namespace transillum
