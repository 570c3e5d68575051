// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures in false colors: the picture at the left, its scale at the right, drawn by Cairo.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <string>

#include "base/round_step.h"
#include "geometry/luminance.h"
#include "io/drawing/cairo_surface.h"
#include "io/drawing/chart_canvas.h"
#include "io/drawing/color_bar.h"
#include "io/pictures/color_map.h"
#include "io/pictures/picture_writers.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/picture.h"

namespace transillum {
namespace {

constexpr ChartColor ink{26, 26, 31}, paper{255, 255, 255};
constexpr const char* scale_font = "DejaVu Sans";
constexpr double smallest_text = 11, largest_text = 32;

/// A scale beside a picture. Lengths are in pixels.
class ColorBar {
 public:
  ColorBar(const FalseColors& colors, int picture_height)
      : unit_(colors.lux ? lumens_per_watt : 1),
        highest_(unit_ * colors.highest),
        title_(colors.lux ? "illuminance, lx" : "radiosity B, W/m²"),
        size_(std::clamp(picture_height / 40.0, smallest_text, largest_text)),
        ticks_(color_bar_ticks(highest_)) {}

  /// From the lower end, 0, to the upper end, 1.
  double fraction_of(const Rgb& radiance) const {
    return std::numbers::pi * unit_ * luminance(radiance) / highest_;
  }
  int width(ChartCanvas& canvas) const {
    double labels = 0;
    for (const double tick : ticks_) {
      labels = std::max(labels, canvas.width_of(text(tick), look()));
    }
    return static_cast<int>(std::ceil(label_left() + labels + 2.8 * size_));
  }
  /// Room for the title.
  int least_height(ChartCanvas& canvas) const {
    return static_cast<int>(std::ceil(canvas.width_of(title_, look()) + 2 * size_));
  }
  void draw(ChartCanvas& canvas, double left, double width, double height) const {
    const double top = std::round(1.5 * size_), bottom = std::round(height - 1.5 * size_);
    const double bar_left = std::round(left + size_), bar_right = std::round(left + 2.5 * size_);
    canvas.fill({left, 0, left + width, height}, paper);
    const int rows = static_cast<int>(bottom - top);
    for (int row = 0; row < rows; ++row) {
      const double y = top + row;
      const auto [red, green, blue] =
          color_of(default_color_map, (bottom - y - 0.5) / (bottom - top));
      canvas.fill({bar_left, y, bar_right, y + 1}, {red, green, blue});
    }
    for (const double tick : ticks_) {
      const double y = bottom - tick / highest_ * (bottom - top);
      canvas.draw(std::array{ChartPoint{bar_right, y}, ChartPoint{bar_right + 0.5 * size_, y}},
                  {ink, size_ / 12});
      canvas.draw(text(tick), {left + label_left(), y}, 0, look());
    }
    canvas.draw(title_, {left + width - 1.2 * size_, (top + bottom) / 2}, 0.5, look(), true);
  }

 private:
  static std::string text(double tick) { return fmt::format("{:.6g}", tick); }
  double label_left() const { return 3.3 * size_; }
  ChartText look() const { return {size_, ink}; }

  double unit_, highest_;  ///< per W/m², and in that unit
  std::string title_;
  double size_;  ///< height of the font
  std::vector<double> ticks_;
};

/// Sets the pixels of the left upper part of a surface.
void paint(cairo_surface_t* surface, const Picture& picture, const ColorBar& bar) {
  cairo_surface_flush(surface);
  unsigned char* bytes = cairo_image_surface_get_data(surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
  std::size_t next = 0;
  for (int y = 0; y < picture.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + y * stride);
    for (int x = 0; x < picture.width; ++x) {
      const auto [red, green, blue] =
          color_of(default_color_map, bar.fraction_of(picture.radiance[next++]));
      row[x] = std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | blue;
    }
  }
  cairo_surface_mark_dirty(surface);
}

void write_false_colors_png(std::ostream& out, const Picture& picture, const FalseColors& colors) {
  const ColorBar bar(colors, picture.height);
  int width = 0, height = 0;
  {
    const CairoSurface any = make_surface(1, 1);
    const CairoContext cairo(cairo_create(any.get()), cairo_destroy);
    ChartCanvas canvas(cairo.get(), scale_font);
    width = bar.width(canvas);
    height = std::max(picture.height, bar.least_height(canvas));
  }
  const CairoSurface surface = make_surface(picture.width + width, height);
  check_drawn(cairo_surface_status(surface.get()));
  const CairoContext cairo(cairo_create(surface.get()), cairo_destroy);
  ChartCanvas canvas(cairo.get(), scale_font);
  canvas.fill({0, 0, static_cast<double>(picture.width), static_cast<double>(height)}, paper);
  bar.draw(canvas, picture.width, width, height);
  check_drawn(cairo_status(cairo.get()));
  paint(surface.get(), picture, bar);
  write_png(out, surface.get());
}

}  // namespace

std::vector<double> color_bar_ticks(double highest) {
  constexpr int about = 6;
  const double step = round_step(highest, about);
  std::vector<double> ticks;
  for (int k = 0; k * step <= highest * (1 + 1e-9); ++k) {
    ticks.push_back(k * step);
  }
  return ticks;
}

void write_false_colors(const std::filesystem::path& path, const Picture& picture,
                        const FalseColors& colors) {
  if (!is_screen_picture(path)) {
    throw InputError(
        fmt::format("{}: the name of a picture in false colors must end in .png", path.string()));
  }
  check_writable(path);
  check_pixels(picture);
  colors.validate();
  write_file_whole(path, [&](std::ostream& out) { write_false_colors_png(out, picture, colors); });
}

}  // namespace transillum
