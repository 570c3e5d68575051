// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

namespace transillum {

/// The bytes of a PNG file.
/// @param colors sRGB, three bytes a pixel, row by row from the top.
/// @throws std::runtime_error if libpng fails.
std::string png_of(int width, int height, const std::vector<unsigned char>& colors);

}  // namespace transillum
