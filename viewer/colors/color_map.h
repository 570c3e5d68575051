// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "io/pictures/color_map.h"

namespace transillum::viewer {

/// sRGB.
using Color8 = ColorBytes;

/// The color of values of 0 where they are marked. No color map contains it.
inline constexpr Color8 zero_color{0xbf, 0xc9, 0xd6};
/// The color of patches that are omitted, whose value is not a number.
inline constexpr Color8 omitted_color{0x6e, 0x73, 0x7a};

}  // namespace transillum::viewer
