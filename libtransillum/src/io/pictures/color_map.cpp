// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/pictures/color_map.h"

#include <algorithm>
#include <cmath>

namespace transillum {
namespace {

// Evenly spaced samples of matplotlib's maps (CC0) and of cividis (Nuñez et al. 2018);
// linear interpolation between them.
constexpr ColorBytes viridis[] = {{0x44, 0x01, 0x54}, {0x48, 0x24, 0x75}, {0x41, 0x44, 0x87},
                                  {0x35, 0x5f, 0x8d}, {0x2a, 0x78, 0x8e}, {0x21, 0x91, 0x8c},
                                  {0x22, 0xa8, 0x84}, {0x44, 0xbf, 0x70}, {0x7a, 0xd1, 0x51},
                                  {0xbd, 0xdf, 0x26}, {0xfd, 0xe7, 0x25}};
constexpr ColorBytes cividis[] = {{0x00, 0x20, 0x4d}, {0x00, 0x30, 0x6f}, {0x2a, 0x40, 0x6c},
                                  {0x48, 0x52, 0x6b}, {0x5e, 0x62, 0x6e}, {0x72, 0x73, 0x74},
                                  {0x87, 0x84, 0x79}, {0x9e, 0x96, 0x77}, {0xb6, 0xa9, 0x71},
                                  {0xd0, 0xbe, 0x67}, {0xea, 0xd3, 0x57}, {0xff, 0xea, 0x46}};
constexpr ColorBytes inferno[] = {{0x00, 0x00, 0x04}, {0x16, 0x0b, 0x39}, {0x42, 0x0a, 0x68},
                                  {0x6a, 0x17, 0x6e}, {0x93, 0x26, 0x67}, {0xbc, 0x37, 0x54},
                                  {0xdd, 0x51, 0x3a}, {0xf3, 0x78, 0x19}, {0xfc, 0xa5, 0x0a},
                                  {0xf6, 0xd7, 0x46}, {0xfc, 0xff, 0xa4}};

// Blue and orange can be distinguished with all kinds of color blindness (ColorBrewer's PuOr and
// RdBu mixed; Apache 2).
constexpr ColorBytes diverging[] = {{0x05, 0x30, 0x61}, {0x21, 0x66, 0xac}, {0x43, 0x93, 0xc3},
                                    {0x92, 0xc5, 0xde}, {0xd1, 0xe5, 0xf0}, {0xf7, 0xf7, 0xf7},
                                    {0xfe, 0xe0, 0xb6}, {0xfd, 0xb8, 0x63}, {0xe0, 0x82, 0x14},
                                    {0xb3, 0x58, 0x06}, {0x7f, 0x3b, 0x08}};

}  // namespace

std::span<const ColorBytes> samples_of(ColorMap map) {
  switch (map) {
    case ColorMap::cividis:
      return cividis;
    case ColorMap::inferno:
      return inferno;
    case ColorMap::diverging:
      return diverging;
    case ColorMap::viridis:
      break;
  }
  return viridis;
}

ColorBytes color_of(ColorMap map, double t) {
  const std::span<const ColorBytes> samples = samples_of(map);
  const auto last = static_cast<double>(samples.size() - 1);
  const double at = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) * last : 0.0;
  const auto below = std::min(static_cast<std::size_t>(at), samples.size() - 2);
  const double fraction = at - static_cast<double>(below);
  ColorBytes color;
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = static_cast<std::uint8_t>(
        std::lround((1 - fraction) * samples[below][c] + fraction * samples[below + 1][c]));
  }
  return color;
}

}  // namespace transillum
