// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace transillum {

/// sRGB.
using ColorBytes = std::array<std::uint8_t, 3>;

/// Perceptually uniform color maps: lightness increases evenly; in `diverging`, from blue to white
/// in the middle, and decreases to orange.
enum class ColorMap { viridis, cividis, inferno, diverging };
inline constexpr ColorMap default_color_map = ColorMap::viridis;
/// Evenly spaced colors of a map, 2 to 16; linear interpolation between them.
std::span<const ColorBytes> samples_of(ColorMap map);
/// @param t  clamped to [0,1]; 0 if not finite
ColorBytes color_of(ColorMap map, double t);

}  // namespace transillum
