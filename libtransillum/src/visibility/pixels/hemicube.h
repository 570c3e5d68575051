// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// The upper half of a cube of side 2 about a point of a patch (Cohen and Greenberg 1985): five
/// sides divided into pixels, each with the patch visible through its center and the form factor
/// from a small area at the point to it. Side 0 is the top, R by R pixels; 1 to 4 are the halves of
/// +x, +y, -x, -y above the plane, R by R/2. The pixels of a side are stored row by row: a along
/// the side, b upward.
class Hemicube {
 public:
  static constexpr int sides = 5;

  /// @param resolution R, even, > 0
  explicit Hemicube(int resolution);

  int resolution() const { return resolution_; }
  std::size_t pixel_count() const { return patches_.size(); }

  /// Delta form factor of each pixel: the exact integral over it. They sum to 1.
  const std::vector<double>& delta_form_factors() const { return delta_; }

  /// Removes all that was drawn.
  void clear();

  /// A convex polygon in the cube's frame, where the patch's normal is up.
  struct Polygon {
    std::span<const Vec3> corners;
    Vec3 normal;  ///< normal of its plane, normal·p = offset
    double offset;
    Vec3 center;  ///< center of a ball that contains it
    double radius;
    PatchId patch;  ///< no_patch: absorbs
  };
  /// Keeps the nearest polygon at each pixel; where depths agree within 1e-6, the one drawn later.
  void draw(const Polygon& polygon);

  /// The patch visible through each pixel's center: no_patch where there is none, or a back side.
  const std::vector<PatchId>& patches() const { return patches_; }

 private:
  struct Point {
    double a, b, depth;  ///< along the side, upward, along its axis
  };

  bool clip_to_side(int side);
  void fill(int side, const Vec3& inverse_depth, PatchId patch);

  int resolution_;
  std::array<std::size_t, sides> first_{};  ///< first pixel of each side
  std::vector<double> delta_;
  std::vector<float> inverse_depths_;  ///< per pixel
  std::vector<PatchId> patches_;
  std::vector<Point> polygon_, clipped_;
  std::vector<double> left_, right_;  ///< ends of the span per row, in pixels
};

}  // namespace transillum
