// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/vec3.h"

namespace transillum {

/// The average color of an image, or why there is none.
struct TextureAverage {
  std::optional<Rgb> color;  ///< linear, 0 to 1
  std::string problem;       ///< where there is no color, as "is not a PNG or JPEG image"
};

/// Averages a PNG or JPEG image over its pixels in linear light: values are decoded by the transfer
/// function of sRGB, whatever profile the file states; pixels count as much as they are opaque.
/// Images of more than 2^26 pixels are refused unread. Memory: a row, but all coefficients of a
/// progressive JPEG, at most 512 MB.
/// @param cancellation checked for each row.
/// @throws Canceled
TextureAverage average_of_texture(const std::filesystem::path& path,
                                  const Cancellation& cancellation);

/// The pixels of an image, or why there are none.
struct DecodedImage {
  std::uint64_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< by row; as stored, without alpha
  std::string problem;            ///< where there are none, as average_of_texture() says it
};

/// Decodes a PNG or JPEG image of at most 2^26 pixels.
/// @throws Canceled
DecodedImage decode_image(std::span<const unsigned char> bytes, const Cancellation& cancellation);

/// Linear light of an 8-bit value, 0 to 1, by the transfer function of sRGB.
double linear_of_srgb(std::uint8_t value);

}  // namespace transillum
