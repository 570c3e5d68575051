// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// The surfaces of a scene, each with an error of its own: its groups; in a scene with fewer
/// than two, its materials; with fewer than two of these, its connected components.
struct Surfaces {
  /// The index of patches that are not measured.
  static constexpr std::int32_t none = -1;

  struct Surface {
    std::string name;          ///< group or material; "no group", "component 3", "others"
    std::int64_t patches = 0;  ///< number, above 0
    double area = 0;           ///< m²
  };
  std::vector<Surface> surfaces;       ///< in the order of the scene; "others" is the last
  std::vector<std::int32_t> of_patch;  ///< by patch: an index into `surfaces`, or none

  std::int32_t of(PatchId i) const { return of_patch[static_cast<std::size_t>(i)]; }
};

/// Which patches are measured.
enum class Measured {
  reflecting,  ///< patches that reflect and do not emit; all patches where there are none
  receiving,   ///< patches that do not emit; all patches where there are none
  /// The same as `reflecting`, where a patch may also reflect by its lobe only.
  reflecting_with_lobes,
};

/// The surfaces with measured patches. Surfaces with less than 1 % of the measured area count
/// together as "others". Time: linear in the corners.
/// @param kept names of surfaces that count alone whatever their area.
Surfaces find_surfaces(const Scene& scene, Measured measured,
                       const std::vector<std::string>& kept = {});

/// Checks that the surfaces of `scene` have these names.
/// @throws InputError with the first that does not exist, and those that do.
void check_surfaces(const Scene& scene, const std::vector<std::string>& names);

}  // namespace transillum
