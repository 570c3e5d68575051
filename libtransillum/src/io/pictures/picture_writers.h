// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cmath>
#include <cstddef>
#include <iosfwd>
#include <vector>

#include "transillum/files.h"
#include "transillum/picture.h"

namespace transillum {

// One writer per format of write_picture(). The picture has its pixels.

void write_picture_png(std::ostream& out, const Picture& picture, const PictureLook& look);
void write_picture_exr(std::ostream& out, const Picture& picture);
void write_picture_pfm(std::ostream& out, const Picture& picture);

/// The colors of a picture's pixels, row by row from the top: three bytes each, or four with alpha
/// where the picture has coverage.
/// @param add  appends the three bytes of a radiance to the colors
template <class Add>
std::vector<unsigned char> pixel_colors(const Picture& picture, Add add) {
  std::vector<unsigned char> bytes;
  bytes.reserve((picture.coverage.empty() ? 3 : 4) * picture.radiance.size());
  for (std::size_t k = 0; k < picture.radiance.size(); ++k) {
    if (picture.coverage.empty()) {
      add(picture.radiance[k], bytes);
      continue;
    }
    const float covered = picture.coverage[k];
    add(covered > 0 ? 1 / covered * picture.radiance[k] : Rgb(), bytes);
    bytes.push_back(static_cast<unsigned char>(std::lround(255 * covered)));
  }
  return bytes;
}
/// sRGB, as pixel_colors()
std::vector<unsigned char> screen_colors(const Picture& picture, const PictureLook& look);
/// @throws InputError unless the picture has a color for each pixel
void check_pixels(const Picture& picture);

}  // namespace transillum
