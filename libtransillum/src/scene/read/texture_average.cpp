// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The average color of a texture, read by libpng (whole, 8 bits a channel) or libjpeg (row by row).
#include "scene/read/texture_average.h"

// jpeglib.h requires <cstdio> before it.
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

#include <jpeglib.h>

namespace transillum {
namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;
constexpr const char* broken_image = "is a broken image";

std::string too_large(std::uint64_t width, std::uint64_t height) {
  return fmt::format("has {} x {} pixels; the limit is {}", width, height, most_pixels);
}

/// Linear light of each 8-bit value, by the transfer function of IEC 61966-2-1.
const std::array<double, 256>& srgb_table() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> linear{};
    for (std::size_t v = 0; v < linear.size(); ++v) {
      const double c = static_cast<double>(v) / 255;
      linear[v] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return linear;
  }();
  return table;
}

/// How often each value occurs in each channel, weighted by alpha (0 to 255): integers, so that an
/// image of one color has exactly that average.
struct Histogram {
  std::array<std::array<std::uint64_t, 256>, 3> counts;

  void add(std::array<std::uint8_t, 3> rgb, std::uint64_t alpha) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      counts[channel][rgb[channel]] += alpha;
    }
  }
  /// Empty if all pixels are transparent.
  std::optional<Rgb> average() const {
    std::array<double, 3> mean{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      double sum = 0, weight = 0;
      for (std::size_t v = 0; v < 256; ++v) {
        const auto count = static_cast<double>(counts[channel][v]);
        sum += count * srgb_table()[v];
        weight += count;
      }
      if (weight == 0) {
        return {};
      }
      mean[channel] = sum / weight;
    }
    return Rgb{mean[0], mean[1], mean[2]};
  }
};

TextureAverage color_of(const Histogram& histogram) {
  const std::optional<Rgb> color = histogram.average();
  return color ? TextureAverage{color, {}} : TextureAverage{{}, "has no opaque pixel"};
}

TextureAverage average_of_png(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> release(&image, png_image_free);
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    return {{}, broken_image};
  }
  if (image.height == 0 || image.width > most_pixels / image.height) {
    return {{}, too_large(image.width, image.height)};
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) {
    return {{}, broken_image};
  }
  Histogram histogram{};
  for (std::size_t p = 0; p + 3 < pixels.size(); p += 4) {
    histogram.add({pixels[p], pixels[p + 1], pixels[p + 2]}, pixels[p + 3]);
  }
  return color_of(histogram);
}

/// libjpeg reports errors by a function that must not return.
struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf on_error;
};

enum class JpegResult { read, broken, too_large };

/// Reads rows into the histogram. No variable here needs a destructor, since errors leave it by a
/// jump.
JpegResult read_jpeg(std::FILE* file, jpeg_decompress_struct& jpeg, JpegErrors& errors,
                     Histogram& histogram) {
  jpeg.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = [](j_common_ptr common) {
    std::longjmp(reinterpret_cast<JpegErrors*>(common->err)->on_error, 1);
  };
  errors.manager.output_message = [](j_common_ptr) {};
  if (setjmp(errors.on_error) != 0) {
    return JpegResult::broken;
  }
  jpeg_create_decompress(&jpeg);
  jpeg_stdio_src(&jpeg, file);
  jpeg_read_header(&jpeg, TRUE);
  if (jpeg.image_width > most_pixels / jpeg.image_height) {
    return JpegResult::too_large;
  }
  jpeg.out_color_space = jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&jpeg);
  const unsigned components = static_cast<unsigned>(jpeg.output_components);
  JSAMPARRAY row = (*jpeg.mem->alloc_sarray)(reinterpret_cast<j_common_ptr>(&jpeg), JPOOL_IMAGE,
                                             jpeg.output_width * components, 1);
  while (jpeg.output_scanline < jpeg.output_height) {
    jpeg_read_scanlines(&jpeg, row, 1);
    for (JDIMENSION x = 0; x < jpeg.output_width; ++x) {
      const JSAMPLE* p = row[0] + static_cast<std::size_t>(x) * components;
      histogram.add({p[0], p[components == 3 ? 1 : 0], p[components == 3 ? 2 : 0]}, 255);
    }
  }
  jpeg_finish_decompress(&jpeg);
  // Warnings are of missing or damaged data, which libjpeg replaces by gray.
  return errors.manager.num_warnings == 0 ? JpegResult::read : JpegResult::broken;
}

TextureAverage average_of_jpeg(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (file == nullptr) {
    return {{}, "cannot be read"};
  }
  jpeg_decompress_struct jpeg{};
  JpegErrors errors{};
  Histogram histogram{};
  const JpegResult result = read_jpeg(file.get(), jpeg, errors, histogram);
  TextureAverage average;
  if (result == JpegResult::read) {
    average = color_of(histogram);
  } else {
    average.problem = result == JpegResult::broken ? std::string(broken_image)
                                                   : too_large(jpeg.image_width, jpeg.image_height);
  }
  jpeg_destroy_decompress(&jpeg);
  return average;
}

}  // namespace

TextureAverage average_of_texture(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return {{}, "is not a file"};
  }
  // The first bytes tell the format, whatever the ending of the name is.
  std::array<char, 8> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  const std::string_view bytes(start.data(), start.size());
  if (bytes == std::string_view("\x89PNG\r\n\x1a\n", 8)) {
    return average_of_png(path);
  }
  if (bytes.starts_with("\xff\xd8\xff")) {
    return average_of_jpeg(path);
  }
  return {{}, "is not a PNG or JPEG image"};
}

}  // namespace transillum
