// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace transillum::viewer {

/// sRGB.
using Color8 = std::array<std::uint8_t, 3>;

/// Perceptually uniform color maps: lightness increases evenly; in `diverging`, from blue to white
/// in the middle, and decreases to orange.
enum class ColorMap { viridis, cividis, inferno, diverging };
inline constexpr ColorMap default_color_map = ColorMap::viridis;
/// Display names of the maps except `diverging`, in the order of the enumeration.
const std::vector<std::string>& color_map_names();
/// The color of values of 0 where they are marked. No color map contains it.
inline constexpr Color8 zero_color{0xbf, 0xc9, 0xd6};
/// The color of patches that are omitted, whose value is not a number.
inline constexpr Color8 omitted_color{0x6e, 0x73, 0x7a};
/// Evenly spaced colors of a map, 2 to 16; linear interpolation between them.
std::span<const Color8> samples_of(ColorMap map);
/// @param t  clamped to [0,1]; 0 if not finite
Color8 color_of(ColorMap map, double t);

}  // namespace transillum::viewer
