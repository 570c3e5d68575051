// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/scene.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// A point of the plane in units of a PixelGrid from its window's corner. Determinants of such
/// points fit in 64 bits, so the side of an edge on which a point lies is exact; and points that
/// coincide in space coincide here.
struct PixelPoint {
  std::int64_t x = 0, y = 0;
};

/// The bounding box of all patches of a scene on a plane, meters.
struct PlaneWindow {
  Vec2 low, high;

  Vec2 size() const { return {high.x - low.x, high.y - low.y}; }
};
PlaneWindow plane_window(const Scene& scene, const PlaneFrame& frame);

/// The window of a transillumination plane, divided into square pixels: the bounding box of the
/// projected scene, its longer side `resolution` pixels long (section 2).
class PixelGrid {
 public:
  PixelGrid(const Scene& scene, const Vec3& omega, int resolution);

  const PlaneFrame& frame() const { return frame_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Side of a pixel, meters.
  double side() const { return side_; }
  /// Area of a pixel, m²: of 24 bits only, so that integer multiples and their sums are exact.
  double area() const { return area_; }
  /// A pixel is 2^bits() grid units wide: as many as keep coordinates below 2^30.
  int bits() const { return bits_; }
  std::int64_t units_per_pixel() const { return std::int64_t{1} << bits_; }
  /// The first pixel whose center is at `at` or beyond, along either axis; `at` in grid units.
  int first_center_from(std::int64_t at) const {
    return static_cast<int>((at + units_per_pixel() / 2 - 1) >> bits_);
  }
  /// A pixel's center along either axis, in grid units.
  std::int64_t center_of(int pixel) const {
    return pixel * units_per_pixel() + units_per_pixel() / 2;
  }
  /// Bound of the displacement of snapped points, meters.
  double snapping() const { return side_ / static_cast<double>(units_per_pixel()); }
  /// The lower left corner of pixel (0, 0), meters on the plane.
  const Vec2& corner() const { return corner_; }
  Vec2 center(int column, int row) const {
    return {corner_.x + (column + 0.5) * side_, corner_.y + (row + 0.5) * side_};
  }
  /// The projection of a point of space, rounded to grid units.
  PixelPoint snapped(const Vec3& p) const;
  std::vector<PixelPoint> snapped(const std::vector<Vec3>& points) const;

 private:
  PlaneFrame frame_;
  Vec2 corner_{};
  int columns_ = 1, rows_ = 1, bits_ = 1;
  double side_ = 1, area_ = 1;
};

/// Receives what a discrete engine finds at its sample points.
class VisibilitySink {
 public:
  virtual ~VisibilitySink() = default;
  /// In the pixels of `row` from column `begin` up to, not including, `end`, patch `below` is the
  /// next one below patch `above` (no_patch: `below` is the topmost). The calls for a pixel go from
  /// above downward, one per patch.
  virtual void record(int row, int begin, int end, PatchId below, PatchId above) = 0;
};

}  // namespace transillum
