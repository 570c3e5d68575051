// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cairo.h>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

namespace transillum {

using CairoSurface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using CairoContext = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

/// A surface of `width` by `height` pixels, 0x..rrggbb each.
/// @param transparent  0xaarrggbb each, premultiplied by alpha
CairoSurface make_surface(int width, int height, bool transparent = false);
/// A context that measures texts, of sizes without a grid of pixels, and makes paths; not to draw.
CairoContext make_measuring_context();
/// @throws std::runtime_error if drawing has failed
void check_drawn(cairo_status_t status);
/// Writes a picture as PNG.
void write_png(std::ostream& out, cairo_surface_t* picture);
/// Writes a page of PDF.
/// @param width, height  pixels of a screen with scale 1, 3/4 of a point each, as in CSS
/// @param title  of the document, any bytes
/// @param draw  draws on the page, in these pixels
void write_pdf(std::ostream& out, double width, double height, const std::string& title,
               const std::function<void(cairo_t*)>& draw);

}  // namespace transillum
