// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/vec3.h"

namespace transillum {

/// A point of a texture: u to the right, v downward, 0 to 1 across the image.
struct TexturePoint {
  double u = 0, v = 0;
};

/// How a texture continues beyond 0 and 1.
enum class TextureWrap { repeat, mirror, clamp };

/// An image in linear light and its halved images, for averages over triangles.
class TexturePixels {
 public:
  /// Decodes a PNG or JPEG image; if that fails, problem() says why.
  /// @param linear whether its values are linear already, as those of metallic factors
  /// @throws Canceled
  TexturePixels(std::span<const unsigned char> bytes, bool linear,
                const Cancellation& cancellation);

  /// Empty, or why there are no pixels, as "is not a PNG or JPEG image".
  const std::string& problem() const { return problem_; }
  /// Number of pixels of the full image.
  std::uint64_t size() const { return levels_.empty() ? 0 : levels_.front().size(); }

  /// The average over a triangle, by its pixels in the largest of the images in which it is at most
  /// 64 pixels wide and high; of the pixel at its center where it has none.
  Rgb average(const std::array<TexturePoint, 3>& triangle, TextureWrap across,
              TextureWrap down) const;

 private:
  struct Level {
    std::int64_t width = 0, height = 0;
    std::vector<float> values;  ///< red, green, blue, by row
    std::uint64_t size() const { return static_cast<std::uint64_t>(width * height); }
  };
  static Level halved(const Level& of);
  Rgb at_pixel(const Level& level, std::int64_t x, std::int64_t y, TextureWrap across,
               TextureWrap down) const;

  std::string problem_;
  std::vector<Level> levels_;
};

}  // namespace transillum
