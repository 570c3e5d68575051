// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Maps as PNG: an anti-aliased rasterizer for the convex polygons and lines of a map. Cairo draws
// the labels over it and encodes it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/drawing/cairo_surface.h"
#include "io/drawing/chart_canvas.h"
#include "io/drawing/map_label.h"
#include "io/maps/map_drawing.h"
#include "io/maps/map_figure.h"
#include "io/maps/map_writers.h"
#include "io/png_text.h"
#include "io/text.h"

namespace transillum {
namespace {

/// An image that accumulates per pixel how much is covered, and by what color.
///
/// The polygons of a map do not overlap, so coverage times color can be summed, and the background
/// does not show between two neighbors.
class Canvas {
 public:
  Canvas(int width, int height, bool transparent)
      : width_(width),
        height_(height),
        transparent_(transparent),
        pixels_(static_cast<std::size_t>(width) * height) {}

  void fill(std::span<const Vec2> outline, const Color8& color) {
    cover(outline, [&](std::size_t pixel, float fraction) {
      Pixel& target = pixels_[pixel];
      target.covered += fraction;
      target.r += fraction * static_cast<float>(color.r);
      target.g += fraction * static_cast<float>(color.g);
      target.b += fraction * static_cast<float>(color.b);
    });
  }

  /// Fills a polygon of the receiver's projection: background below all that fill() draws.
  void fill_window(std::span<const Vec2> outline) {
    cover(outline, [&](std::size_t pixel, float fraction) { pixels_[pixel].window += fraction; });
  }

  /// Fills a difference: above all but lines.
  void fill_difference(std::span<const Vec2> outline) {
    cover(outline,
          [&](std::size_t pixel, float fraction) { pixels_[pixel].difference += fraction; });
  }

  void draw_edges(std::span<const Vec2> outline, double line_width) {
    for (std::size_t k = 0; k < outline.size(); ++k) {
      draw_line(outline[k], outline[(k + 1) % outline.size()], line_width);
    }
  }

  void draw_line(const Vec2& a, const Vec2& b, double line_width) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) {
      return;
    }
    const double fraction = line_width / 2 / length;
    const Vec2 aside{fraction * (a.y - b.y), fraction * (b.x - a.x)};
    const std::array<Vec2, 4> bar{
        Vec2{a.x + aside.x, a.y + aside.y}, Vec2{b.x + aside.x, b.y + aside.y},
        Vec2{b.x - aside.x, b.y - aside.y}, Vec2{a.x - aside.x, a.y - aside.y}};
    cover(bar, [&](std::size_t pixel, float part) { pixels_[pixel].line += part; });
  }

  CairoSurface picture() const {
    CairoSurface surface = make_surface(width_, height_, transparent_);
    check_drawn(cairo_surface_status(surface.get()));
    unsigned char* bytes = cairo_image_surface_get_data(surface.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < height_; ++y) {
      auto* row = reinterpret_cast<std::uint32_t*>(bytes + y * stride);
      for (int x = 0; x < width_; ++x) {
        std::uint32_t color = 0;
        for (const float channel : finished(pixels_[index(x, y)])) {
          color =
              color << 8 | static_cast<std::uint32_t>(std::clamp(std::lround(channel), 0L, 255L));
        }
        row[x] = color;
      }
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
  }

 private:
  struct Pixel {
    float covered = 0, r = 0, g = 0, b = 0;
    float window = 0, difference = 0, line = 0;
  };
  /// Sampling lines per pixel; along them, coverage is exact.
  static constexpr int scan_lines = 8;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  /// Calls add(pixel index, share) for each pixel that a convex polygon touches and the fraction of
  /// it covered. A pixel's share may come in several calls.
  template <typename Add>
  void cover(std::span<const Vec2> outline, Add add) const {
    double top = HUGE_VAL, bottom = -HUGE_VAL;
    for (const Vec2& p : outline) {
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    const auto first = static_cast<int>(std::ceil(std::max(top, 0.0) * scan_lines - 0.5));
    const int end = height_ * scan_lines;
    for (int line = first; line < end && line + 0.5 < bottom * scan_lines; ++line) {
      const auto [left, right] = crossing(outline, (line + 0.5) / scan_lines);
      cover_span(line / scan_lines, std::max(left, 0.0),
                 std::min(right, static_cast<double>(width_)), add);
    }
  }

  /// Where the line at height y enters and leaves a convex polygon.
  static std::pair<double, double> crossing(std::span<const Vec2> outline, double y) {
    double left = HUGE_VAL, right = -HUGE_VAL;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
      if ((a.y > y) == (b.y > y)) {
        continue;
      }
      // Compute from the upper end, so that both neighbors at an edge get the same crossing.
      const Vec2 &upper = a.y < b.y ? a : b, &lower = a.y < b.y ? b : a;
      const double x = upper.x + (y - upper.y) / (lower.y - upper.y) * (lower.x - upper.x);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    return {left, right};
  }

  template <typename Add>
  void cover_span(int y, double left, double right, Add add) const {
    for (int x = static_cast<int>(left); x < width_ && x < right; ++x) {
      const double part = std::min(right, x + 1.0) - std::max(left, static_cast<double>(x));
      add(index(x, y), static_cast<float>(part / scan_lines));
    }
  }

  /// Alpha, and colors premultiplied by alpha.
  std::array<float, 4> finished(const Pixel& pixel) const {
    constexpr float line_opacity = 0.6F;
    const float ground = std::max(1 - pixel.covered, 0.0F);
    const float line = line_opacity * std::min(pixel.line, 1.0F);
    const float window = std::min(pixel.window, 1.0F);
    const float difference =
        static_cast<float>(map_colors::difference_opacity) * std::min(pixel.difference, 1.0F);
    const auto mixed = [&](float drawn_sum, auto value_of) {
      const float below = transparent_ ? 0 : value_of(map_colors::ground);
      const float under = (1 - window) * below + window * value_of(map_colors::nothing);
      const float drawn = drawn_sum + ground * under;
      const float filled = drawn + difference * (value_of(map_colors::difference) - drawn);
      return filled + line * (value_of(map_colors::edge) - filled);
    };
    const float alpha = transparent_ ? mixed(255 * std::min(pixel.covered, 1.0F),
                                             [](const Color8&) { return 255.0F; })
                                     : 255.0F;
    const auto channel = [&](float Pixel::*sum, std::uint8_t Color8::*part) {
      const auto value_of = [&](const Color8& color) { return static_cast<float>(color.*part); };
      return std::min(mixed(pixel.*sum, value_of), alpha);
    };
    return {alpha, channel(&Pixel::r, &Color8::r), channel(&Pixel::g, &Color8::g),
            channel(&Pixel::b, &Color8::b)};
  }

  int width_, height_;
  bool transparent_;
  std::vector<Pixel> pixels_;
};

/// A chunk of text of a PNG file: Latin-1 where ASCII suffices, else UTF-8, without compression.
std::string text_chunk(const std::string& key, const std::string& text) {
  const bool is_ascii = std::all_of(text.begin(), text.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  return is_ascii ? png_chunk("tEXt", key + '\0' + text)
                  : png_chunk("iTXt", key + std::string(5, '\0') + text);
}

/// Title and description as chunks of text.
std::string map_description(const std::string& title, const VisibilityMap& map, double scale) {
  const Vec3& omega = map.frame.omega;
  return text_chunk("Software", "transillum " TRANSILLUM_VERSION) + text_chunk("Title", title) +
         text_chunk(
             "Description",
             fmt::format("direction omega = {}, {}, {}; view along omega{}; {} pixels per meter{}",
                         omega.x, omega.y, omega.z,
                         map.receiver == no_patch ? std::string(" from below")
                                                  : fmt::format(" from patch {}", map.receiver),
                         scale,
                         map.pixels.side > 0
                             ? fmt::format("; the engine's pixels are {} m wide", map.pixels.side)
                             : std::string()));
}

/// Draws polygons and lines.
void draw_map(Canvas& canvas, const Scene& scene, const VisibilityMap& map,
              const MapPictureOptions& options, const MapTransform& transform) {
  std::vector<Vec2> outline;
  const auto projected = [&](const VisibilityMap::Polygon& polygon) -> std::span<const Vec2> {
    outline.clear();
    for (const Vec2& p : map.outline(polygon)) {
      outline.push_back(transform.to_pixels(p));
    }
    return outline;
  };
  for (const auto& polygon : map.window) {
    canvas.fill_window(projected(polygon));
  }
  for (const auto& polygon : map.polygons) {
    canvas.fill(projected(polygon), color_of(scene, polygon, options));
  }
  for (const auto& polygon : map.pixels.differences) {
    canvas.fill_difference(projected(polygon));
  }
  const double width = line_width(map, transform.scale);
  if (map.pixels.side > 0) {
    const std::vector<Vec2>& ends = map.pixels.borders;
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      canvas.draw_line(transform.to_pixels(ends[k]), transform.to_pixels(ends[k + 1]), width);
    }
  } else {
    for (const auto& polygon : map.polygons) {
      canvas.draw_edges(projected(polygon), width);
    }
  }
}

/// A picture below a title on white paper, or on none.
CairoSurface below_title(cairo_surface_t* picture, const MapPictureOptions& options,
                         const std::string& title, double text_size, int title_height) {
  const int width = cairo_image_surface_get_width(picture);
  CairoSurface page = make_surface(width, title_height + cairo_image_surface_get_height(picture),
                                   options.transparent);
  check_drawn(cairo_surface_status(page.get()));
  const CairoContext cairo(cairo_create(page.get()), cairo_destroy);
  ChartCanvas canvas(cairo.get(), label_font);
  const ChartText look{text_size, map_title_ink, true};
  if (!options.transparent) {
    canvas.fill({0, 0, 1.0 * width, 1.0 * title_height}, {255, 255, 255});
  }
  const double margin = text_size / 2;
  canvas.draw(canvas.elided(title, width - 2 * margin, look), {margin, title_height / 2.0}, 0,
              look);
  cairo_set_source_surface(cairo.get(), picture, 0, title_height);
  cairo_paint(cairo.get());
  check_drawn(cairo_status(cairo.get()));
  return page;
}

}  // namespace

void write_map_png(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options) {
  const std::string title = clean_text(options.title.value_or(""));
  const double inch = options.pixels_per_inch > 0 ? options.pixels_per_inch : 96;
  const double text_size = MapFigure::title_size * inch / 96;
  const int title_height = title.empty() ? 0 : static_cast<int>(std::ceil(2 * text_size));
  const MapLayout layout = fit_map(map, options.size, options.size - title_height);
  Canvas canvas(static_cast<int>(std::lround(layout.width)),
                static_cast<int>(std::lround(layout.height)), options.transparent);
  draw_map(canvas, scene, map, options, layout.transform);
  CairoSurface picture = canvas.picture();
  {
    const CairoContext cairo(cairo_create(picture.get()), cairo_destroy);
    for (const PlacedLabel& label :
         place_labels(options.labels, layout.transform, 0, layout.width)) {
      draw_map_label(cairo.get(), label);
    }
    check_drawn(cairo_status(cairo.get()));
  }
  if (!title.empty()) {
    picture = below_title(picture.get(), options, title, text_size, title_height);
  }
  std::ostringstream png;
  write_png(png, picture.get());
  const std::string name = clean_text(options.title.value_or("Visibility map of " + scene.name()));
  out << png_with_chunks(png.str(), png_size_chunk(options.pixels_per_inch) +
                                        map_description(name, map, layout.transform.scale));
}

}  // namespace transillum
