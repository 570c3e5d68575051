// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/visibility_map.h"

namespace transillum {

/// A point of the plane in steps of a PixelGrid from its window's corner. Determinants of such
/// points fit 64 bits, so what lies on which side of an edge is exact; and points that are one in
/// space are one here.
struct PixelPoint {
  std::int64_t x = 0, y = 0;
};

/// The box round all patches of a scene on a plane.
struct PlaneWindow {
  Vec2 low, high;

  Vec2 size() const { return {high.x - low.x, high.y - low.y}; }
};
PlaneWindow plane_window(const Scene& scene, const PlaneFrame& frame);

/// The window of a transillumination plane in square pixels: the box round the projected scene,
/// its longer side `resolution` pixels long (paper, section 2).
class PixelGrid {
 public:
  PixelGrid(const Scene& scene, const Vec3& omega, int resolution);

  const PlaneFrame& frame() const { return frame_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Of a pixel, meters.
  double side() const { return side_; }
  /// Of a pixel, m²: of so few digits that whole multiples and their sums are exact.
  double area() const { return area_; }
  /// A pixel is 2^bits() steps wide, as many as coordinates below 2^30 allow.
  int bits() const { return bits_; }
  std::int64_t one() const { return std::int64_t{1} << bits_; }
  /// The first pixel whose center is at `at` or beyond, along either axis; and a pixel's center.
  int first_center_from(std::int64_t at) const {
    return static_cast<int>((at + one() / 2 - 1) >> bits_);
  }
  std::int64_t center_of(int pixel) const { return pixel * one() + one() / 2; }
  /// How far snapped points may be from where they were, meters.
  double snapping() const { return side_ / static_cast<double>(one()); }
  /// The corner of pixel 0, 0.
  const Vec2& corner() const { return corner_; }
  Vec2 center(int column, int row) const {
    return {corner_.x + (column + 0.5) * side_, corner_.y + (row + 0.5) * side_};
  }
  PixelPoint snapped(const Vec3& p) const;
  std::vector<PixelPoint> snapped(const std::vector<Vec3>& points) const;

 private:
  PlaneFrame frame_;
  Vec2 corner_{};
  int columns_ = 1, rows_ = 1, bits_ = 1;
  double side_ = 1, area_ = 1;
};

}  // namespace transillum
