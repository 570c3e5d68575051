// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Errors by surface and their common limit, from the spread of replicas.
#include "radiosity/error/surface_errors.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "base/power_of_two.h"
#include "radiosity/channel_sums.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using boost::math::fisher_f;

/// Surfaces with less than this fraction of the brightest one's level are measured relative to
/// this, in each channel.
constexpr double least_level = 1e-3;

/// The squared error over its estimate, both as sums of so many squares.
fisher_f squared_ratio(const SurfaceErrors& errors, const SurfaceError& surface) {
  return {surface.independent_errors, (errors.replicas - 1) * surface.independent_errors};
}

double limit_of(const SurfaceErrors& errors, const SurfaceError& surface) {
  const double ratio = std::sqrt(quantile(squared_ratio(errors, surface), error_confidence));
  return std::hypot(surface.spread * ratio, surface.bias);
}

/// The spread of the channel with the largest limit.
void set_spread(const SurfaceErrors& errors, SurfaceError& surface, const ChannelProducts& products,
                double scale) {
  const auto n = static_cast<double>(errors.replicas);
  const double entries = n * (n - 1) * static_cast<double>(surface.patches);
  double largest = -1;
  for (const auto channel : channels_of_rgb) {
    SurfaceError of_channel = surface;
    of_channel.spread = surface.spreads.*channel =
                            ratio_or_zero(std::sqrt(products.squares().*channel / entries) / scale,
                                          surface.unit.*channel);
    of_channel.independent_errors = independent_errors(products.of(channel));
    const double limit = limit_of(errors, of_channel);
    if (limit > largest || std::isnan(limit)) {
      largest = limit;
      surface.spread = of_channel.spread;
      surface.independent_errors = of_channel.independent_errors;
    }
  }
}

/// Probability that the error of a surface exceeds `limit`, relative.
double probability_above(const SurfaceErrors& errors, const SurfaceError& surface, double limit) {
  if (surface.bias >= limit) {
    return surface.rms > 0 ? 1 : 0;
  }
  if (surface.spread == 0) {
    return 0;
  }
  const double ratio = (limit * limit - surface.bias * surface.bias) / std::pow(surface.spread, 2);
  return std::isfinite(ratio) ? cdf(complement(squared_ratio(errors, surface), ratio)) : 0;
}

void set_limits(SurfaceErrors& errors) {
  errors.worst = errors.surfaces.empty() ? -1 : 0;
  double largest = -1;
  for (std::size_t s = 0; s < errors.surfaces.size(); ++s) {
    SurfaceError& surface = errors.surfaces[s];
    surface.rms = std::hypot(surface.spread, surface.bias);
    surface.limit = limit_of(errors, surface);
    if (surface.limit > largest) {
      largest = surface.limit;
      errors.worst = static_cast<int>(s);
    }
  }
  errors.limit = limit_of_all(errors, {});
}

/// The surface of unknown u, or Surfaces::none.
std::int32_t surface_of(const Surfaces& surfaces, std::size_t u, std::size_t unknowns) {
  return surfaces.of_patch[u * surfaces.of_patch.size() / unknowns];
}

/// The surfaces with their levels, and without errors.
SurfaceErrors levels(const Surfaces& surfaces, const std::vector<Rgb>& values) {
  const std::vector<Rgb> rms = rms_by_surface(surfaces, values);
  Rgb brightest;
  for (const Rgb& level : rms) {
    brightest = largest_of(brightest, level);
  }
  const Rgb least =
      largest_of(least_level * brightest, least_light * max_abs(brightest) * Rgb{1, 1, 1});
  SurfaceErrors errors;
  for (std::size_t s = 0; s < rms.size(); ++s) {
    const Surfaces::Surface& of = surfaces.surfaces[s];
    errors.surfaces.push_back(
        {.name = of.name,
         .patches = of.patches,
         .area = of.area,
         .level = std::sqrt(sum_of_squares(rms[s]) / 3),
         .unit = largest_of(rms[s], least),
         .is_dark = rms[s].r < least.r && rms[s].g < least.g && rms[s].b < least.b});
  }
  return errors;
}

}  // namespace

std::vector<Rgb> rms_by_surface(const Surfaces& surfaces, const std::vector<Rgb>& values) {
  const double scale = scale_to_one(max_norm(values));
  std::vector<Rgb> rms(surfaces.surfaces.size());
  for (std::size_t u = 0; u < values.size(); ++u) {
    if (const std::int32_t s = surface_of(surfaces, u, values.size()); s != Surfaces::none) {
      at(rms, s) += (scale * values[u]) * (scale * values[u]);
    }
  }
  for (std::size_t s = 0; s < rms.size(); ++s) {
    const auto patches = static_cast<double>(surfaces.surfaces[s].patches);
    rms[s] = (1 / scale) * root(1 / patches * rms[s]);
  }
  return rms;
}

ChannelProducts::ChannelProducts(std::size_t replicas)
    : replicas_(replicas), products_(replicas * (replicas + 1) / 2) {}

void ChannelProducts::add(const std::vector<Rgb>& deviations) {
  auto product = products_.begin();
  for (std::size_t r = 0; r < replicas_; ++r) {
    for (std::size_t q = 0; q <= r; ++q) {
      *product++ += deviations[r] * deviations[q];
    }
  }
}

DeviationProducts ChannelProducts::of(double Rgb::*channel) const {
  DeviationProducts result(replicas_, std::vector<double>(replicas_));
  auto product = products_.begin();
  for (std::size_t r = 0; r < replicas_; ++r) {
    for (std::size_t q = 0; q <= r; ++q) {
      result[r][q] = result[q][r] = (*product++).*channel;
    }
  }
  return result;
}

Rgb ChannelProducts::squares() const {
  Rgb sum;
  for (std::size_t r = 0; r < replicas_; ++r) {
    sum += products_[r * (r + 1) / 2 + r];
  }
  return sum;
}

double independent_errors(const DeviationProducts& products) {
  const auto product = [&](auto a, auto b, auto c, auto d) {  // sum of (a - b) (c - d)
    return products[a][c] - products[a][d] - products[b][c] + products[b][d];
  };
  const std::size_t n = products.size();
  double norms = 0, squares = 0;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t c = a + 1; c < n; ++c) {
      for (std::size_t b = a + 1; b < n; ++b) {
        for (std::size_t d = c + 1; b != c && d < n; ++d) {
          if (d != b) {
            norms += product(a, b, a, b) * product(c, d, c, d);
            squares += std::pow(product(a, b, c, d), 2);
          }
        }
      }
    }
  }
  if (!(norms > 0)) {
    return 1;
  }
  const double fraction = std::max(0.0, squares / norms), least = 1 / static_cast<double>(n);
  return std::max(1.0, 1 / (fraction + least + std::min(fraction, least)));
}

SurfaceErrors surface_errors(const Surfaces& surfaces, const std::vector<Rgb>& values,
                             const std::vector<std::vector<Rgb>>& replicas) {
  const std::size_t count = replicas.size(), unknowns = values.size();
  SurfaceErrors errors = levels(surfaces, values);
  errors.replicas = static_cast<int>(count);
  const double scale = scale_to_one(max_norm(values));
  std::vector<ChannelProducts> products(surfaces.surfaces.size(), ChannelProducts(count));
  std::vector<Rgb> off(count);
  for (std::size_t u = 0; u < unknowns; ++u) {
    const std::int32_t s = surface_of(surfaces, u, unknowns);
    if (s == Surfaces::none) {
      continue;
    }
    Rgb mean;
    for (std::size_t r = 0; r < count; ++r) {
      mean += (1.0 / static_cast<double>(count)) * replicas[r][u];
    }
    for (std::size_t r = 0; r < count; ++r) {
      off[r] = scale * (replicas[r][u] - mean);
    }
    at(products, s).add(off);
  }
  for (std::size_t s = 0; s < products.size(); ++s) {
    set_spread(errors, errors.surfaces[s], products[s], scale);
  }
  set_limits(errors);
  return errors;
}

SurfaceErrors surface_differences(const Surfaces& surfaces, const std::vector<Rgb>& values,
                                  const std::vector<Rgb>& differences) {
  SurfaceErrors errors = levels(surfaces, values);
  const std::vector<Rgb> rms = rms_by_surface(surfaces, differences);
  for (std::size_t s = 0; s < rms.size(); ++s) {
    SurfaceError& surface = errors.surfaces[s];
    surface.rms = surface.limit = largest_ratio(rms[s], surface.unit);
    if (max_abs(rms[s]) > 0 && !(max_abs(surface.unit) > 0)) {
      surface.rms = surface.limit = HUGE_VAL;
    }
    if (errors.worst < 0 || surface.limit > errors.limit) {
      errors.limit = surface.limit;
      errors.worst = static_cast<int>(s);
    }
  }
  return errors;
}

void include_bias(SurfaceErrors& errors, const Surfaces& surfaces, const std::vector<Rgb>& bias) {
  if (errors.replicas == 0 || !(max_norm(bias) > 0)) {
    return;
  }
  const std::vector<Rgb> rms = rms_by_surface(surfaces, bias);
  for (std::size_t s = 0; s < rms.size(); ++s) {
    SurfaceError& surface = errors.surfaces[s];
    surface.bias = std::hypot(surface.bias, largest_ratio(rms[s], surface.unit));
  }
  set_limits(errors);
}

double limit_of_all(const SurfaceErrors& errors, const std::vector<std::string>& names) {
  std::vector<const SurfaceError*> chosen;
  double low = 0;
  for (const SurfaceError& surface : errors.surfaces) {
    if (names.empty() || std::find(names.begin(), names.end(), surface.name) != names.end()) {
      chosen.push_back(&surface);
      low = std::max(low, surface.limit);
    }
  }
  const auto above = [&](double limit) {
    double sum = 0;
    for (const SurfaceError* surface : chosen) {
      sum += probability_above(errors, *surface, limit);
    }
    return sum;
  };
  if (!(low > 0) || !std::isfinite(low) || above(low) <= 1 - error_confidence) {
    return low;
  }
  double high = low;
  while (above(high) > 1 - error_confidence && std::isfinite(high)) {
    low = high;
    high *= 1.25;
  }
  constexpr double precision = 1e-4;
  while (high > (1 + precision) * low) {
    const double middle = 0.5 * (low + high);
    (above(middle) > 1 - error_confidence ? low : high) = middle;
  }
  return high;
}

}  // namespace transillum
