// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <ostream>
#include <vector>

#include "io/pictures/picture_writers.h"
#include "io/png_text.h"
#include "io/srgb.h"
#include "transillum/picture.h"

namespace transillum {

std::vector<unsigned char> screen_colors(const Picture& picture, const PictureLook& look) {
  return pixel_colors(picture, [&](const Rgb& radiance, std::vector<unsigned char>& bytes) {
    const Rgb color = shown_color(radiance, look);
    for (const double channel : {color.r, color.g, color.b}) {
      bytes.push_back(static_cast<unsigned char>(srgb_byte(channel)));
    }
  });
}

void write_picture_png(std::ostream& out, const Picture& picture, const PictureLook& look) {
  out << png_of(picture.width, picture.height, screen_colors(picture, look));
}

}  // namespace transillum
