// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>
#include <vector>

#include "transillum/files.h"

namespace transillum {

// One writer per format of write_picture(). The picture has its pixels.

void write_picture_png(std::ostream& out, const Picture& picture, const PictureLook& look);
void write_picture_exr(std::ostream& out, const Picture& picture);
void write_picture_pfm(std::ostream& out, const Picture& picture);

/// sRGB, three bytes a pixel, row by row from the top.
std::vector<unsigned char> screen_colors(const Picture& picture, const PictureLook& look);
/// @throws InputError unless the picture has a color for each pixel
void check_pixels(const Picture& picture);

}  // namespace transillum
