// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Line charts as SVG, PDF or PNG files, or painted into pixels in memory.
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <ostream>
#include <sstream>

#include "base/text_file.h"
#include "io/drawing/cairo_surface.h"
#include "io/drawing/chart_canvas.h"
#include "io/drawing/line_chart.h"
#include "io/text.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// Paints charts one below the other, of equal height, on a surface of `width` by `height` units;
/// `scale`: pixels per unit. Returns the plot area of the last.
ChartArea paint(cairo_surface_t* surface, const std::vector<LineChart>& charts, double width,
                double height, double scale) {
  const CairoContext cairo(cairo_create(surface), cairo_destroy);
  const double each = height / static_cast<double>(charts.size());
  ChartArea area;
  cairo_scale(cairo.get(), scale, scale);
  for (const LineChart& chart : charts) {
    area = paint_chart(cairo.get(), chart, width, each);
    cairo_translate(cairo.get(), 0, each);
  }
  check_drawn(cairo_status(cairo.get()));
  return area;
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

void write_chart_svg(std::ostream& out, const std::vector<LineChart>& charts,
                     const ChartPage& page) {
  std::ostringstream drawing;
  const CairoSurface surface(
      cairo_svg_surface_create_for_stream(append_to_stream, &drawing, page.width, page.height),
      cairo_surface_destroy);
  paint(surface.get(), charts, page.width, page.height, 1);
  cairo_surface_finish(surface.get());
  check_drawn(cairo_surface_status(surface.get()));
  std::string svg = std::move(drawing).str();
  svg.insert(svg.find('\n', svg.find("<svg")) + 1, description_of(charts));
  out << svg;
}

void write_chart_pdf(std::ostream& out, const std::vector<LineChart>& charts,
                     const ChartPage& page) {
  constexpr double points = 0.75;  // per pixel of a screen with scale 1, as in CSS
  const CairoSurface surface(cairo_pdf_surface_create_for_stream(
                                 append_to_stream, &out, points * page.width, points * page.height),
                             cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE,
                                 charts.front().title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR,
                                 "transillum " TRANSILLUM_VERSION);
  paint(surface.get(), charts, page.width, page.height, points);
  cairo_surface_finish(surface.get());
  check_drawn(cairo_surface_status(surface.get()));
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
  const CairoSurface surface = make_surface(1, 1);
  const CairoContext cairo(cairo_create(surface.get()), cairo_destroy);
  // Flattens circles; sizes of texts are those without a grid of pixels.
  cairo_set_tolerance(cairo.get(), 0.02);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo.get(), options);
  cairo_font_options_destroy(options);
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
