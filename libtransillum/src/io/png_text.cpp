// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/png_text.h"

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <cmath>
#include <stdexcept>

namespace transillum {
namespace {

std::string big_endian(std::size_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) {
    bytes += static_cast<char>(number >> shift & 0xff);
  }
  return bytes;
}

}  // namespace

std::string png_of(int width, int height, const std::vector<unsigned char>& colors) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image.format = colors.size() == 4 * pixels ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, colors.data(), 0, nullptr) == 0) {
    throw std::runtime_error(fmt::format("PNG: {}", image.message));
  }
  bytes.resize(size);
  return bytes;
}

std::string png_chunk(const std::string& type, const std::string& body) {
  const std::string checked = type + body;
  const uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size());
  return big_endian(body.size()) + checked + big_endian(crc);
}

std::string png_size_chunk(double pixels_per_inch) {
  if (pixels_per_inch == 0) {
    return {};
  }
  const std::string per_meter =
      big_endian(static_cast<std::size_t>(std::lround(pixels_per_inch / 0.0254)));
  return png_chunk("pHYs", per_meter + per_meter + '\1');
}

std::string png_with_chunks(const std::string& png, const std::string& chunks) {
  constexpr std::size_t header = 8 + 25;  // the signature and the first chunk
  return png.substr(0, header) + chunks + png.substr(header);
}

}  // namespace transillum
