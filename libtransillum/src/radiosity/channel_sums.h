// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/ratio.h"
#include "transillum/vec3.h"

namespace transillum {

/// The channels of a color, for loops over them.
inline constexpr std::array channels_of_rgb{&Rgb::r, &Rgb::g, &Rgb::b};

/// Sum of the channels.
inline double sum(const Rgb& c) { return c.r + c.g + c.b; }
/// Square of the length of a color as a vector of its channels.
inline double sum_of_squares(const Rgb& c) { return c.r * c.r + c.g * c.g + c.b * c.b; }

/// A patch or channel with less than this fraction of the largest reflected light is unlit.
inline constexpr double least_light = 1e-6;

/// The larger of each channel; not a number where either is not.
inline Rgb largest_of(const Rgb& a, const Rgb& b) {
  const auto larger = [](double x, double y) { return x < y || std::isnan(y) ? y : x; };
  return {larger(a.r, b.r), larger(a.g, b.g), larger(a.b, b.b)};
}

/// The values that errors are relative to: each channel has its own, as if it were solved alone
/// (decision 79). The errors of an unlit channel are relative to the least light that is lit.
inline Rgb channel_units(const Rgb& values) {
  return largest_of(values, least_light * max_abs(values) * Rgb{1, 1, 1});
}

/// The largest of the channels' ratios, each 0 where `units` is not above 0; not a number where any
/// is not.
inline double largest_ratio(const Rgb& values, const Rgb& units) {
  const Rgb ratios{ratio_or_zero(values.r, units.r), ratio_or_zero(values.g, units.g),
                   ratio_or_zero(values.b, units.b)};
  return std::isnan(sum(ratios)) ? sum(ratios) : std::max({ratios.r, ratios.g, ratios.b});
}

/// The root of each channel.
inline Rgb root(const Rgb& c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }

}  // namespace transillum
