// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/error/error_estimate.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "base/power_of_two.h"
#include "radiosity/channel_sums.h"
#include "radiosity/error_bounds.h"
#include "radiosity/norms.h"
#include "radiosity/reflected_light.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

/// Standard error of the mean of independent values.
/// @param scale brings the values near 1, so that their squares are in range
template <class ValueOf>
Rgb standard_error_of(std::size_t count, double scale, ValueOf value_of) {
  const auto n = static_cast<double>(count);
  Rgb mean;
  for (std::size_t r = 0; r < count; ++r) {
    mean += (1 / n) * value_of(r);
  }
  Rgb squares;
  for (std::size_t r = 0; r < count; ++r) {
    const Rgb off = scale * (value_of(r) - mean);
    squares += off * off;
  }
  return (1 / scale) * root(1 / (n * (n - 1)) * squares);
}

/// Unknowns per patch in a list of their values.
std::size_t unknowns_per_patch(const Scene& scene, const std::vector<Rgb>& b) {
  return b.size() / scene.patches().size();
}

Rgb mean_over_area(const Scene& scene, const std::vector<Rgb>& b) {
  const std::size_t per_patch = unknowns_per_patch(scene, b);
  Rgb power;
  double area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    power += scene.patch(i).area * b[per_patch * static_cast<std::size_t>(i)];
    area += scene.patch(i).area;
  }
  return (1 / area) * power;
}

/// Scalar products of the deviations of replicas from `b`, over patches.
/// @param measured of ReflectedLight
ChannelProducts scalar_products(const std::vector<Rgb>& b, const std::vector<char>& measured,
                                double scale, const std::vector<std::vector<Rgb>>& replicas) {
  ChannelProducts products(replicas.size());
  std::vector<Rgb> off(replicas.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (measured[i] != 0) {
      for (std::size_t r = 0; r < replicas.size(); ++r) {
        off[r] = scale * (replicas[r][i] - b[i]);
      }
      products.add(off);
    }
  }
  return products;
}

/// Sets the relative RMS error and its limits, by the channel with the largest limit.
/// @param errors sum of the squares of the standard errors
/// @param values sum of the squares of the reflected light
void set_rms(ErrorEstimate& error, const Rgb& errors, const Rgb& values,
             const ChannelProducts& products) {
  const Rgb units = channel_units(root(values));
  error.rms_limit = -1;
  for (const auto channel : channels_of_rgb) {
    const double rms = ratio_or_zero(std::sqrt(errors.*channel), units.*channel);
    const double independent = independent_errors(products.of(channel));
    // The sum of squared errors over its estimate, both as sums of so many squares.
    const boost::math::fisher_f fisher(independent, (error.replicas - 1) * independent);
    const double limit = rms * std::sqrt(quantile(fisher, error_confidence));
    if (limit > error.rms_limit || std::isnan(limit)) {
      error.rms = rms;
      error.rms_limit = limit;
      error.rms_lowest = rms * std::sqrt(quantile(fisher, 1 - error_confidence));
      error.independent_errors = independent;
    }
  }
}

/// The bias of H where the bias of B is `bias`, W/m²; where nothing is reflected, the mean over the
/// other patches.
std::vector<Rgb> bias_of_irradiance(const Scene& scene, const ErrorSurfaces& surfaces,
                                    const std::vector<Rgb>& bias) {
  const std::size_t per_patch = unknowns_per_patch(scene, bias);
  std::vector<Rgb> result(bias.size());
  for (const auto channel : channels_of_rgb) {
    double sum = 0, area = 0;
    for (std::size_t u = 0; u < bias.size(); ++u) {
      const auto i = static_cast<PatchId>(u / per_patch);
      if (const double rho = at(surfaces.reflectance, i).*channel; rho > 0) {
        result[u].*channel = bias[u].*channel / rho;
        sum += scene.patch(i).area * result[u].*channel;
        area += scene.patch(i).area;
      }
    }
    for (std::size_t u = 0; u < bias.size() && area > 0; ++u) {
      if (!(surfaces.reflectance[u / per_patch].*channel > 0)) {
        result[u].*channel = sum / area;
      }
    }
  }
  return result;
}

}  // namespace

ErrorSurfaces::ErrorSurfaces(const Scene& scene, const std::vector<std::string>& kept, bool lobes)
    : reflecting(find_surfaces(
          scene, lobes ? Measured::reflecting_with_lobes : Measured::reflecting, kept)),
      receiving(find_surfaces(scene, Measured::receiving, kept)) {
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    reflectance.push_back(lobes ? scene.reflectance(i) + used_lobe(scene.material(i)).reflectance
                                : scene.reflectance(i));
  }
}

ErrorEstimate estimate_error(const Scene& scene, const ErrorSurfaces& surfaces,
                             const std::vector<Rgb>& b,
                             const std::vector<std::vector<Rgb>>& replicas) {
  ErrorEstimate error;
  error.replicas = static_cast<int>(replicas.size());
  const boost::math::students_t student(error.replicas - 1);
  error.quantile = quantile(student, (1 + error_confidence) / 2);
  error.standard_error.reserve(scene.patches().size());
  const std::size_t per_patch = unknowns_per_patch(scene, b);
  const ReflectedLight light(scene, per_patch);
  const std::vector<char> measured = light.measured(b);
  const double scale = scale_to_one(max_norm(light.of(b)));
  Rgb errors, values;
  for (std::size_t u = 0; u < b.size(); ++u) {
    const Rgb standard_error =
        standard_error_of(replicas.size(), scale, [&](std::size_t r) { return replicas[r][u]; });
    if (u % per_patch == 0) {
      error.standard_error.push_back(standard_error);
    }
    if (measured[u] != 0) {
      const Rgb off = scale * standard_error, value = scale * light.of(u, b[u]);
      errors += off * off;
      values += value * value;
    }
  }
  set_rms(error, errors, values, scalar_products(b, measured, scale, replicas));
  std::vector<Rgb> means;
  for (const auto& replica : replicas) {
    means.push_back(mean_over_area(scene, replica));
  }
  error.mean_radiosity = mean_over_area(scene, b);
  error.mean_reflected = mean_over_area(scene, difference(b, light.exitance()));
  error.mean_standard_error =
      standard_error_of(means.size(), scale, [&](std::size_t r) { return means[r]; });
  error.surfaces = surface_errors(surfaces.reflecting, difference(b, light.exitance()), replicas);
  return error;
}

void include_bias(ErrorEstimate& error, const Scene& scene, const ErrorSurfaces& surfaces,
                  const std::vector<Rgb>& b, const std::vector<Rgb>& bias) {
  if (error.replicas == 0 || bias.empty()) {
    return;
  }
  const std::size_t per_patch = unknowns_per_patch(scene, bias);
  for (std::size_t i = 0; i < error.standard_error.size(); ++i) {
    error.standard_error[i] = root_of_squares(error.standard_error[i], bias[per_patch * i]);
  }
  error.mean_standard_error =
      root_of_squares(error.mean_standard_error, mean_over_area(scene, bias));
  include_bias(error.surfaces, surfaces.reflecting, bias);
  include_bias(error.irradiance, surfaces.receiving, bias_of_irradiance(scene, surfaces, bias));
  const ReflectedLight light(scene, unknowns_per_patch(scene, b));
  const std::vector<Rgb> reflected = light.of(b);
  if (max_norm(reflected) > 0) {
    const std::vector<char> measured = light.measured(b);
    std::vector<Rgb> counted = bias;
    for (std::size_t u = 0; u < bias.size(); ++u) {
      counted[u] = measured[u * b.size() / bias.size()] != 0 ? bias[u] : Rgb{};
    }
    const double relative = worst_relative_rms(counted, reflected);
    error.rms = std::hypot(error.rms, relative);
    error.rms_limit = std::hypot(error.rms_limit, relative);
    error.rms_lowest = std::hypot(error.rms_lowest, relative);
  }
}

std::vector<Rgb> bias_of_iteration(const ErrorSurfaces& surfaces,
                                   const SolveStatistics& statistics) {
  if (statistics.iteration_records.empty()) {
    return {};
  }
  const IterationRecord& last = statistics.iteration_records.back();
  const double contraction = std::max(statistics.rho_max, is_rounding(last) ? 0 : last.contraction);
  const Rgb error = distances_to_limit(last.changes, contraction);
  std::vector<Rgb> left;
  for (const Rgb& rho : surfaces.reflectance) {
    left.push_back({rho.r > 0 ? rho.r * error.r : 0, rho.g > 0 ? rho.g * error.g : 0,
                    rho.b > 0 ? rho.b * error.b : 0});
  }
  return left;
}

/// An error D of H makes B wrong by X = rho D + rho F X. F X is taken as the mean of X over the
/// area, the mean of rho D over 1 - the mean of rho. What is reflected of errors is treated as
/// uniform, so that linear terms are wrong by rho D alone.
std::vector<Rgb> bias_of_shot(const Scene& scene, const ErrorSurfaces& surfaces,
                              const DirectLight& shot) {
  std::vector<Rgb> bias(shot.irradiance_error.size()), rho(bias.size());
  for (std::size_t i = 0; i < bias.size(); ++i) {
    rho[i] = surfaces.reflectance[i];
    bias[i] = rho[i] * shot.irradiance_error[i];
  }
  const bool linear = !shot.linear_term_errors.empty();
  if (bias.empty() || !(linear || max_norm(bias) > 0)) {
    return {};
  }
  const Rgb direct = mean_over_area(scene, bias), mean = mean_over_area(scene, rho);
  const Rgb gathered{direct.r / (1 - mean.r), direct.g / (1 - mean.g), direct.b / (1 - mean.b)};
  for (std::size_t i = 0; i < bias.size(); ++i) {
    bias[i] += rho[i] * gathered;
  }
  if (!linear) {
    return bias;
  }
  std::vector<Rgb> of_unknowns;
  for (std::size_t i = 0; i < bias.size(); ++i) {
    const LinearTerm& error = shot.linear_term_errors[i];
    of_unknowns.insert(of_unknowns.end(), {bias[i], rho[i] * error.first, rho[i] * error.second});
  }
  return of_unknowns;
}

}  // namespace transillum
