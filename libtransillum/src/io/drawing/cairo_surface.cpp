// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/drawing/cairo_surface.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <ostream>
#include <stdexcept>

#include "io/text.h"

namespace transillum {
namespace {

/// A function for Cairo's writers to streams; `out` is a std::ostream, which records its failures.
cairo_status_t append_to_stream(void* out, const unsigned char* data, unsigned length) {
  static_cast<std::ostream*>(out)->write(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

CairoSurface make_surface(int width, int height, bool transparent) {
  return {cairo_image_surface_create(transparent ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, width,
                                     height),
          cairo_surface_destroy};
}

CairoContext make_measuring_context() {
  const CairoSurface surface = make_surface(1, 1);  // which the context keeps
  CairoContext cairo(cairo_create(surface.get()), cairo_destroy);
  cairo_set_tolerance(cairo.get(), 0.02);  // flattens circles
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo.get(), options);
  cairo_font_options_destroy(options);
  return cairo;
}

void check_drawn(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(fmt::format("drawing failed: {}", cairo_status_to_string(status)));
  }
}

void write_png(std::ostream& out, cairo_surface_t* picture) {
  cairo_surface_flush(picture);
  check_drawn(cairo_surface_write_to_png_stream(picture, append_to_stream, &out));
}

void write_pdf(std::ostream& out, double width, double height, const std::string& title,
               const std::function<void(cairo_t*)>& draw) {
  constexpr double points = 0.75;
  const CairoSurface surface(
      cairo_pdf_surface_create_for_stream(append_to_stream, &out, points * width, points * height),
      cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE,
                                 clean_text(title).c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR,
                                 "transillum " TRANSILLUM_VERSION);
  {
    const CairoContext cairo(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(cairo.get(), points, points);
    draw(cairo.get());
    check_drawn(cairo_status(cairo.get()));
  }
  cairo_surface_finish(surface.get());
  check_drawn(cairo_surface_status(surface.get()));
}

}  // namespace transillum
