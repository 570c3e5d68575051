// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/power_of_two.h"
#include "radiosity/channel_sums.h"
#include "transillum/scene.h"

namespace transillum {

/// Sum of the areas of all patches, m².
inline double total_area(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches()) {
    area += patch.area;
  }
  return area;
}

/// Largest magnitude over patches and channels.
inline double max_norm(const std::vector<Rgb>& values) {
  double largest = 0;
  for (const Rgb& value : values) {
    largest = std::max(largest, max_abs(value));
  }
  return largest;
}

/// Largest magnitude over patches, of each channel.
inline Rgb largest_magnitudes(const std::vector<Rgb>& values) {
  Rgb largest;
  for (const Rgb& value : values) {
    largest = largest_of(largest, {std::abs(value.r), std::abs(value.g), std::abs(value.b)});
  }
  return largest;
}

/// Whether all values are finite.
inline bool all_finite(const std::vector<Rgb>& values) {
  return std::all_of(values.begin(), values.end(), [](const Rgb& v) {
    return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
  });
}

/// a - b, of the same length.
inline std::vector<Rgb> difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  std::vector<Rgb> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    result[i] = a[i] - b[i];
  }
  return result;
}

/// Root of the sum of the squares over patches and channels, over `unit`.
/// @param unit above 0; of the size of the values, so that the squares stay in range
inline double root_of_squares(const std::vector<Rgb>& values, double unit) {
  double squares = 0;
  for (const Rgb& value : values) {
    squares += sum_of_squares((1 / unit) * value);
  }
  return std::sqrt(squares);
}

/// Relative RMS error of the channel that is off the most: a dark channel has its own measure.
/// @param errors of `values`, 0 where these are not measured
inline double worst_relative_rms(const std::vector<Rgb>& errors, const std::vector<Rgb>& values) {
  const double scale = scale_to_one(max_norm(values));
  const auto norm_of = [&](const std::vector<Rgb>& list) {
    Rgb squares;
    for (const Rgb& value : list) {
      squares += (scale * value) * (scale * value);
    }
    return root(squares);
  };
  return largest_ratio(norm_of(errors), channel_units(norm_of(values)));
}

}  // namespace transillum
