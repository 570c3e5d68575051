// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Errors by surface and their common limit, from the spread of replicas.
#include "radiosity/error/surface_errors.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "base/power_of_two.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using boost::math::fisher_f;

/// Surfaces with less than this fraction of the brightest one's level are measured relative to it.
constexpr double least_level = 1e-3;

/// The squared error over its estimate, both as sums of so many squares.
fisher_f squared_ratio(const SurfaceErrors& errors, const SurfaceError& surface) {
  return {surface.independent_errors, (errors.replicas - 1) * surface.independent_errors};
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
    const double ratio = std::sqrt(quantile(squared_ratio(errors, surface), error_confidence));
    surface.limit = std::hypot(surface.spread * ratio, surface.bias);
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

/// RMS of a quantity over the patches of each surface, and channels.
std::vector<double> rms_by_surface(const Surfaces& surfaces, const std::vector<Rgb>& values) {
  const double scale = scale_to_one(max_norm(values));
  std::vector<double> rms(surfaces.surfaces.size());
  for (std::size_t u = 0; u < values.size(); ++u) {
    if (const std::int32_t s = surface_of(surfaces, u, values.size()); s != Surfaces::none) {
      at(rms, s) += sum_of_squares(scale * values[u]);
    }
  }
  for (std::size_t s = 0; s < rms.size(); ++s) {
    const double entries = 3.0 * static_cast<double>(surfaces.surfaces[s].patches);
    rms[s] = std::sqrt(rms[s] / entries) / scale;
  }
  return rms;
}

/// The surfaces with their levels, and without errors.
SurfaceErrors levels(const Surfaces& surfaces, const std::vector<Rgb>& values) {
  const std::vector<double> rms = rms_by_surface(surfaces, values);
  const double least = rms.empty() ? 0 : least_level * *std::max_element(rms.begin(), rms.end());
  SurfaceErrors errors;
  for (std::size_t s = 0; s < rms.size(); ++s) {
    const Surfaces::Surface& of = surfaces.surfaces[s];
    errors.surfaces.push_back({.name = of.name,
                               .patches = of.patches,
                               .area = of.area,
                               .level = rms[s],
                               .unit = std::max(rms[s], least),
                               .is_dark = rms[s] < least});
  }
  return errors;
}

}  // namespace

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
  return norms > 0 ? std::max(1.0, 1 / (squares / norms + 1 / static_cast<double>(n))) : 1.0;
}

SurfaceErrors surface_errors(const Surfaces& surfaces, const std::vector<Rgb>& values,
                             const std::vector<std::vector<Rgb>>& replicas) {
  const std::size_t count = replicas.size(), unknowns = values.size();
  SurfaceErrors errors = levels(surfaces, values);
  errors.replicas = static_cast<int>(count);
  const double scale = scale_to_one(max_norm(values));
  std::vector<DeviationProducts> products(surfaces.surfaces.size(),
                                          DeviationProducts(count, std::vector<double>(count)));
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
      for (std::size_t q = 0; q <= r; ++q) {
        const Rgb product = off[r] * off[q];
        at(products, s)[r][q] += product.r + product.g + product.b;
      }
    }
  }
  for (std::size_t s = 0; s < products.size(); ++s) {
    SurfaceError& surface = errors.surfaces[s];
    double trace = 0;
    for (std::size_t r = 0; r < count; ++r) {
      trace += products[s][r][r];
      for (std::size_t q = 0; q < r; ++q) {
        products[s][q][r] = products[s][r][q];
      }
    }
    const auto n = static_cast<double>(count);
    const double entries = 3.0 * static_cast<double>(surface.patches);
    surface.spread =
        ratio_or_zero(std::sqrt(trace / (n * (n - 1) * entries)) / scale, surface.unit);
    surface.independent_errors = independent_errors(products[s]);
  }
  set_limits(errors);
  return errors;
}

SurfaceErrors surface_differences(const Surfaces& surfaces, const std::vector<Rgb>& values,
                                  const std::vector<Rgb>& differences) {
  SurfaceErrors errors = levels(surfaces, values);
  const std::vector<double> rms = rms_by_surface(surfaces, differences);
  for (std::size_t s = 0; s < rms.size(); ++s) {
    SurfaceError& surface = errors.surfaces[s];
    surface.rms = surface.limit = ratio_or_zero(rms[s], surface.unit);
    if (rms[s] > 0 && !(surface.unit > 0)) {
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
  const std::vector<double> rms = rms_by_surface(surfaces, bias);
  for (std::size_t s = 0; s < rms.size(); ++s) {
    SurfaceError& surface = errors.surfaces[s];
    surface.bias = std::hypot(surface.bias, ratio_or_zero(rms[s], surface.unit));
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
