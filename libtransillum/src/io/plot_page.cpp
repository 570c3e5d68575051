// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/plot_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

namespace transillum {

PlotPage::PlotPage(cairo_surface_t* surface, double surface_width, double surface_height)
    : surface_(surface, cairo_surface_destroy), cairo_(cairo_create(surface), cairo_destroy) {
  set({1, 1, 1});
  cairo_paint(cairo());
  const double scale = std::min(surface_width / width, surface_height / height);
  cairo_translate(cairo(), (surface_width - scale * width) / 2,
                  (surface_height - scale * height) / 2);
  cairo_scale(cairo(), scale, scale);
  cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
  cairo_select_font_face(cairo(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
}

void PlotPage::clip(double x, double y, double w, double h) const {
  cairo_save(cairo());
  cairo_rectangle(cairo(), x, y, w, h);
  cairo_clip(cairo());
}

void PlotPage::unclip() const { cairo_restore(cairo()); }

void PlotPage::line(const std::vector<std::pair<double, double>>& points, const PlotColor& color,
                    double thickness, const std::vector<double>& dashes) const {
  cairo_new_path(cairo());  // text leaves a point
  for (const auto& [x, y] : points) cairo_line_to(cairo(), x, y);
  set(color);
  cairo_set_line_width(cairo(), thickness);
  cairo_set_dash(cairo(), dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_stroke(cairo());
  cairo_set_dash(cairo(), nullptr, 0, 0);
}

void PlotPage::text(const std::string& text, double x, double y, double size, double align,
                    double most) const {
  const double wide = width_of(text, size);
  cairo_set_font_size(cairo(), wide > most ? size * most / wide : size);
  set(ink);
  cairo_move_to(cairo(), x - align * std::min(wide, most), y);
  cairo_show_text(cairo(), text.c_str());
}

void PlotPage::text_upwards(const std::string& words, double x, double y, double size) const {
  cairo_save(cairo());
  cairo_translate(cairo(), x, y);
  cairo_rotate(cairo(), -std::numbers::pi / 2);
  text(words, 0, 0, size, 0.5);
  cairo_restore(cairo());
}

double PlotPage::width_of(const std::string& text, double size) const {
  cairo_set_font_size(cairo(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo(), text.c_str(), &extents);
  return extents.x_advance;
}

void PlotPage::marker(const PlotStyle& style, double x, double y) const {
  trace(style.marker, x, y);
  set(style.filled ? style.color : PlotColor{1, 1, 1});
  cairo_fill_preserve(cairo());
  set(style.color);
  cairo_set_line_width(cairo(), line_width);
  cairo_stroke(cairo());
}

void PlotPage::flush() const {
  cairo_surface_flush(surface_.get());
  check(cairo_status(cairo()));
  check(cairo_surface_status(surface_.get()));
}

void PlotPage::finish() const {
  cairo_surface_finish(surface_.get());
  check(cairo_status(cairo()));
  check(cairo_surface_status(surface_.get()));
}

void PlotPage::check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("the plot cannot be drawn: {}", cairo_status_to_string(status)));
  }
}

void PlotPage::trace(Marker marker, double x, double y) const {
  constexpr double s = marker_size, w = marker_size / 2.5;
  const auto outline = [&](std::initializer_list<std::pair<double, double>> corners) {
    for (const auto& [dx, dy] : corners) cairo_line_to(cairo(), x + dx, y + dy);
    cairo_close_path(cairo());
  };
  cairo_new_path(cairo());
  switch (marker) {
    case Marker::circle:
      cairo_arc(cairo(), x, y, s, 0, 2 * std::numbers::pi);
      break;
    case Marker::square:
      outline({{-s, -s}, {s, -s}, {s, s}, {-s, s}});
      break;
    case Marker::triangle:
      outline({{-1.2 * s, s}, {0, -1.2 * s}, {1.2 * s, s}});
      break;
    case Marker::diamond:
      outline({{-1.3 * s, 0}, {0, -1.3 * s}, {1.3 * s, 0}, {0, 1.3 * s}});
      break;
    case Marker::down:
      outline({{-1.2 * s, -s}, {0, 1.2 * s}, {1.2 * s, -s}});
      break;
    case Marker::cross:
      outline({{-s, -s + w},
               {-s + w, -s},
               {0, -w},
               {s - w, -s},
               {s, -s + w},
               {w, 0},
               {s, s - w},
               {s - w, s},
               {0, w},
               {-s + w, s},
               {-s, s - w},
               {-w, 0}});
      break;
    case Marker::plus:
      outline({{-w, -s},
               {w, -s},
               {w, -w},
               {s, -w},
               {s, w},
               {w, w},
               {w, s},
               {-w, s},
               {-w, w},
               {-s, w},
               {-s, -w},
               {-w, -w}});
      break;
  }
}

}  // namespace transillum
