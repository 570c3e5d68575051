// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// The upper half of a cube of side 2 about a point of a patch (Cohen and Greenberg 1985): five
/// sides of pixels, each with what is seen through its middle and the form factor of a small area
/// at the point to it. Side 0 is the top, R by R pixels; 1 to 4 are the halves of +x, +y, -x, -y
/// that lie above the plane, R by R/2. Pixel (a, b) of a side runs along the side, then upward.
class Hemicube {
 public:
  static constexpr int sides = 5;

  /// @param resolution R, even.
  explicit Hemicube(int resolution);

  int resolution() const { return resolution_; }
  std::size_t pixel_count() const { return patches_.size(); }

  /// Delta form factor of each pixel, the exact integral over it; they sum to 1.
  const std::vector<double>& delta_form_factors() const { return delta_; }

  /// Sees nothing any more.
  void clear();

  /// A convex polygon in the cube's frame, where the patch's normal is up.
  struct Polygon {
    std::span<const Vec3> corners;
    Vec3 normal;  ///< of its plane, normal·p = offset
    double offset;
    Vec3 center;  ///< of a ball round it
    double radius;
    PatchId patch;  ///< no_patch: absorbs
  };
  /// What is nearer at a pixel stays; of what is equally near to 1e-6 the later.
  void draw(const Polygon& polygon);

  /// What is seen through each pixel: no_patch where nothing is, or a back.
  const std::vector<PatchId>& patches() const { return patches_; }

 private:
  struct Point {
    double a, b, depth;  ///< along the side, upward, out of it
  };

  bool clip_to_side(int side);
  void fill(int side, const Vec3& inverse_depth, PatchId patch);

  int resolution_;
  std::array<std::size_t, sides> first_{};  ///< pixel of a side
  std::vector<double> delta_;
  std::vector<float> nearness_;  ///< a pixel: 1 / depth
  std::vector<PatchId> patches_;
  std::vector<Point> polygon_, clipped_;
  std::vector<double> left_, right_;  ///< a row's ends, pixels
};

}  // namespace transillum
