// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/vec3.h"

namespace transillum {

/// Luminance of linear RGB by Rec. 709.
inline double luminance(const Rgb& color) {
  return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

/// Luminous flux of a watt, lm/W, where radiant quantities are converted to photometric ones.
inline constexpr double lumens_per_watt = 683;

}  // namespace transillum
