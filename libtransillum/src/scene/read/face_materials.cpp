// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/face_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/read/reflectance_limit.h"

namespace transillum {
namespace {

constexpr double color_parts = 1024;

}  // namespace

FaceMaterials::FaceMaterials(SceneDescription& description, const ReadOptions& options)
    : description_(description), options_(options) {}

std::int32_t FaceMaterials::of_color(const Rgb& reflectance, const Rgb& exitance) {
  const auto rounded = [](double v) {
    return std::round(std::clamp(v, 0.0, 1.0) * color_parts) / color_parts;
  };
  Rgb rho{rounded(reflectance.r), rounded(reflectance.g), rounded(reflectance.b)};
  lower_reflectance(rho, options_);
  const auto next = static_cast<std::int32_t>(description_.materials.size());
  const auto [entry, is_new] =
      numbers_.try_emplace({rho.r, rho.g, rho.b, exitance.r, exitance.g, exitance.b}, next);
  if (is_new) {
    description_.materials.push_back(
        {fmt::format("color {:.3g} {:.3g} {:.3g}", rho.r, rho.g, rho.b), rho, exitance});
  }
  return entry->second;
}

std::int32_t FaceMaterials::without_color() {
  if (without_ < 0) {
    const double rho = options_.default_reflectance;
    without_ = static_cast<std::int32_t>(description_.materials.size());
    description_.materials.push_back({"no-material", {rho, rho, rho}, {}});
  }
  ++faces_without_;
  return without_;
}

void FaceMaterials::note(Warnings& notes, const char* format) const {
  if (faces_without_ > 0) {
    notes.add("notes", fmt::format("{}: {} of {} faces have no color{}; rho = {}, E = 0 assumed",
                                   description_.name, faces_without_, description_.face_count(),
                                   format, options_.default_reflectance));
  }
}

}  // namespace transillum
