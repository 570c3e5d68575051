// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/patch_builder.h"

namespace transillum {

Scene::Scene(const SceneDescription& description, const SceneOptions& options,
             const Cancellation& cancellation)
    : name_(description.name),
      files_(description.files),
      options_(options),
      materials_(description.materials),
      groups_(description.groups) {
  if (!(options.max_patch_area >= 0 && std::isfinite(options.max_patch_area))) {
    throw InputError(fmt::format("the maximum patch area is {} m², but must be finite and >= 0",
                                 options.max_patch_area));
  }
  check_description(description);
  PatchBuilder builder(description, options_, cancellation);
  builder.build();
  points_ = builder.table.take();
  patches_ = std::move(builder.patches);
  for (Patch& patch : patches_) {
    patch.group = description.group_of(static_cast<std::size_t>(patch.face));
    if (!description.face_number.empty()) {
      patch.face = at(description.face_number, patch.face);
    }
  }
  outline_corners_ = std::move(builder.outline_corners);
  pieces_ = std::move(builder.pieces);
  piece_corners_ = std::move(builder.piece_corners);
  report_ = std::move(builder.report);
  for (const PointId p : outline_corners_) {
    bounds_.add(point(p));
  }
}

Scene::Scene(const Scene& other, std::vector<Material> materials,
             const std::vector<std::int32_t>& of_patch)
    : Scene(other) {
  materials_ = std::move(materials);
  for (PatchId i = 0; i < patch_count(); ++i) {
    at(patches_, i).material = at(of_patch, i);
  }
}

Scene::Scene(const Scene& other, WithoutPatches)
    : name_(other.name_),
      files_(other.files_),
      options_(other.options_),
      materials_(other.materials_),
      groups_(other.groups_),
      bounds_(other.bounds_),
      report_(other.report_) {}

bool Scene::has_light() const {
  return std::any_of(patches_.begin(), patches_.end(), [this](const Patch& patch) {
    return max_abs(at(materials_, patch.material).exitance) > 0;
  });
}

void ReadOptions::validate() const {
  const auto check = [](const char* what, double rho) {
    if (!(rho >= 0 && rho < 1)) {
      throw InputError(fmt::format("the {} is {}, but must be >= 0 and < 1", what, rho));
    }
  };
  check("default reflectance", default_reflectance);
  check("maximum reflectance", max_reflectance.value_or(default_max_reflectance));
  if (!(scale > 0 && std::isfinite(scale))) {
    throw InputError(fmt::format("the scale is {}, but must be finite and > 0", scale));
  }
}

namespace {

constexpr std::array<std::pair<const char*, double>, 5> length_units{
    {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}}};

}  // namespace

std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const auto& unit : length_units) {
    names.emplace_back(unit.first);
  }
  return names;
}

double length_unit_from_name(const std::string& name) {
  for (const auto& [unit, meters] : length_units) {
    if (name == unit) {
      return meters;
    }
  }
  throw InputError(fmt::format("unknown unit of length {}; choose one of {}", in_quotes(name),
                               fmt::join(length_unit_names(), ", ")));
}

std::shared_ptr<const Scene> load_scene(const std::string& spec, const SceneOptions& options,
                                        const ReadOptions& read, const Cancellation& cancellation) {
  return std::make_shared<const Scene>(describe_scene(spec, read, cancellation), options,
                                       cancellation);
}

}  // namespace transillum
