// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cmath>

namespace transillum {

/// A linear value as sRGB, 0 to 255: the nearest, values outside of 0 to 1 clamped.
inline int srgb_byte(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * encoded));
}

}  // namespace transillum
