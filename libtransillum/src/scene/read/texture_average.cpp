// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The average color of a texture, or its pixels, read row by row by libpng or libjpeg. Both report
// errors by a function that must not return, so they are left by a jump: the two functions that
// read have no variable with a destructor.
#include "scene/read/texture_average.h"

// jpeglib.h requires <cstdio> before it.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include <jpeglib.h>

namespace transillum {
namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;

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

/// Result of reading an image: how it ended, its size, and what was counted or kept.
struct Reading {
  enum class End { broken, too_large, canceled, complete } end = End::broken;
  std::uint64_t width = 0, height = 0;
  bool keeps_pixels = false;
  Histogram histogram{};
  std::vector<std::uint8_t> rgb;  ///< by row, if kept

  void add(std::uint64_t x, std::uint64_t y, std::array<std::uint8_t, 3> color,
           std::uint64_t alpha) {
    if (!keeps_pixels) {
      histogram.add(color, alpha);
      return;
    }
    const std::size_t first = 3 * static_cast<std::size_t>(y * width + x);
    std::copy(color.begin(), color.end(), rgb.begin() + static_cast<std::ptrdiff_t>(first));
  }
};

/// Prepares for an image of this size; returns whether it is too large.
bool is_too_large(Reading& reading, std::uint64_t width, std::uint64_t height) {
  reading.width = width;
  reading.height = height;
  if (height > 0 && width > most_pixels / height) {
    reading.end = Reading::End::too_large;
    return true;
  }
  if (reading.keeps_pixels) {
    reading.rgb.resize(3 * static_cast<std::size_t>(width * height));
  }
  return false;
}

/// Reads rows of RGBA. Interlaced images come as seven smaller ones, in which every pixel of the
/// image occurs once.
void read_png(std::FILE* file, png_structp png, png_infop info, const Cancellation& cancellation,
              std::vector<png_byte>& row, Reading& reading) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    reading.end = Reading::End::broken;
    return;
  }
  png_init_io(png, file);
  png_read_info(png, info);
  const png_uint_32 width = png_get_image_width(png, info);
  const png_uint_32 height = png_get_image_height(png, info);
  if (is_too_large(reading, width, height)) {
    return;
  }
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  png_start_read_image(png);
  const int passes = png_get_interlace_type(png, info) == PNG_INTERLACE_NONE ? 1 : 7;
  row.resize(4 * std::size_t{width});
  for (int pass = 0; pass < passes; ++pass) {
    const png_uint_32 columns = passes == 1 ? width : PNG_PASS_COLS(width, pass);
    const png_uint_32 rows = passes == 1 ? height : PNG_PASS_ROWS(height, pass);
    for (png_uint_32 y = 0; columns > 0 && y < rows; ++y) {
      if (cancellation.canceled()) {
        reading.end = Reading::End::canceled;
        return;
      }
      png_read_row(png, row.data(), nullptr);
      for (png_uint_32 x = 0; x < columns; ++x) {
        const png_byte* p = row.data() + 4 * std::size_t{x};
        const bool whole = passes == 1;
        reading.add(whole ? x : PNG_COL_FROM_PASS_COL(x, pass),
                    whole ? y : PNG_ROW_FROM_PASS_ROW(y, pass), {p[0], p[1], p[2]}, p[3]);
      }
    }
  }
  reading.end = Reading::End::complete;
}

/// libpng's two objects for reading a file.
struct PngReader {
  png_structp png = png_create_read_struct(
      PNG_LIBPNG_VER_STRING, nullptr,
      [](png_structp failed, png_const_charp) { png_longjmp(failed, 1); },
      [](png_structp, png_const_charp) {});
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  PngReader() = default;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

Reading reading_of_png(std::FILE* file, bool keeps_pixels, const Cancellation& cancellation) {
  Reading reading;
  reading.keeps_pixels = keeps_pixels;
  const PngReader reader;
  std::vector<png_byte> row;
  if (reader.info == nullptr) {
    throw std::bad_alloc();
  }
  read_png(file, reader.png, reader.info, cancellation, row, reading);
  return reading;
}

struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf on_error;
};

void read_jpeg(std::FILE* file, jpeg_decompress_struct& jpeg, JpegErrors& errors,
               const Cancellation& cancellation, Reading& reading) {
  jpeg.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = [](j_common_ptr common) {
    std::longjmp(reinterpret_cast<JpegErrors*>(common->err)->on_error, 1);
  };
  errors.manager.output_message = [](j_common_ptr) {};
  if (setjmp(errors.on_error) != 0) {
    reading.end = Reading::End::broken;
    return;
  }
  jpeg_create_decompress(&jpeg);
  jpeg_stdio_src(&jpeg, file);
  jpeg_read_header(&jpeg, TRUE);
  if (is_too_large(reading, jpeg.image_width, jpeg.image_height)) {
    return;
  }
  jpeg.out_color_space = jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&jpeg);
  const auto components = static_cast<std::size_t>(jpeg.output_components);
  JSAMPARRAY row =
      (*jpeg.mem->alloc_sarray)(reinterpret_cast<j_common_ptr>(&jpeg), JPOOL_IMAGE,
                                jpeg.output_width * static_cast<JDIMENSION>(components), 1);
  while (jpeg.output_scanline < jpeg.output_height) {
    if (cancellation.canceled()) {
      reading.end = Reading::End::canceled;
      return;
    }
    jpeg_read_scanlines(&jpeg, row, 1);
    for (std::size_t x = 0; x < jpeg.output_width; ++x) {
      const JSAMPLE* p = row[0] + x * components;
      reading.add(x, jpeg.output_scanline - 1,
                  {p[0], p[components == 3 ? 1 : 0], p[components == 3 ? 2 : 0]}, 255);
    }
  }
  jpeg_finish_decompress(&jpeg);
  // Warnings are of missing or damaged data, which libjpeg replaces by gray.
  reading.end = errors.manager.num_warnings == 0 ? Reading::End::complete : Reading::End::broken;
}

Reading reading_of_jpeg(std::FILE* file, bool keeps_pixels, const Cancellation& cancellation) {
  Reading reading;
  reading.keeps_pixels = keeps_pixels;
  jpeg_decompress_struct jpeg{};
  JpegErrors errors{};
  read_jpeg(file, jpeg, errors, cancellation, reading);
  jpeg_destroy_decompress(&jpeg);
  return reading;
}

/// Reads an image of either format; the first bytes tell it, whatever the ending of a name is.
/// Empty if it has neither.
std::optional<Reading> reading_of(std::FILE* file, bool keeps_pixels,
                                  const Cancellation& cancellation) {
  std::array<char, 8> start{};
  const std::size_t length = std::fread(start.data(), 1, start.size(), file);
  std::rewind(file);
  const std::string_view bytes(start.data(), length);
  if (bytes == std::string_view("\x89PNG\r\n\x1a\n", 8)) {
    return reading_of_png(file, keeps_pixels, cancellation);
  }
  if (bytes.starts_with("\xff\xd8\xff")) {
    return reading_of_jpeg(file, keeps_pixels, cancellation);
  }
  return {};
}

/// Why an image has no pixels; empty if it has.
/// @throws Canceled
std::string problem_of(const std::optional<Reading>& reading) {
  if (!reading) {
    return "is not a PNG or JPEG image";
  }
  switch (reading->end) {
    case Reading::End::canceled:
      throw Canceled();
    case Reading::End::broken:
      return "is a broken image";
    case Reading::End::too_large:
      return fmt::format("has {} x {} pixels; the limit is {}", reading->width, reading->height,
                         most_pixels);
    case Reading::End::complete:
      break;
  }
  return {};
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

}  // namespace

double linear_of_srgb(std::uint8_t value) { return srgb_table()[value]; }

DecodedImage decode_image(std::span<const unsigned char> bytes, const Cancellation& cancellation) {
  if (bytes.empty()) {
    return {0, 0, {}, "has no data"};
  }
  // The file is only read.
  const File file(::fmemopen(const_cast<unsigned char*>(bytes.data()), bytes.size(), "rb"),
                  std::fclose);
  if (file == nullptr) {
    return {0, 0, {}, "cannot be read"};
  }
  std::optional<Reading> reading = reading_of(file.get(), true, cancellation);
  std::string problem = problem_of(reading);
  if (!problem.empty()) {
    return {0, 0, {}, std::move(problem)};
  }
  return {reading->width, reading->height, std::move(reading->rgb), {}};
}

TextureAverage average_of_texture(const std::filesystem::path& path,
                                  const Cancellation& cancellation) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return {{}, "is not a file"};
  }
  const File file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (file == nullptr) {
    return {{}, "cannot be read"};
  }
  const std::optional<Reading> reading = reading_of(file.get(), false, cancellation);
  std::string problem = problem_of(reading);
  if (!problem.empty()) {
    return {{}, std::move(problem)};
  }
  const std::optional<Rgb> color = reading->histogram.average();
  return color ? TextureAverage{color, {}} : TextureAverage{{}, "has no opaque pixel"};
}

}  // namespace transillum
