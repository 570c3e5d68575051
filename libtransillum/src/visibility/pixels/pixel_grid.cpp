// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pixels/pixel_grid.h"

#include <algorithm>
#include <cmath>

namespace transillum {
namespace {

/// `x` > 0 rounded up to 24 significant bits.
double rounded_up_to_24_bits(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return std::ldexp(std::ceil(std::ldexp(fraction, 24)), exponent - 24);
}

}  // namespace

PlaneWindow plane_window(const Scene& scene, const PlaneFrame& frame) {
  PlaneWindow window{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      const Vec2 at = frame.project(scene.point(p));
      window.low = {std::min(window.low.x, at.x), std::min(window.low.y, at.y)};
      window.high = {std::max(window.high.x, at.x), std::max(window.high.y, at.y)};
    }
  }
  return window;
}

PixelGrid::PixelGrid(const Scene& scene, const Vec3& omega, int resolution)
    : frame_(plane_frame(scene, omega)) {
  while (std::int64_t{resolution} << (bits_ + 1) <= 1 << 30) {
    ++bits_;
  }
  const PlaneWindow window = plane_window(scene, frame_);
  const Vec2 size = window.size();
  const double requested_side = std::max(size.x, size.y) / resolution;
  if (!(requested_side > 0)) {
    return;
  }
  area_ = rounded_up_to_24_bits(requested_side * requested_side);
  side_ = std::sqrt(area_);
  const auto pixels = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(length / side_), 1.0, 1.0 * resolution));
  };
  columns_ = pixels(size.x);
  rows_ = pixels(size.y);
  // The pixels cover slightly more than the window; center the excess.
  corner_ = {window.low.x - (columns_ * side_ - size.x) / 2,
             window.low.y - (rows_ * side_ - size.y) / 2};
}

PixelPoint PixelGrid::snapped(const Vec3& p) const {
  const Vec2 at = frame_.project(p);
  const auto units = [this](double length) {
    return static_cast<std::int64_t>(std::llround(std::ldexp(length / side_, bits_)));
  };
  return {units(at.x - corner_.x), units(at.y - corner_.y)};
}

std::vector<PixelPoint> PixelGrid::snapped(const std::vector<Vec3>& points) const {
  std::vector<PixelPoint> result;
  result.reserve(points.size());
  for (const Vec3& p : points) {
    result.push_back(snapped(p));
  }
  return result;
}

}  // namespace transillum
