// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Line charts: positions of lines in the painted pixels, and the files written.
#include "io/drawing/line_chart.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/program_call.h"
#include "support/temporary_folder.h"
#include "transillum/errors.h"

namespace transillum::testing::line_chart_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint32_t paper = 0xffffff, red = 0xff0000;

struct Picture {
  int width, height;
  std::vector<std::uint32_t> pixels;
  ChartArea area;

  std::uint32_t at(double x, double y) const {
    return pixels[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] & 0xffffff;
  }
  double count(std::uint32_t color) const {
    return static_cast<double>(std::count_if(
        pixels.begin(), pixels.end(), [&](auto pixel) { return (pixel & 0xffffff) == color; }));
  }
};

Picture paint(const LineChart& chart, int width = 400, int height = 240, double scale = 1) {
  Picture picture{width, height, {}, {}};
  picture.pixels.assign(static_cast<std::size_t>(width) * height, 0);
  picture.area = paint_chart(chart, {picture.pixels.data(), width, height, width}, scale);
  return picture;
}

ChartSeries line(std::vector<ChartPoint> points) {
  ChartSeries series;
  series.name = "a line";
  series.color = {255, 0, 0};
  series.width = 3;
  series.points = std::move(points);
  return series;
}

/// A chart over three decades, without a grid, so that lines can be found by color.
LineChart decades(std::vector<ChartPoint> points) {
  LineChart chart;
  chart.title = "Title";
  chart.x = {"x", 1, 5, false, false, {{1, "1", false}, {5, "5", false}}};
  chart.y = {"y", 0.001, 1, true, false, {{0.001, "0.1 %", false}, {1, "100 %", false}}};
  chart.series = {line(std::move(points))};
  return chart;
}

TEST(LineChart, LogarithmicAxisPlacesPointsByExponent) {
  const Picture picture = paint(decades({{1, 0.01}, {5, 0.01}}));
  const ChartArea& area = picture.area;
  const double x = (area.left + area.right) / 2;
  EXPECT_EQ(picture.at(x, area.bottom - (area.bottom - area.top) / 3), red);
  EXPECT_EQ(picture.at(x, area.bottom - (area.bottom - area.top) / 20), paper);
}

TEST(LineChart, ZeroLeavesAGapAndKeepsTheAxisLogarithmic) {
  const Picture without = paint(decades({{1, 0.01}, {2, 0.5}}));
  for (const double nothing : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    // After the last point it has no effect.
    EXPECT_EQ(paint(decades({{1, 0.01}, {2, 0.5}, {3, nothing}})).pixels, without.pixels);
    const Picture gap = paint(decades({{1, 0.01}, {2, nothing}, {3, 0.01}, {5, 0.01}}));
    const ChartArea& area = gap.area;
    const double y = area.bottom - (area.bottom - area.top) / 3;
    EXPECT_EQ(gap.at(area.left + (area.right - area.left) / 4, y), paper);
    EXPECT_EQ(gap.at(area.left + 3 * (area.right - area.left) / 4, y), red);
  }
}

TEST(LineChart, ThinningKeepsPeaks) {
  std::vector<ChartPoint> points;
  for (int k = 0; k < 100000; ++k) {
    points.push_back({1 + 4 * k / 1e5, k == 50000 ? 0.9 : 0.01});
  }
  const Picture picture = paint(decades(points));
  const ChartArea& area = picture.area;
  EXPECT_EQ(picture.at((area.left + area.right) / 2, (area.top + area.bottom) / 2), red);
  EXPECT_EQ(picture.at(area.left + 5, (area.top + area.bottom) / 2), paper);
}

TEST(LineChart, LinesStayInThePlot) {
  const Picture picture = paint(decades({{-3, 1e-9}, {2, 1e9}, {9, 1e-9}}));
  const ChartArea& area = picture.area;
  EXPECT_GT(picture.count(red), 100);
  double outside = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < area.right + 2; ++x) {  // right of it is the legend
      const bool inside =
          x >= area.left - 1 && x <= area.right + 1 && y >= area.top - 1 && y <= area.bottom + 1;
      if (!inside && picture.at(x, y) == red) {
        ++outside;
      }
    }
  }
  EXPECT_EQ(outside, 0);
}

TEST(LineChart, MarkersAreDrawnOverTheAxes) {
  LineChart chart = decades({{1, 0.001}, {5, 1}});
  chart.series[0].marker = ChartMarker::square;
  const Picture picture = paint(chart);
  EXPECT_EQ(picture.at(picture.area.left, picture.area.bottom), red);
  EXPECT_EQ(picture.at(picture.area.left + 3, picture.area.bottom), red);
}

TEST(LineChart, LegendBelowTheTitleTakesMoreRowsForMoreNames) {
  LineChart chart = decades({{1, 0.01}, {5, 0.5}});
  chart.legend_below_title = true;
  const auto top_of = [&](std::size_t names) {
    chart.series.resize(names, chart.series[0]);
    return paint(chart).area.top;
  };
  const double one = top_of(1), row = top_of(6) - one;
  EXPECT_EQ(top_of(2), one);
  EXPECT_GT(row, 10);
  EXPECT_NEAR(top_of(40), one + row, 1);  // a fifth of the height is the limit
}

TEST(LineChart, ManyMarkersArePaintedAsFew) {
  std::vector<ChartPoint> points;
  for (int k = 0; k < 100000; ++k) {
    points.push_back({1 + 4 * k / 1e5, k % 2 == 0 ? 0.9 : 0.01});
  }
  LineChart chart = decades(points);
  chart.series[0].marker = ChartMarker::dot;
  const Picture picture = paint(chart);
  const ChartArea& area = picture.area;
  const double height = area.bottom - area.top;
  EXPECT_EQ(picture.at((area.left + area.right) / 2, area.top + height / 3), red);
  EXPECT_EQ(picture.at((area.left + area.right) / 2, area.bottom - height / 5), paper);
}

TEST(LineChart, ScaleChangesPixelsNotTheLayout) {
  const LineChart chart = decades({{1, 0.01}, {5, 0.5}});
  const Picture one = paint(chart), two = paint(chart, 800, 480, 2);
  EXPECT_NEAR(one.area.left, two.area.left, 3);  // letters have whole pixels
  EXPECT_NEAR(one.area.right, two.area.right, 3);
  EXPECT_GT(one.count(red), 100);
  EXPECT_NEAR(two.count(red) / one.count(red), 4, 1.5);  // anti-aliased edges of lines are paler
}

TEST(LineChart, SvgHasVectorsAndText) {
  unsetenv("DISPLAY");
  const TemporaryFolder folder;
  LineChart chart = decades({{1, 0.01}, {5, 0.5}});
  chart.series[0].name = "change < 1 & \xff";
  chart.series[0].dashes = ChartDashes::dashes;
  write_charts(folder / "c.svg", {chart, chart});
  const std::string svg = read_file(folder / "c.svg");
  EXPECT_THAT(svg, HasSubstr("<path"));
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(svg, Not(HasSubstr("<image")));
  EXPECT_THAT(svg, HasSubstr("<title>Title; Title</title>"));
  EXPECT_THAT(svg, HasSubstr(">change &lt; 1 &amp; \ufffd</text>"));
  EXPECT_THAT(svg, HasSubstr(" change &lt; 1 &amp; \ufffd,"));
  EXPECT_THAT(svg, HasSubstr(">Title</text>"));
}

TEST(LineChart, PngIsTheSameEachTime) {
  const TemporaryFolder folder;
  LineChart chart = decades({{1, 0.01}, {3, 0.1}, {5, 0.5}});
  chart.series[0].marker = ChartMarker::triangle;
  for (const char* name : {"a.png", "b.png"}) {
    write_charts(folder / name, {chart});
  }
  const std::string first = read_file(folder / "a.png");
  EXPECT_EQ(first, read_file(folder / "b.png"));
  chart.series[0].hollow = true;
  write_charts(folder / "c.png", {chart});
  EXPECT_NE(first, read_file(folder / "c.png"));
}

TEST(LineChart, AnySizeAndAnyMarkerCanBePainted) {
  LineChart chart = decades({{1, 0.01}, {3, 0.1}, {5, 0.5}});
  chart.hint = "a hint that is longer than the space available for it in the plot";
  for (int marker = 0; marker <= static_cast<int>(ChartMarker::plus); ++marker) {
    chart.series.push_back(chart.series[0]);
    chart.series.back().marker = static_cast<ChartMarker>(marker);
    chart.series.back().note = "1";
    chart.series.back().points.resize(static_cast<std::size_t>(marker % 4));
  }
  for (const bool row : {true, false}) {
    chart.legend_below_title = row;
    chart.axis_titles = row;
    for (const int size : {1, 40, 77, 150, 300}) {
      const Picture picture = paint(chart, size, size);
      EXPECT_GE(picture.count(paper), 1);
    }
  }
  paint(LineChart());
}

TEST(LineChart, NothingIsLeftBehindIfWritingFails) {
  const TemporaryFolder folder;
  const LineChart chart = decades({{1, 0.01}});
  EXPECT_THROW(check_chart_path(folder / "c.jpg"), InputError);
  EXPECT_THROW(write_charts(folder / "c.jpg", {chart}), InputError);
  EXPECT_THROW(check_chart_path(folder / "no/c.svg"), InputError);
  EXPECT_THROW(write_charts(folder / "no/c.svg", {chart}), std::runtime_error);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace transillum::testing::line_chart_test
