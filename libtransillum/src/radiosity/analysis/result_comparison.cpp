// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares the radiosity of two results, patch by patch. Input: two Solutions, from solves or from
// read_result().
#include "radiosity/analysis/result_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "radiosity/error/surface_errors.h"
#include "radiosity/error/surfaces.h"
#include "radiosity/norms.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

std::string text_of(const Rgb& c) { return fmt::format("{} {} {}", c.r, c.g, c.b); }

std::string outline_difference(const Scene& one, const Scene& other, PatchId i) {
  const auto a = one.outline(i), b = other.outline(i);
  if (a.size() != b.size()) {
    return fmt::format("patch {} has {} corners in one and {} in the other", i, a.size(), b.size());
  }
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec3 &p = one.point(a[k]), &q = other.point(b[k]);
    if (p != q) {
      return fmt::format("patch {} has corner {} at {} {} {} in one and {} {} {} in the other", i,
                         k, p.x, p.y, p.z, q.x, q.y, q.z);
    }
  }
  return {};
}

}  // namespace

std::string material_difference(const Scene& one, PatchId i, const Scene& other, PatchId j) {
  for (const auto& [name, a, b] : {std::tuple{"E", one.exitance(i), other.exitance(j)},
                                   {"rho", one.reflectance(i), other.reflectance(j)}}) {
    if (a != b) {
      return fmt::format("{} {} in one and {} in the other", name, text_of(a), text_of(b));
    }
  }
  return {};
}

std::string scene_difference(const Scene& one, const Scene& other) {
  if (one.patch_count() != other.patch_count()) {
    return fmt::format("one has {} patches and the other {}", one.patch_count(),
                       other.patch_count());
  }
  for (PatchId i = 0; i < one.patch_count(); ++i) {
    if (std::string outline = outline_difference(one, other, i); !outline.empty()) {
      return outline;
    }
    if (std::string material = material_difference(one, i, other, i); !material.empty()) {
      return fmt::format("patch {} has {}", i, material);
    }
  }
  return {};
}

namespace {

bool knows_sky(const Solution& solution) {
  return solution.sky.is_set() || solution.sky_irradiance.empty();
}

/// Whether two skies give the same light.
bool are_same(const Sky& one, const Sky& other) {
  return one.exitance == other.exitance &&
         (!one.is_set() || (one.sun == other.sun && one.model == other.model &&
                            (one.model == SkyModel::uniform || one.up == other.up)));
}

std::string text_of(const Sky& sky) {
  if (!sky.is_set()) {
    return "none";
  }
  const Sun& sun = sky.sun;
  std::string of_sun = sun.is_set()
                           ? fmt::format("a sun of {} W/m2 from {} {} {}{}",
                                         text_of(sun.irradiance), sun.direction.x, sun.direction.y,
                                         sun.direction.z, sun.disc ? ", a disc" : "")
                           : "";
  if (!sky.is_bright()) {
    return of_sun;
  }
  std::string text = fmt::format("a sky of {} W/m2, {}", text_of(sky.exitance), name_of(sky.model));
  if (sky.model != SkyModel::uniform) {
    text += fmt::format(", up {} {} {}", sky.up.x, sky.up.y, sky.up.z);
  }
  return sun.is_set() ? text + " and " + of_sun : text;
}

}  // namespace

std::string sky_difference(const Solution& one, const Solution& other) {
  if (!knows_sky(one) || !knows_sky(other) || are_same(one.sky, other.sky)) {
    return {};
  }
  return fmt::format("one has {}, and the other has {}", text_of(one.sky), text_of(other.sky));
}

namespace {

PatchLight light_of(const Solution& solution) {
  PatchLight light{{}, solution.radiosity};
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    light.exitance.push_back(solution.scene->exitance(i));
  }
  return light;
}

/// The surfaces of a scene, without patches that emit in either result, unless all do.
Surfaces compared_surfaces(const Scene& scene, const PatchLight& first, const PatchLight& second) {
  Surfaces all = find_surfaces(scene, Measured::reflecting);
  Surfaces result;
  std::vector<std::int32_t> places(all.surfaces.size(), Surfaces::none);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::int32_t of = all.of(i);
    const bool emits = max_abs(at(first.exitance, i)) > 0 || max_abs(at(second.exitance, i)) > 0;
    if (of == Surfaces::none || emits) {
      result.of_patch.push_back(Surfaces::none);
      continue;
    }
    std::int32_t& place = at(places, of);
    if (place == Surfaces::none) {
      place = static_cast<std::int32_t>(result.surfaces.size());
      result.surfaces.push_back({.name = at(all.surfaces, of).name});
    }
    Surfaces::Surface& surface = at(result.surfaces, place);
    ++surface.patches;
    surface.area += scene.patch(i).area;
    result.of_patch.push_back(place);
  }
  return result.surfaces.empty() ? all : result;
}

/// All compared patches as one surface.
Surfaces as_one(const Surfaces& surfaces) {
  Surfaces whole;
  whole.surfaces.emplace_back();
  for (const Surfaces::Surface& surface : surfaces.surfaces) {
    whole.surfaces.front().patches += surface.patches;
    whole.surfaces.front().area += surface.area;
  }
  for (const std::int32_t of : surfaces.of_patch) {
    whole.of_patch.push_back(of == Surfaces::none ? of : 0);
  }
  return whole;
}

/// The largest |difference| of a channel over its unit; 0 / 0 is 0.
double relative_size(const Rgb& difference, const Rgb& unit) {
  if (max_abs(difference) > 0 && !(max_abs(unit) > 0)) {
    return std::numeric_limits<double>::infinity();
  }
  return largest_ratio({std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)},
                       unit);
}

}  // namespace

ResultComparison compare_light(const Scene& scene, const PatchLight& first,
                               const PatchLight& second) {
  const Surfaces surfaces = compared_surfaces(scene, first, second);
  const std::vector<Rgb> reflected = difference(first.radiosity, first.exitance);
  const std::vector<Rgb> differences = difference(second.radiosity, first.radiosity);
  const SurfaceErrors errors = surface_differences(surfaces, reflected, differences);
  ResultComparison result;
  for (const SurfaceError& of : errors.surfaces) {
    result.surfaces.push_back({.name = of.name,
                               .patches = of.patches,
                               .level = of.level,
                               .unit = of.unit,
                               .is_dark = of.is_dark,
                               .rms = of.rms});
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::int32_t of = surfaces.of(i);
    if (of == Surfaces::none) {
      result.units.emplace_back();
      continue;
    }
    SurfaceDifference& surface = at(result.surfaces, of);
    result.units.push_back(surface.unit);
    const double size = relative_size(at(differences, i), surface.unit);
    if (size > surface.largest) {
      surface.largest = size;
      surface.worst = i;
      surface.first = at(first.radiosity, i);
      surface.second = at(second.radiosity, i);
    }
  }
  std::stable_sort(
      result.surfaces.begin(), result.surfaces.end(),
      [](const SurfaceDifference& a, const SurfaceDifference& b) { return a.rms > b.rms; });
  result.rms = surface_differences(as_one(surfaces), reflected, differences).limit;
  return result;
}

ResultComparison compare_results(const Solution& first, const Solution& second) {
  const Scene& scene = *first.scene;
  if (const std::string difference = scene_difference(scene, *second.scene); !difference.empty()) {
    throw InputError("the results are of different scenes: " + difference);
  }
  ResultComparison comparison = compare_light(scene, light_of(first), light_of(second));
  comparison.sky_difference = sky_difference(first, second);
  return comparison;
}

}  // namespace transillum
