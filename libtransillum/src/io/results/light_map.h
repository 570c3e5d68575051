// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "transillum/solution.h"

namespace transillum {

/// Radiosity as a picture, with a square of texels for each patch and the coordinates of its points
/// there. All texels of a square have the color of the patch, or of its linear function, and no
/// point lies within a texel of the square's border: linear filtering of the picture gives
/// this color and no other; of its first reduction too, where it is constant.
class LightMap {
 public:
  /// Texels along the side of a square.
  static constexpr std::size_t square = 4;
  /// Largest width and height of the picture.
  static constexpr std::size_t largest_side = 16384;

  /// The bounding box of a patch in its plane, and where its square is.
  struct Chart {
    Vec3 origin, s, t;  ///< s and t: unit vectors along the box
    double begin_s = 0, length_s = 1, begin_t = 0, length_t = 1;
    std::size_t column = 0, row = 0;
  };

  /// @param exposure linear color per radiosity, as DisplayOptions::exposure
  /// @throws InputError where there are too many patches
  LightMap(const Solution& solution, double exposure);

  std::size_t width() const { return square * columns_; }
  std::size_t height() const { return square * rows_; }
  Chart chart(PatchId patch) const;
  /// Texture coordinates of a point of the patch, from the upper left corner of the picture.
  std::array<float, 2> coordinates(const Chart& chart, const Vec3& point) const;
  /// The picture: 8 bits per channel, sRGB.
  std::string png() const;

 private:
  Rgb at_texel(PatchId i, std::size_t x, std::size_t y) const;

  const Solution& solution_;
  double exposure_;
  std::size_t columns_ = 1, rows_ = 1;
};

}  // namespace transillum
