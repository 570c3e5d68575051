// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Line charts as SVG or PNG files, or painted into pixels in memory.
#include <cairo-svg.h>
#include <fmt/format.h>

#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "io/clean_text.h"
#include "io/file_ending.h"
#include "io/vtk/chart_painter.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/line_chart.h"

namespace transillum {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Context = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("chart: drawing failed: {}", cairo_status_to_string(status)));
  }
}

/// Paints charts one below the other, of equal height, on a surface of `width` by `height` units;
/// `scale`: pixels per unit. Returns the plot area of the last.
ChartArea paint(cairo_surface_t* surface, const std::vector<LineChart>& charts, double width,
                double height, double scale) {
  const Context cairo(cairo_create(surface), cairo_destroy);
  const double each = height / static_cast<double>(charts.size());
  ChartArea area;
  cairo_scale(cairo.get(), scale, scale);
  for (const LineChart& chart : charts) {
    const ChartColor& paper = chart.style.paper;
    cairo_set_source_rgb(cairo.get(), paper.red / 255.0, paper.green / 255.0, paper.blue / 255.0);
    cairo_rectangle(cairo.get(), 0, 0, width, each);
    cairo_fill(cairo.get());
    area = paint_chart(cairo.get(), chart, width, each);
    cairo_translate(cairo.get(), 0, each);
  }
  check(cairo_status(cairo.get()));
  return area;
}

cairo_status_t append(void* out, const unsigned char* data, unsigned length) {
  static_cast<std::ostream*>(out)->write(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;  // the stream records its own failure
}

/// Title and description for screen readers: the letters of the drawing are outlines.
std::string description_of(const std::vector<LineChart>& charts) {
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
  return fmt::format("<title>{}</title>\n<desc>{}</desc>\n", xml_text(title), xml_text(lines));
}

void write_svg(std::ostream& out, const std::vector<LineChart>& charts, const ChartPage& page) {
  std::ostringstream drawing;
  const Surface surface(
      cairo_svg_surface_create_for_stream(append, &drawing, page.width, page.height),
      cairo_surface_destroy);
  paint(surface.get(), charts, page.width, page.height, 1);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  std::string svg = std::move(drawing).str();
  svg.insert(svg.find('\n', svg.find("<svg")) + 1, description_of(charts));
  out << svg;
}

void write_png(std::ostream& out, const std::vector<LineChart>& charts, const ChartPage& page) {
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(page.width * page.scale),
                                 static_cast<int>(page.height * page.scale)),
      cairo_surface_destroy);
  paint(surface.get(), charts, page.width, page.height, page.scale);
  cairo_surface_flush(surface.get());
  check(cairo_surface_write_to_png_stream(surface.get(), append, &out));
}

using ChartWriter = void (*)(std::ostream&, const std::vector<LineChart>&, const ChartPage&);

ChartWriter chart_writer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".svg") {
    return write_svg;
  }
  if (ending == ".png") {
    return write_png;
  }
  throw InputError(fmt::format("{}: the name of a plot must end in .svg or .png", path.string()));
}

}  // namespace

ChartArea paint_chart(const LineChart& chart, const ChartPixels& pixels, double scale) {
  const Surface surface(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.first),
                                          CAIRO_FORMAT_RGB24, pixels.width, pixels.height,
                                          pixels.stride * static_cast<int>(sizeof(std::uint32_t))),
      cairo_surface_destroy);
  check(cairo_surface_status(surface.get()));
  const ChartArea area =
      paint(surface.get(), {chart}, pixels.width / scale, pixels.height / scale, scale);
  cairo_surface_flush(surface.get());
  return area;
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
