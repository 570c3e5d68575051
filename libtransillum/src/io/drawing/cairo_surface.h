// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cairo.h>

#include <iosfwd>
#include <memory>

namespace transillum {

using CairoSurface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using CairoContext = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

/// A surface of `width` by `height` pixels, 0x..rrggbb each.
CairoSurface make_surface(int width, int height);
/// @throws std::runtime_error if drawing has failed
void check_drawn(cairo_status_t status);
/// A function for Cairo's writers to streams; `out` is a std::ostream, which records its failures.
cairo_status_t append_to_stream(void* out, const unsigned char* data, unsigned length);
/// Writes a picture as PNG.
void write_png(std::ostream& out, cairo_surface_t* picture);

}  // namespace transillum
