// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace transillum::viewer {

using Color8 = std::array<std::uint8_t, 3>;

/// A perceptually uniform color map: its lightness grows evenly from dark to bright; that of
/// `diverging` grows from blue to white in the middle, and falls to orange.
enum class ColorMap { viridis, cividis, inferno, diverging };
/// Of those that grow lighter all the way.
const std::vector<std::string>& color_map_names();
/// @param t clamped to [0,1].
Color8 color_of(ColorMap map, double t);

}  // namespace transillum::viewer
