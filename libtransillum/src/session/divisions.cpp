// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "session/divisions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "radiosity/error/surfaces.h"
#include "scene/build/division.h"
#include "scene/build/patch_count.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/map/shadow_edges.h"

namespace transillum {
namespace {

constexpr std::string_view numbers_begin = "patch:";

constexpr std::string_view shadows_begin = "shadows:";

bool is_by_shadows(const std::string& name) { return name.rfind(shadows_begin, 0) == 0; }

/// The direction to the light of "shadows:0,-0.5,1".
/// @throws InputError
Vec3 direction_of_shadows(const std::string& name) {
  Vec3 direction;
  const char* begin = name.data() + shadows_begin.size();
  const char* const end = name.data() + name.size();
  bool valid = true;
  for (double* value : {&direction.x, &direction.y, &direction.z}) {
    const auto read = std::from_chars(begin, end, *value);
    const bool is_last = value == &direction.z;
    valid = valid && read.ec == std::errc() && std::isfinite(*value) &&
            (is_last ? read.ptr == end : read.ptr != end && *read.ptr == ',');
    begin = valid && !is_last ? read.ptr + 1 : end;
  }
  const double length = norm(direction);
  if (!valid || !(length > 0) || !std::isfinite(length)) {
    throw InputError(fmt::format(
        "division of patches: \"{}\" is not a direction to the light, such as shadows:1,0,2",
        name));
  }
  return (1 / length) * direction;
}

std::shared_ptr<const Scene> divided_along_shadows(const Scene& scene, const Vec3& to_light,
                                                   const Cancellation& cancellation) {
  const BspTree tree(scene, cancellation);
  const MapRecord record = record_local_map(scene, tree, -to_light, cancellation).record;
  std::vector<PatchCut> cuts;
  for (const ShadowEdge& edge : shadow_edges(scene, tree, record)) {
    cuts.push_back({edge.patch, edge.a, edge.b});
  }
  return divide_along(scene, cuts, cancellation).scene;
}

bool is_by_numbers(const std::string& name) { return name.rfind(numbers_begin, 0) == 0; }

/// The first and the last number of "7-20" or "3".
/// @throws InputError
std::pair<PatchId, PatchId> range_of(std::string_view text, PatchId patch_count) {
  PatchId first = -1, last = -1;
  const char* const end = text.data() + text.size();
  auto read = std::from_chars(text.data(), end, first);
  last = first;
  if (read.ec == std::errc() && read.ptr != end && *read.ptr == '-') {
    read = std::from_chars(read.ptr + 1, end, last);
  }
  if (read.ec != std::errc() || read.ptr != end || first < 0 || first > last ||
      last >= patch_count) {
    throw InputError(fmt::format(
        "division of patches: \"{}\" is not a patch or a range of patches from 0 to {}, such as "
        "7-20",
        text, patch_count - 1));
  }
  return {first, last};
}

/// The patches of "patch:3,7-20".
/// @throws InputError
std::vector<PatchId> numbered_patches(const Scene& scene, std::string_view name) {
  std::vector<PatchId> patches;
  for (std::size_t begin = numbers_begin.size(); begin <= name.size();) {
    const std::size_t end = std::min(name.find(',', begin), name.size());
    const auto [first, last] = range_of(name.substr(begin, end - begin), scene.patch_count());
    for (PatchId i = first; i <= last; ++i) {
      patches.push_back(i);
    }
    begin = end + 1;
  }
  return patches;
}

/// The patches of a surface or of all. A surface counts alone whatever its area.
std::vector<PatchId> named_patches(const Scene& scene, const std::string& name) {
  return name == all_patches_name ? all_patches(scene) : patches_of_surface(scene, name, {name});
}

/// The patches of an entry of SceneInput::divided.
/// @throws InputError
std::vector<PatchId> patches_of(const Scene& scene, const std::string& name) {
  if (is_by_numbers(name)) {
    return numbered_patches(scene, name);
  }
  std::vector<PatchId> patches = named_patches(scene, name);
  if (patches.empty()) {
    std::string known;
    for (const auto& surface : find_surfaces(scene, Measured::reflecting).surfaces) {
      known += fmt::format(", \"{}\"", surface.name);
    }
    throw InputError(
        fmt::format("division of patches: there is no surface \"{}\" whose patches reflect and do "
                    "not emit; there are \"{}\"{}",
                    name, all_patches_name, known));
  }
  return patches;
}

}  // namespace

std::vector<PatchId> all_patches(const Scene& scene) {
  std::vector<PatchId> patches(scene.patches().size());
  std::iota(patches.begin(), patches.end(), PatchId{0});
  return patches;
}

std::vector<PatchId> patches_of_surface(const Scene& scene, const std::string& name,
                                        const std::vector<std::string>& kept) {
  std::vector<PatchId> patches;
  const Surfaces surfaces = find_surfaces(scene, Measured::reflecting, kept);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::int32_t s = surfaces.of(i);
    if (s != Surfaces::none && at(surfaces.surfaces, s).name == name) {
      patches.push_back(i);
    }
  }
  return patches;
}

std::string division_by_numbers(std::span<const PatchId> patches) {
  std::string name(numbers_begin);
  for (std::size_t k = 0; k < patches.size();) {
    std::size_t last = k;
    while (last + 1 < patches.size() && patches[last + 1] == patches[last] + 1) {
      ++last;
    }
    name += fmt::format("{}{}", k > 0 ? "," : "", patches[k]);
    name += last > k ? fmt::format("-{}", patches[last]) : "";
    k = last + 1;
  }
  return name;
}

std::string division_name(const Scene& scene, const std::string& name,
                          std::span<const PatchId> patches) {
  const bool is_entry = name.find(';') == std::string::npos && name != "none" &&
                        !is_by_numbers(name) && !is_by_shadows(name);
  const bool is_same = is_entry && std::ranges::equal(named_patches(scene, name), patches);
  return is_same ? name : division_by_numbers(patches);
}

std::string division_by_shadows(const Vec3& to_light) {
  return fmt::format("{}{},{},{}", shadows_begin, to_light.x, to_light.y, to_light.z);
}

std::shared_ptr<const Scene> divided_scene(std::shared_ptr<const Scene> scene,
                                           const std::vector<std::string>& names,
                                           const Cancellation& cancellation) {
  for (const std::string& name : names) {
    if (is_by_shadows(name)) {
      scene = divided_along_shadows(*scene, direction_of_shadows(name), cancellation);
      continue;
    }
    const std::vector<PatchId> patches = patches_of(*scene, name);
    std::int64_t count = scene->patch_count();
    for (const PatchId i : patches) {
      count += division_count(*scene, i) - 1;
    }
    check_memory(scene->name(), count);
    scene = divide(*scene, patches, cancellation).scene;
  }
  return scene;
}

}  // namespace transillum
