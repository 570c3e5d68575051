// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/description_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text_file.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using Channels = std::array<std::pair<const char*, double>, 3>;

Channels channels(const Rgb& value) {
  return {{{"red", value.r}, {"green", value.g}, {"blue", value.b}}};
}

void check_points(const SceneDescription& description) {
  for (std::size_t i = 0; i < description.points.size(); ++i) {
    const Vec3& p = description.points[i];
    if (!is_finite(p)) {
      throw InputError(
          fmt::format("{}: vertex {}: a coordinate is not a finite number", description.name, i));
    }
    if (max_abs(p) > largest_coordinate) {
      throw InputError(fmt::format("{}: vertex {}: coordinate {} exceeds {}", description.name, i,
                                   max_abs(p), largest_coordinate));
    }
  }
}

void check_faces(const SceneDescription& description) {
  const auto point_count = static_cast<std::int64_t>(description.points.size());
  const auto material_count = static_cast<std::int32_t>(description.materials.size());
  const auto group_count = static_cast<std::int32_t>(description.groups.size());
  if (!description.face_group.empty() &&
      description.face_group.size() != description.face_count()) {
    throw InputError(fmt::format("{}: groups of {} faces, but there are {} faces", description.name,
                                 description.face_group.size(), description.face_count()));
  }
  if (!description.face_two_sided.empty() &&
      description.face_two_sided.size() != description.face_count()) {
    throw InputError(fmt::format("{}: sides of {} faces, but there are {} faces", description.name,
                                 description.face_two_sided.size(), description.face_count()));
  }
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    for (const PointId p : description.outline(f)) {
      if (p < 0 || p >= point_count) {
        throw InputError(fmt::format("{}vertex index {} is out of range; there are {} vertices",
                                     face_place(description, f), p, point_count));
      }
    }
    const std::int32_t material = description.face_material[f];
    if (material < 0 || material >= material_count) {
      throw InputError(fmt::format("{}material {} is out of range; there are {} materials",
                                   face_place(description, f), material, material_count));
    }
    const std::int32_t group = description.group_of(f);
    if (group != no_group && (group < 0 || group >= group_count)) {
      throw InputError(fmt::format("{}group {} is out of range; there are {} groups",
                                   face_place(description, f), group, group_count));
    }
  }
}

void check_face_numbers(const SceneDescription& description) {
  const std::vector<std::int32_t>& numbers = description.face_number;
  if (numbers.empty()) {
    return;
  }
  if (numbers.size() != description.face_count()) {
    throw InputError(fmt::format("{}: there are {} face numbers for {} faces", description.name,
                                 numbers.size(), description.face_count()));
  }
  for (std::size_t f = 0; f < numbers.size(); ++f) {
    const std::int32_t least = f > 0 ? numbers[f - 1] : 0;
    if (numbers[f] < least) {
      throw InputError(fmt::format("{}has the face number {}, but must have at least {}",
                                   face_place(description, f), numbers[f], least));
    }
  }
}

/// Checks only the materials in use: an MTL file may contain others.
void check_used_materials(const SceneDescription& description) {
  std::vector<bool> used(description.materials.size());
  for (const std::int32_t m : description.face_material) {
    at(used, m) = true;
  }
  double largest = 0;
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (used[m]) {
      check_material(description.materials[m], description.name + ": ");
      largest = std::max(largest, max_abs(description.materials[m].exitance));
    }
  }
  if (largest > 0 && largest < smallest_exitance) {
    throw InputError(fmt::format("{}: the largest exitance E is {}, but must be 0 or at least {}",
                                 description.name, largest, smallest_exitance));
  }
}

}  // namespace

std::string face_place(const SceneDescription& description, std::size_t face) {
  const std::int32_t line = description.face_line[face], number = description.number_of(face);
  if (line > 0) {
    return fmt::format("{}:{}: face {}: ", description.name, line, number);
  }
  return fmt::format("{}: face {}: ", description.name, number);
}

void check_reflectance(const Rgb& reflectance, const std::string& place) {
  for (const auto& [channel, rho] : channels(reflectance)) {
    if (!(rho >= 0 && rho < 1)) {
      throw InputError(fmt::format("{}{} reflectance rho (Kd) is {}, but must be >= 0 and < 1",
                                   place, channel, rho));
    }
  }
}

void check_exitance(const Rgb& exitance, const std::string& place) {
  for (const auto& [channel, e] : channels(exitance)) {
    if (!(e >= 0 && e <= largest_exitance)) {
      throw InputError(fmt::format("{}{} exitance E (Ke) is {}, but must be >= 0 and at most {}",
                                   place, channel, e, largest_exitance));
    }
  }
}

void check_lobe(const Lobe& lobe, const std::string& place) {
  for (const auto& [channel, fraction] : channels(lobe.reflectance)) {
    if (!(fraction >= 0 && std::isfinite(fraction))) {
      throw InputError(
          fmt::format("{}{} reflectance of the lobe (Ks) is {}, but must be finite and >= 0", place,
                      channel, fraction));
    }
  }
  if (!(lobe.exponent >= 0 && lobe.exponent <= largest_exponent)) {
    throw InputError(
        fmt::format("{}the exponent of the lobe (Ns) is {}, but must be >= 0 and at most {}", place,
                    lobe.exponent, largest_exponent));
  }
  if (!(lobe.roughness >= 0 && lobe.roughness <= 1)) {
    throw InputError(
        fmt::format("{}the roughness of the lobe (Pr) is {}, but must be >= 0 and at most 1", place,
                    lobe.roughness));
  }
}

void check_material(const Material& material, const std::string& place) {
  const std::string named = fmt::format("{}material {}: ", place, in_quotes(material.name));
  check_reflectance(material.reflectance, named);
  check_exitance(material.exitance, named);
  check_lobe(material.lobe, named);
}

void check_description(const SceneDescription& description) {
  if (description.points.empty()) {
    throw InputError(description.name + ": no vertices");
  }
  if (description.face_count() == 0) {
    throw InputError(description.name + ": no faces");
  }
  check_points(description);
  check_faces(description);
  check_face_numbers(description);
  check_used_materials(description);
}

}  // namespace transillum
