// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/drawing/cairo_surface.h"

#include <fmt/format.h>

#include <ostream>
#include <stdexcept>

namespace transillum {

CairoSurface make_surface(int width, int height) {
  return {cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy};
}

void check_drawn(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(fmt::format("drawing failed: {}", cairo_status_to_string(status)));
  }
}

cairo_status_t append_to_stream(void* out, const unsigned char* data, unsigned length) {
  static_cast<std::ostream*>(out)->write(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void write_png(std::ostream& out, cairo_surface_t* picture) {
  cairo_surface_flush(picture);
  check_drawn(cairo_surface_write_to_png_stream(picture, append_to_stream, &out));
}

}  // namespace transillum
