// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Relative changes and remainders of iterations. Input: B, its changes, and the scene's E and rho.
//
// Why a bound holds for every part of a scene: after changes d, what further iterations add is the
// sum of (rho F)^k d for k >= 1. Each application of rho F multiplies the total power by at most c,
// and the largest value likewise. So a part receives at most c / (1 - c) times the power of d, and
// at most rho / (1 - c) times the largest |d| on each patch.
#include "radiosity/reflected_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/channel_sums.h"
#include "radiosity/error_bounds.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"

namespace transillum {
namespace {

constexpr double dimmest_fraction = 0.1;  ///< fraction of the lit area

std::vector<Rgb> exitance_of(const Scene& scene, std::size_t per_patch) {
  std::vector<Rgb> exitance(per_patch * scene.patches().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    exitance[per_patch * static_cast<std::size_t>(i)] = scene.exitance(i);
  }
  return exitance;
}

/// 0 / 0 is 0; infinite where either exceeds the range of numbers.
double relative(double value, double unit) {
  if (value == 0) {
    return 0;
  }
  return unit > 0 && std::isfinite(value) && std::isfinite(unit) ? value / unit : HUGE_VAL;
}

}  // namespace

ReflectedLight::ReflectedLight(const Scene& scene, std::size_t per_patch)
    : ReflectedLight(exitance_of(scene, per_patch), per_patch) {}

ReflectedLight::ReflectedLight(std::vector<Rgb> exitance, std::size_t per_patch)
    : exitance_(std::move(exitance)), per_patch_(per_patch) {
  for (std::size_t u = 0; u < exitance_.size(); u += per_patch_) {
    emits_.push_back(max_abs(exitance_[u]) > 0 ? 1 : 0);
  }
}

std::vector<char> ReflectedLight::measured(const std::vector<Rgb>& b) const {
  std::vector<char> result(b.size());
  bool lit = false;
  for (std::size_t u = 0; u < b.size(); ++u) {
    result[u] = emits(u) ? 0 : 1;
    lit = lit || (result[u] != 0 && max_abs(b[u]) > 0);
  }
  if (!lit) {
    std::fill(result.begin(), result.end(), char{1});
  }
  return result;
}

std::vector<Rgb> ReflectedLight::of(const std::vector<Rgb>& b) const {
  const std::vector<char> is_measured = measured(b);
  std::vector<Rgb> result(b.size());
  for (std::size_t u = 0; u < b.size(); ++u) {
    if (is_measured[u] != 0) {
      result[u] = of(u, b[u]);
    }
  }
  return result;
}

RemainderBound::RemainderBound(ReflectedLight light, std::vector<double> area,
                               std::vector<Rgb> reflectance, std::size_t per_patch)
    : light_(std::move(light)),
      area_(std::move(area)),
      reflectance_(std::move(reflectance)),
      per_patch_(per_patch) {}

RemainderBound::Unknowns RemainderBound::dimmest(Unknowns lit, const std::vector<Rgb>& reflected,
                                                 double Rgb::*channel) const {
  double area = 0;
  for (const std::size_t u : lit) {
    area += area_[u];
  }
  std::sort(lit.begin(), lit.end(), [&](std::size_t u, std::size_t v) {
    return std::pair(std::abs(reflected[u].*channel), u) <
           std::pair(std::abs(reflected[v].*channel), v);
  });
  std::size_t count = 0;
  for (double taken = 0; count < lit.size() && taken < dimmest_fraction * area; ++count) {
    taken += area_[lit[count]];
  }
  lit.resize(count);
  return lit;
}

template <class BoundOf>
void RemainderBound::describe_unknowns(IterationRecord& record, const std::vector<Rgb>& b,
                                       BoundOf bound_of) const {
  const std::vector<char> measured = light_.measured(b);
  const std::vector<Rgb> reflected = light_.of(b);
  const double least = least_light * max_norm(reflected);
  Unknowns all;
  double area = 0, unlit = 0;
  for (std::size_t u = 0; u < b.size(); u += per_patch_) {
    if (measured[u] == 0) {
      continue;
    }
    all.push_back(u);
    if (max_abs(reflectance_[u]) > 0) {
      area += area_[u];
      unlit += max_abs(reflected[u]) > least ? 0.0 : area_[u];
    }
  }
  record.unlit_area = ratio_or_zero(unlit, area);
  record.remainder = record.remainder_dimmest = 0;
  const auto power_of = [&](const Unknowns& unknowns, double Rgb::*channel) {
    double power = 0;
    for (const std::size_t u : unknowns) {
      power += area_[u] * std::abs(reflected[u].*channel);
    }
    return power;
  };
  double most = 0;
  for (const auto channel : channels_of_rgb) {
    most = std::max(most, power_of(all, channel));
  }
  for (const auto channel : channels_of_rgb) {
    Unknowns lit;
    for (const std::size_t u : all) {
      if (std::abs(reflected[u].*channel) > least) {
        lit.push_back(u);
      }
    }
    // A channel that is unlit everywhere is compared with the brightest one.
    const double power = lit.empty() ? most : power_of(all, channel);
    record.remainder = std::max(record.remainder, relative(bound_of(all, channel), power));
    const Unknowns dim = dimmest(std::move(lit), reflected, channel);
    record.remainder_dimmest = std::max(record.remainder_dimmest,
                                        relative(bound_of(dim, channel), power_of(dim, channel)));
  }
}

void RemainderBound::describe(IterationRecord& record, const std::vector<Rgb>& b,
                              const std::vector<Rgb>& changes, double contraction,
                              double largest_change) const {
  record.change = relative_change(b, changes);
  record.change_of_b = ratio_or_zero(max_norm(changes), max_norm(b));
  const double beyond = ratio_or_zero(largest_change, max_norm(changes));
  record.changes = std::max(1.0, beyond) * largest_magnitudes(changes);
  describe_unknowns(record, b, [&](const Unknowns& unknowns, double Rgb::*channel) {
    double power = 0, largest = largest_change, reflecting = 0;
    for (std::size_t u = 0; u < changes.size(); ++u) {
      power += area_[u] * std::abs(changes[u].*channel);
      largest = std::max(largest, std::abs(changes[u].*channel));
    }
    for (const std::size_t u : unknowns) {
      reflecting += area_[u] * reflectance_[u].*channel;
    }
    return std::min(contraction * distance_to_limit(power, contraction),
                    reflecting * distance_to_limit(largest, contraction));
  });
}

void RemainderBound::describe(IterationRecord& record, const std::vector<Rgb>& b,
                              const std::vector<Rgb>& left) const {
  describe_unknowns(record, b, [&](const Unknowns& unknowns, double Rgb::*channel) {
    double power = 0;
    for (const std::size_t u : unknowns) {
      power += area_[u] * std::abs(left[u].*channel);
    }
    return power;
  });
}

double RemainderBound::relative_change(const std::vector<Rgb>& b,
                                       const std::vector<Rgb>& changes) const {
  return ratio_or_zero(max_norm(changes), max_norm(light_.of(b)));
}

double RemainderBound::changed_power(const std::vector<Rgb>& changes,
                                     const std::vector<Rgb>& from_sky) const {
  double largest = 0;
  for (const auto channel : channels_of_rgb) {
    double changed = 0, emitted = 0;
    for (std::size_t u = 0; u < changes.size(); ++u) {
      changed += area_[u] * std::abs(changes[u].*channel);
      emitted += area_[u] * light_.exitance()[u].*channel;
      if (!from_sky.empty() && u % per_patch_ == 0) {
        emitted += area_[u] * from_sky[u / per_patch_].*channel;
      }
    }
    largest = std::max(largest, ratio_or_zero(changed, emitted));
  }
  return largest;
}

bool is_all_light_lost(const Solution& solution) {
  const Scene& scene = *solution.scene;
  double area = 0, seen = 0;
  for (std::size_t i = 0; i < solution.form_factor_sums.size(); ++i) {
    if (max_abs(solution.irradiance[i]) > 0) {
      return false;
    }
    area += scene.patches()[i].area;
    seen += solution.form_factor_sums[i] * scene.patches()[i].area;
  }
  return scene.has_light() && seen > area / 2;
}

}  // namespace transillum
