// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/png_text.h"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>

namespace transillum {

std::string png_of(int width, int height, const std::vector<unsigned char>& colors) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, colors.data(), 0, nullptr) == 0) {
    throw std::runtime_error(fmt::format("PNG: {}", image.message));
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace transillum
