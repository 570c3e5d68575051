// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/texture_pixels.h"

#include <algorithm>
#include <cmath>

#include "scene/read/texture_average.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Larger images are reduced as they are decoded.
constexpr std::uint64_t most_kept_pixels = std::uint64_t{1} << 24;
/// Most pixels of a triangle along either axis that are averaged.
constexpr double widest_triangle = 64;

std::int64_t wrapped(std::int64_t x, std::int64_t size, TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::clamp:
      return std::clamp<std::int64_t>(x, 0, size - 1);
    case TextureWrap::mirror: {
      const std::int64_t period = ((x % (2 * size)) + 2 * size) % (2 * size);
      return period < size ? period : 2 * size - 1 - period;
    }
    case TextureWrap::repeat:
      break;
  }
  return ((x % size) + size) % size;
}

}  // namespace

TexturePixels::TexturePixels(std::span<const unsigned char> bytes, bool linear,
                             const Cancellation& cancellation) {
  const DecodedImage image = decode_image(bytes, cancellation);
  if (!image.problem.empty() || image.rgb.empty()) {
    problem_ = image.problem.empty() ? "has no pixels" : image.problem;
    return;
  }
  std::int64_t step = 1;
  while (image.width * image.height / static_cast<std::uint64_t>(step * step) > most_kept_pixels) {
    step *= 2;
  }
  const auto width = static_cast<std::int64_t>(image.width);
  const auto height = static_cast<std::int64_t>(image.height);
  Level full{(width + step - 1) / step, (height + step - 1) / step, {}};
  full.values.assign(3 * full.size(), 0.0F);
  std::vector<float> decoded(256);
  for (std::size_t v = 0; v < decoded.size(); ++v) {
    decoded[v] = linear ? static_cast<float>(v) / 255
                        : static_cast<float>(linear_of_srgb(static_cast<std::uint8_t>(v)));
  }
  for (std::int64_t y = 0; y < height; ++y) {
    cancellation.throw_if_canceled();
    const auto rows = static_cast<float>(std::min(step, height - y / step * step));
    for (std::int64_t x = 0; x < width; ++x) {
      const auto columns = static_cast<float>(std::min(step, width - x / step * step));
      for (std::int64_t c = 0; c < 3; ++c) {
        at(full.values, 3 * (y / step * full.width + x / step) + c) +=
            at(decoded, at(image.rgb, 3 * (y * width + x) + c)) / (rows * columns);
      }
    }
  }
  levels_.push_back(std::move(full));
  while (levels_.back().size() > 1) {
    cancellation.throw_if_canceled();
    levels_.push_back(halved(levels_.back()));
  }
}

TexturePixels::Level TexturePixels::halved(const Level& of) {
  Level half{(of.width + 1) / 2, (of.height + 1) / 2, {}};
  half.values.resize(3 * half.size());
  for (std::int64_t y = 0; y < half.height; ++y) {
    for (std::int64_t x = 0; x < half.width; ++x) {
      for (std::int64_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (const std::int64_t row : {2 * y, std::min(2 * y + 1, of.height - 1)}) {
          for (const std::int64_t column : {2 * x, std::min(2 * x + 1, of.width - 1)}) {
            sum += at(of.values, 3 * (row * of.width + column) + c);
          }
        }
        at(half.values, 3 * (y * half.width + x) + c) = sum / 4;
      }
    }
  }
  return half;
}

Rgb TexturePixels::at_pixel(const Level& level, std::int64_t x, std::int64_t y, TextureWrap across,
                            TextureWrap down) const {
  const std::int64_t first =
      3 * (wrapped(y, level.height, down) * level.width + wrapped(x, level.width, across));
  return {static_cast<double>(at(level.values, first)),
          static_cast<double>(at(level.values, first + 1)),
          static_cast<double>(at(level.values, first + 2))};
}

Rgb TexturePixels::average(const std::array<TexturePoint, 3>& triangle, TextureWrap across,
                           TextureWrap down) const {
  // Not structured bindings: clang 14 does not capture them.
  const auto across_range = std::minmax({triangle[0].u, triangle[1].u, triangle[2].u});
  const auto down_range = std::minmax({triangle[0].v, triangle[1].v, triangle[2].v});
  const double low_u = across_range.first, high_u = across_range.second;
  const double low_v = down_range.first, high_v = down_range.second;
  const bool inside = std::abs(low_u) < 1e6 && std::abs(high_u) < 1e6 && std::abs(low_v) < 1e6 &&
                      std::abs(high_v) < 1e6;
  const auto fits = [&](const Level& level) {
    return (high_u - low_u) * static_cast<double>(level.width) <= widest_triangle &&
           (high_v - low_v) * static_cast<double>(level.height) <= widest_triangle;
  };
  const auto found = std::find_if(levels_.begin(), levels_.end(), fits);
  if (!inside || found == levels_.end()) {
    return at_pixel(levels_.back(), 0, 0, across, down);
  }
  const Level& level = *found;
  const auto width = static_cast<double>(level.width), height = static_cast<double>(level.height);
  const auto edge = [&](std::size_t k, double x, double y) {
    const TexturePoint &a = triangle[k], &b = triangle[(k + 1) % 3];
    return (b.u - a.u) * width * (y - a.v * height) - (b.v - a.v) * height * (x - a.u * width);
  };
  Rgb sum;
  double count = 0;
  for (auto y = static_cast<std::int64_t>(std::floor(low_v * height));
       static_cast<double>(y) < high_v * height; ++y) {
    for (auto x = static_cast<std::int64_t>(std::floor(low_u * width));
         static_cast<double>(x) < high_u * width; ++x) {
      const double center_x = static_cast<double>(x) + 0.5, center_y = static_cast<double>(y) + 0.5;
      const double a = edge(0, center_x, center_y), b = edge(1, center_x, center_y),
                   c = edge(2, center_x, center_y);
      if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) {
        sum += at_pixel(level, x, y, across, down);
        count += 1;
      }
    }
  }
  if (count > 0) {
    return 1 / count * sum;
  }
  const double u = (triangle[0].u + triangle[1].u + triangle[2].u) / 3;
  const double v = (triangle[0].v + triangle[1].v + triangle[2].v) / 3;
  return at_pixel(level, static_cast<std::int64_t>(std::floor(u * width)),
                  static_cast<std::int64_t>(std::floor(v * height)), across, down);
}

}  // namespace transillum
