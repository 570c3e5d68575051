// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "scene/build/warnings.h"
#include "transillum/scene.h"

namespace transillum {

/// Lowers the channels that ReadOptions::max_reflectance does not allow.
/// @return the value that they were lowered to; 0 if none was
double lower_reflectance(Rgb& reflectance, const ReadOptions& options);

/// The same, with a warning if any was lowered. `place` begins it, as "a.ply: face 3: ".
void lower_reflectance(Rgb& reflectance, const ReadOptions& options, const std::string& place,
                       Warnings& notes);

/// The materials of a file that has colors instead: one for each color that faces have.
class FaceMaterials {
 public:
  FaceMaterials(SceneDescription& description, const ReadOptions& options);

  /// The number of the material with the reflectance of a color in bytes, lowered as the options
  /// say, and this exitance.
  std::int32_t of_color(const Rgb& reflectance, const Rgb& exitance = {});
  /// The same of a mean of colors, which is rounded to 1/1024 so that faces share materials.
  std::int32_t of_mean_color(const Rgb& reflectance, const Rgb& exitance = {});
  /// The same of numbers, kept to their last digit: those that are lowered are noted.
  /// @param place of the face, at the beginning of messages
  /// @throws InputError unless they are finite and at least 0
  std::int32_t of_numbers(const Rgb& reflectance, const Rgb& exitance, const std::string& place,
                          Warnings& notes);
  /// The number of the material of faces without a color.
  std::int32_t without_color();
  /// Notes how many faces got the default reflectance.
  void note(Warnings& notes, const char* format) const;

 private:
  SceneDescription& description_;
  const ReadOptions& options_;
  std::map<std::array<double, 6>, std::int32_t> numbers_;
  std::int32_t without_ = -1;
  std::int64_t faces_without_ = 0;
};

}  // namespace transillum
