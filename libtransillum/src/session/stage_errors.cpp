// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "session/stage_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "radiosity/norms.h"
#include "radiosity/reflected_light.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/first_shot.h"

namespace transillum {
namespace {

/// The same levels and names, and errors of 0.
ErrorEstimate without_errors(const ErrorEstimate& error) {
  ErrorEstimate result;
  result.replicas = error.replicas;
  result.quantile = error.quantile;
  result.standard_error.resize(error.standard_error.size());
  result.mean_reflected = error.mean_reflected;
  result.surfaces = error.surfaces;
  result.irradiance = error.irradiance;
  for (SurfaceErrors* errors : {&result.surfaces, &result.irradiance}) {
    for (SurfaceError& surface : errors->surfaces) {
      surface.spread = surface.bias = surface.rms = surface.limit = 0;
    }
    errors->limit = 0;
  }
  return result;
}

double largest_error(const Scene& scene, const std::vector<Rgb>& b, const ErrorEstimate& error) {
  const std::vector<char> measured = ReflectedLight(scene).measured(b);
  Rgb largest;
  for (std::size_t i = 0; i < b.size(); ++i) {
    largest = measured[i] != 0 ? largest_of(largest, error.standard_error[i]) : largest;
  }
  return error.quantile *
         largest_ratio(largest, channel_units(largest_magnitudes(reflected_light(scene, b))));
}

}  // namespace

double error_for(const AccuracyGoal& goal, const Scene& scene, const std::vector<Rgb>& b,
                 const ErrorEstimate& error) {
  if (goal.of == AccuracyOf::patch && goal.patch >= scene.patch_count()) {
    throw InputError(fmt::format("accuracy: there is no patch {}; the scene has {}, from 0",
                                 goal.patch, scene.patch_count()));
  }
  if (goal.of == AccuracyOf::groups) {
    check_surfaces(scene, goal.surfaces);
  }
  if (error.replicas == 0) {
    return std::numeric_limits<double>::infinity();
  }
  switch (goal.of) {
    case AccuracyOf::surfaces:
      return error.surfaces.limit;
    case AccuracyOf::groups:
      return limit_of_all(error.surfaces, goal.surfaces);
    case AccuracyOf::irradiance:
      return error.irradiance.limit;
    case AccuracyOf::max:
      return largest_error(scene, b, error);
    case AccuracyOf::patch:
      return error.quantile *
             largest_ratio(at(error.standard_error, goal.patch),
                           channel_units(at(b, goal.patch) - scene.exitance(goal.patch)));
    case AccuracyOf::mean:
      return error.quantile *
             largest_ratio(error.mean_standard_error, channel_units(error.mean_reflected));
    case AccuracyOf::rms:
      break;
  }
  return error.rms_limit;
}

void name_worst_surface(const AccuracyGoal& goal, const ErrorEstimate& error,
                        AccuracyReport& report) {
  report.surface.clear();
  report.is_dark = false;
  const bool of_surfaces = goal.of == AccuracyOf::surfaces || goal.of == AccuracyOf::groups;
  if (!of_surfaces && goal.of != AccuracyOf::irradiance) {
    return;
  }
  double largest = -1;
  for (const SurfaceError& surface : (of_surfaces ? error.surfaces : error.irradiance).surfaces) {
    const bool counts =
        goal.of != AccuracyOf::groups ||
        std::find(goal.surfaces.begin(), goal.surfaces.end(), surface.name) != goal.surfaces.end();
    if (counts && surface.limit > largest) {
      largest = surface.limit;
      report.surface = surface.name;
      report.is_dark = surface.is_dark;
    }
  }
}

double StageErrors::of_bias(const std::vector<Rgb>& bias) const {
  if (result_.error.replicas == 0) {
    return 0;
  }
  ErrorEstimate missing = without_errors(result_.error);
  include_bias(missing, result_.scene, surfaces_, result_.radiosity, bias);
  return error_for(goal_, result_.scene, result_.radiosity, missing);
}

double StageErrors::of_iteration() const {
  return of_bias(bias_of_iteration(surfaces_, result_.statistics));
}

double StageErrors::of_shot() const { return of_shot(*result_.shot); }

double StageErrors::of_shot(const DirectLight& shot) const {
  return of_bias(bias_of_shot(result_.scene, surfaces_, shot));
}

std::optional<Rgb> StageErrors::unit_of(PatchId patch) const {
  switch (goal_.of) {
    case AccuracyOf::surfaces:
    case AccuracyOf::groups:
    case AccuracyOf::irradiance:
      break;
    case AccuracyOf::patch:
      return patch == goal_.patch ? std::optional(channel_units(at(result_.radiosity, patch) -
                                                                result_.scene.exitance(patch)))
                                  : std::nullopt;
    case AccuracyOf::rms:
    case AccuracyOf::max:
    case AccuracyOf::mean:
      return channel_units(result_.error.mean_reflected);
  }
  const bool of_h = goal_.of == AccuracyOf::irradiance;
  const std::int32_t s = (of_h ? surfaces_.receiving : surfaces_.reflecting).of(patch);
  if (s == Surfaces::none) {
    return {};
  }
  const SurfaceError& surface =
      at((of_h ? result_.error.irradiance : result_.error.surfaces).surfaces, s);
  const bool counts =
      goal_.of != AccuracyOf::groups ||
      std::find(goal_.surfaces.begin(), goal_.surfaces.end(), surface.name) != goal_.surfaces.end();
  return counts ? std::optional(surface.unit) : std::nullopt;
}

/// How much of the error of a result the direct light of each patch makes, up to a common factor:
/// of its own, or by what it reflects to where light is least.
std::vector<double> StageErrors::shares_of_shot() const {
  const Scene& scene = result_.scene;
  std::vector<std::optional<Rgb>> units;
  Rgb least{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    units.push_back(unit_of(i));
    if (const std::optional<Rgb>& unit = units.back()) {
      least = {std::min(least.r, unit->r), std::min(least.g, unit->g), std::min(least.b, unit->b)};
    }
  }
  const double area = total_area(scene);
  const bool of_h = goal_.of == AccuracyOf::irradiance;
  std::vector<double> shares;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb rho = at(surfaces_.reflectance, i);
    const std::optional<Rgb>& unit = at(units, i);
    const auto share = [&](const Rgb& error) {
      const double reflected = scene.patch(i).area / area * largest_ratio(rho * error, least);
      return unit ? std::max(reflected, largest_ratio(of_h ? error : rho * error, *unit))
                  : reflected;
    };
    double most = share(at(result_.shot->irradiance_error, i));
    if (!result_.shot->linear_term_errors.empty()) {
      const LinearTerm& terms = at(result_.shot->linear_term_errors, i);
      most = std::max({most, share(terms.first), share(terms.second)});
    }
    shares.push_back(most);
  }
  return shares;
}

std::vector<PatchId> StageErrors::patches_to_refine(double allowed) const {
  const std::vector<double> shares = shares_of_shot();
  std::vector<PatchId> order(shares.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](PatchId i, PatchId j) { return at(shares, i) > at(shares, j); });
  const auto suffices = [&](std::size_t count) {
    DirectLight rest;
    rest.irradiance_error = result_.shot->irradiance_error;
    rest.linear_term_errors = result_.shot->linear_term_errors;
    for (std::size_t k = 0; k < count; ++k) {
      at(rest.irradiance_error, order[k]) = {};
      if (!rest.linear_term_errors.empty()) {
        at(rest.linear_term_errors, order[k]) = {};
      }
    }
    return of_shot(rest) <= allowed;
  };
  std::size_t low = 0, high = order.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (suffices(middle)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  order.resize(high);
  return order;
}

}  // namespace transillum
