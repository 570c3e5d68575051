// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/drawing/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/round_step.h"
#include "geometry/luminance.h"
#include "io/drawing/chart_canvas.h"
#include "io/pictures/color_map.h"

namespace transillum {
namespace {

std::string tick_text(double tick) { return fmt::format("{:.6g}", tick); }

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

double scale_text_size(double picture_height) {
  constexpr double smallest = 11, largest = 32;
  return std::clamp(picture_height / 40, smallest, largest);
}

ColorBar::ColorBar(const FalseColors& colors, double text_size)
    : unit_(colors.lux ? lumens_per_watt : 1),
      highest_(unit_ * colors.highest),
      title_(colors.lux ? "illuminance, lx" : "radiosity B, W/m²"),
      size_(text_size),
      ticks_(color_bar_ticks(highest_)) {}

double ColorBar::fraction_of(const Rgb& radiance) const {
  return std::numbers::pi * unit_ * luminance(radiance) / highest_;
}

double ColorBar::width(ChartCanvas& canvas) const {
  double labels = 0;
  for (const double tick : ticks_) {
    labels = std::max(labels, canvas.width_of(tick_text(tick), look()));
  }
  return std::ceil(label_left() + labels + 2.8 * size_);
}

double ColorBar::least_height(ChartCanvas& canvas) const {
  return std::ceil(canvas.width_of(title_, look()) + 2 * size_);
}

void ColorBar::draw(ChartCanvas& canvas, const ChartArea& area) const {
  const double top = std::round(area.top + 1.5 * size_);
  const double bottom = std::round(area.bottom - 1.5 * size_);
  const double bar_left = std::round(area.left + size_);
  const double bar_right = std::round(area.left + 2.5 * size_);
  const int rows = static_cast<int>(bottom - top);
  for (int row = 0; row < rows; ++row) {
    const double y = top + row;
    const auto [red, green, blue] =
        color_of(default_color_map, (bottom - y - 0.5) / (bottom - top));
    // The next row covers the overlap, which leaves no gap where vectors are drawn as pixels.
    canvas.fill({bar_left, y, bar_right, std::min(y + 2, bottom)}, {red, green, blue});
  }
  for (const double tick : ticks_) {
    const double y = bottom - tick / highest_ * (bottom - top);
    canvas.draw(std::array{ChartPoint{bar_right, y}, ChartPoint{bar_right + 0.5 * size_, y}},
                {scale_ink, size_ / 12});
    canvas.draw(tick_text(tick), {area.left + label_left(), y}, 0, look());
  }
  canvas.draw(title_, {area.right - 1.2 * size_, (top + bottom) / 2}, 0.5, look(), true);
}

}  // namespace transillum
