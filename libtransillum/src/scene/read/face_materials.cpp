// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/face_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "transillum/errors.h"

namespace transillum {
namespace {

/// Values this near to 1 are 1 but for the digits of the file.
constexpr double rounding_of_one = 1e-6;

constexpr double color_parts = 1024;

}  // namespace

double lower_reflectance(Rgb& reflectance, const ReadOptions& options) {
  const double least = options.max_reflectance.value_or(1 - rounding_of_one);
  const double lowered = options.max_reflectance.value_or(ReadOptions::default_max_reflectance);
  bool any = false;
  for (double* rho : {&reflectance.r, &reflectance.g, &reflectance.b}) {
    if (*rho > least) {
      *rho = lowered;
      any = true;
    }
  }
  return any ? lowered : 0;
}

void lower_reflectance(Rgb& reflectance, const ReadOptions& options, const std::string& place,
                       Warnings& notes) {
  const Rgb given = reflectance;
  const double lowered = lower_reflectance(reflectance, options);
  if (lowered > 0) {
    notes.add("reflectances, lowered",
              fmt::format("{}reflectance rho {:.6g} {:.6g} {:.6g} is lowered to {}", place, given.r,
                          given.g, given.b, lowered));
  }
}

FaceMaterials::FaceMaterials(SceneDescription& description, const ReadOptions& options)
    : description_(description), options_(options) {}

std::int32_t FaceMaterials::of_mean_color(const Rgb& reflectance, const Rgb& exitance) {
  // Below 1, a mean does not become 1, which would be lowered.
  const auto rounded = [](double v) {
    const double nearest = std::round(std::clamp(v, 0.0, 1.0) * color_parts) / color_parts;
    return nearest < 1 || v >= 1 ? nearest : 1 - 1 / color_parts;
  };
  return of_color({rounded(reflectance.r), rounded(reflectance.g), rounded(reflectance.b)},
                  exitance);
}

std::int32_t FaceMaterials::of_numbers(const Rgb& reflectance, const Rgb& exitance,
                                       const std::string& place, Warnings& notes) {
  for (const double channel : {reflectance.r, reflectance.g, reflectance.b}) {
    if (!(channel >= 0) || !std::isfinite(channel)) {
      throw InputError(
          fmt::format("{}rho {} is not a finite number of at least 0", place, channel));
    }
  }
  Rgb rho = reflectance;
  lower_reflectance(rho, options_, place, notes);
  return of_color(rho, exitance);
}

std::int32_t FaceMaterials::of_color(const Rgb& reflectance, const Rgb& exitance) {
  Rgb rho = reflectance;
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
