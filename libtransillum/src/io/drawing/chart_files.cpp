// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Line charts as SVG, PDF or PNG files, or painted into pixels in memory.
#include <fmt/format.h>

#include <array>
#include <ostream>
#include <utility>

#include "base/text_file.h"
#include "io/drawing/cairo_surface.h"
#include "io/drawing/chart_canvas.h"
#include "io/drawing/line_chart.h"
#include "io/drawing/svg_device.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// Paints charts one below the other, of equal height, in an area of `width` by `height` units.
/// Returns the plot area of the last.
ChartArea paint(cairo_t* cairo, const std::vector<LineChart>& charts, double width, double height) {
  const double each = height / static_cast<double>(charts.size());
  ChartArea area;
  for (const LineChart& chart : charts) {
    area = paint_chart(cairo, chart, width, each);
    cairo_translate(cairo, 0, each);
  }
  return area;
}

/// The same on a surface. @param scale  pixels per unit
ChartArea paint(cairo_surface_t* surface, const std::vector<LineChart>& charts, double width,
                double height, double scale) {
  const CairoContext cairo(cairo_create(surface), cairo_destroy);
  cairo_scale(cairo.get(), scale, scale);
  const ChartArea area = paint(cairo.get(), charts, width, height);
  check_drawn(cairo_status(cairo.get()));
  return area;
}

/// The titles, and axes and series with their notes, for screen readers.
std::pair<std::string, std::string> description_of(const std::vector<LineChart>& charts) {
  std::string title, lines;
  for (const LineChart& chart : charts) {
    title += (title.empty() ? "" : "; ") + chart.title;
    lines += (lines.empty() ? "" : "; ") + chart.y.title + " / " + chart.x.title + ":";
    for (const ChartSeries& series : chart.series) {
      if (series.name.empty()) {
        continue;
      }
      lines += " " + series.name + (series.note.empty() ? "," : " " + series.note + ",");
    }
  }
  return {title, lines};
}

void write_chart_svg(std::ostream& out, const std::vector<LineChart>& charts,
                     const ChartPage& page) {
  const auto [title, lines] = description_of(charts);
  SvgDevice svg(out, page.width, page.height, charts.front().style.font, title, lines);
  const double each = page.height / static_cast<double>(charts.size());
  for (std::size_t k = 0; k < charts.size(); ++k) {
    svg.move_origin({0, each * static_cast<double>(k)});
    const std::array corners{ChartPoint{0, 0}, ChartPoint{page.width, 0},
                             ChartPoint{page.width, each}, ChartPoint{0, each}};
    svg.fill(corners, charts[k].style.paper);
    draw_chart(charts[k], page.width, each, svg);
  }
}

void write_chart_pdf(std::ostream& out, const std::vector<LineChart>& charts,
                     const ChartPage& page) {
  write_pdf(out, page.width, page.height, charts.front().title,
            [&](cairo_t* cairo) { paint(cairo, charts, page.width, page.height); });
}

void write_chart_png(std::ostream& out, const std::vector<LineChart>& charts,
                     const ChartPage& page) {
  const CairoSurface surface = make_surface(static_cast<int>(page.width * page.scale),
                                            static_cast<int>(page.height * page.scale));
  paint(surface.get(), charts, page.width, page.height, page.scale);
  write_png(out, surface.get());
}

using ChartWriter = void (*)(std::ostream&, const std::vector<LineChart>&, const ChartPage&);

ChartWriter chart_writer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".svg") {
    return write_chart_svg;
  }
  if (ending == ".pdf") {
    return write_chart_pdf;
  }
  if (ending == ".png") {
    return write_chart_png;
  }
  throw InputError(
      fmt::format("{}: the name of a plot must end in .svg, .pdf or .png", path.string()));
}

}  // namespace

ChartArea paint_chart(const LineChart& chart, const ChartPixels& pixels, double scale) {
  const CairoSurface surface(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.first),
                                          CAIRO_FORMAT_RGB24, pixels.width, pixels.height,
                                          pixels.stride * static_cast<int>(sizeof(std::uint32_t))),
      cairo_surface_destroy);
  check_drawn(cairo_surface_status(surface.get()));
  const ChartArea area =
      paint(surface.get(), {chart}, pixels.width / scale, pixels.height / scale, scale);
  cairo_surface_flush(surface.get());
  return area;
}

void draw_chart(const LineChart& chart, double width, double height, ChartDevice& device) {
  const CairoContext cairo = make_measuring_context();
  paint_chart(cairo.get(), chart, width, height, &device);
  check_drawn(cairo_status(cairo.get()));
}

void check_chart_path(const std::filesystem::path& path) {
  chart_writer_for(path);
  check_writable(path);
}

void write_charts(const std::filesystem::path& path, const std::vector<LineChart>& charts,
                  const ChartPage& page) {
  const ChartWriter write = chart_writer_for(path);
  write_file_whole(path, [&](std::ostream& out) { write(out, charts, page); });
}

}  // namespace transillum
