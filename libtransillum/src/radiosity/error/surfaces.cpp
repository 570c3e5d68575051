// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Divides the patches of a scene into the surfaces that a reader would name.
#include "radiosity/error/surfaces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <set>

#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

constexpr double least_fraction = 0.01;  ///< fraction of the measured area

/// Names by key, and the key of each patch.
struct Division {
  std::map<std::int64_t, std::string> names;
  std::vector<std::int64_t> key;
};

Division by_group(const Scene& scene) {
  Division division;
  const auto last = std::ssize(scene.groups());
  for (const Patch& patch : scene.patches()) {
    const std::int64_t key = patch.group == no_group ? last : patch.group;
    division.names.try_emplace(key, key == last ? "no group" : at(scene.groups(), patch.group));
    division.key.push_back(key);
  }
  return division;
}

Division by_material(const Scene& scene) {
  Division division;
  for (const Patch& patch : scene.patches()) {
    division.names.try_emplace(patch.material, at(scene.materials(), patch.material).name);
    division.key.push_back(patch.material);
  }
  return division;
}

/// Patches that share a point are connected.
Division by_component(const Scene& scene) {
  boost::disjoint_sets_with_storage<> sets(scene.points().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    for (const PointId p : outline) {
      sets.union_set(static_cast<std::size_t>(outline.front()), static_cast<std::size_t>(p));
    }
  }
  Division division;
  std::map<std::size_t, std::int64_t> numbers;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::size_t root = sets.find_set(static_cast<std::size_t>(scene.outline(i).front()));
    const auto [place, is_new] = numbers.try_emplace(root, std::ssize(numbers));
    if (is_new) {
      division.names[place->second] = fmt::format("component {}", place->second);
    }
    division.key.push_back(place->second);
  }
  return division;
}

/// Keys of measured patches.
std::set<std::int64_t> measured_keys(const Division& division, const std::vector<char>& measured) {
  std::set<std::int64_t> keys;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i] != 0) {
      keys.insert(division.key[i]);
    }
  }
  return keys;
}

std::vector<char> measured_patches(const Scene& scene, Measured measured) {
  std::vector<char> result;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const bool reflects =
        measured == Measured::receiving || max_abs(scene.reflectance(i)) > 0 ||
        (measured == Measured::reflecting_with_lobes && used_lobe(scene.material(i)).present());
    result.push_back(reflects && !(max_abs(scene.exitance(i)) > 0) ? 1 : 0);
  }
  if (std::find(result.begin(), result.end(), 1) == result.end()) {
    std::fill(result.begin(), result.end(), char{1});
  }
  return result;
}

Division divide(const Scene& scene, const std::vector<char>& measured) {
  Division division = by_group(scene);
  if (measured_keys(division, measured).size() < 2) {
    division = by_material(scene);
  }
  if (measured_keys(division, measured).size() < 2) {
    division = by_component(scene);
  }
  return division;
}

}  // namespace

Surfaces find_surfaces(const Scene& scene, Measured measured,
                       const std::vector<std::string>& kept) {
  const std::vector<char> is_measured = measured_patches(scene, measured);
  const Division division = divide(scene, is_measured);
  std::map<std::int64_t, Surfaces::Surface> sums;
  double area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (at(is_measured, i) != 0) {
      Surfaces::Surface& sum = sums[at(division.key, i)];
      ++sum.patches;
      sum.area += scene.patch(i).area;
      area += scene.patch(i).area;
    }
  }
  Surfaces result;
  Surfaces::Surface others{.name = "others"};
  std::map<std::int64_t, std::int32_t> places;
  for (auto& [key, sum] : sums) {
    sum.name = division.names.at(key);
    const bool alone = sum.area >= least_fraction * area ||
                       std::find(kept.begin(), kept.end(), sum.name) != kept.end();
    places[key] = alone ? static_cast<std::int32_t>(result.surfaces.size()) : Surfaces::none;
    if (alone) {
      result.surfaces.push_back(sum);
    } else {
      others.patches += sum.patches;
      others.area += sum.area;
    }
  }
  const auto last = static_cast<std::int32_t>(result.surfaces.size());
  if (others.patches > 0) {
    result.surfaces.push_back(others);
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (at(is_measured, i) == 0) {
      result.of_patch.push_back(Surfaces::none);
    } else {
      const std::int32_t place = places.at(at(division.key, i));
      result.of_patch.push_back(place == Surfaces::none ? last : place);
    }
  }
  return result;
}

void check_surfaces(const Scene& scene, const std::vector<std::string>& names) {
  std::set<std::string> known;
  for (const Surfaces::Surface& surface :
       find_surfaces(scene, Measured::receiving, names).surfaces) {
    known.insert(surface.name);
  }
  for (const std::string& name : names) {
    if (!known.contains(name)) {
      throw InputError(fmt::format("accuracy: there is no surface \"{}\"; the scene has {}", name,
                                   fmt::join(known, ", ")));
    }
  }
}

}  // namespace transillum
