// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/sun.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// How the radiance of a sky depends on the direction.
enum class SkyModel {
  uniform,       ///< the same from every direction, also from below
  cie_overcast,  ///< the overcast sky of the CIE: L = L_zenith (1 + 2 sin(elevation)) / 3 above the
                 ///< horizon, and nothing below
};
/// Their names (choice.h).
template <>
const Choices& choices_of<SkyModel>();

/// Light from outside of an open scene: where a line meets no patch, it meets the sky. The sun is
/// in it, too.
struct Sky {
  /// Irradiance of an unobstructed patch that is turned upward, without the sun's, W/m², per
  /// channel; 0 means that only the sun, if any, gives light.
  Rgb exitance;
  SkyModel model = SkyModel::uniform;  ///< its distribution
  Vec3 up{0, 0, 1};                    ///< toward the zenith; unit; read by cie_overcast only
  Sun sun = {};                        ///< the sun, if any

  /// Whether there is light, of the sky or of the sun.
  bool is_set() const { return is_bright() || sun.is_set(); }
  /// Whether there is light of the sky without the sun.
  bool is_bright() const { return max_abs(exitance) > 0; }
  /// pi L / exitance of the sky, without the sun, in the direction omega, a unit vector: 1
  /// everywhere in a uniform sky; of cie_overcast 9/7 at the zenith and 3/7 at the horizon.
  double relative_radiance(const Vec3& omega) const;
  /// @throws InputError naming the value and its range.
  void validate() const;
  /// Exact comparison of all members.
  friend bool operator==(const Sky&, const Sky&) = default;
};

}  // namespace TRANSILLUM_API transillum
