// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>
#include <png.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/pictures/picture_writers.h"
#include "io/srgb.h"

namespace transillum {

void write_picture_png(std::ostream& out, const Picture& picture, const PictureLook& look) {
  std::vector<unsigned char> bytes;
  bytes.reserve(3 * picture.radiance.size());
  for (const Rgb& radiance : picture.radiance) {
    const Rgb color = shown_color(radiance, look);
    for (const double channel : {color.r, color.g, color.b}) {
      bytes.push_back(static_cast<unsigned char>(srgb_byte(channel)));
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string file(size, '\0');
  if (png_image_write_to_memory(&image, file.data(), &size, 0, bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error(fmt::format("picture: {}", image.message));
  }
  out.write(file.data(), static_cast<std::streamsize>(size));
}

}  // namespace transillum
