// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/sky.h"

#include <fmt/format.h>

#include <cmath>

#include "base/choice.h"
#include "transillum/errors.h"

namespace transillum {

namespace {

constexpr std::array sky_models{
    Choice{SkyModel::uniform, "uniform"},
    Choice{SkyModel::cie_overcast, "cie-overcast", "CIE overcast"},
};

}  // namespace

template <>
const Choices& choices_of<SkyModel>() {
  return texts_of<sky_models>("model of the sky");
}

double Sky::relative_radiance(const Vec3& omega) const {
  if (model == SkyModel::uniform) {
    return 1;
  }
  // The exitance is the integral of L sin(elevation) over the upper hemisphere, 7 pi L_zenith / 9.
  const double height = dot(omega, up);
  return height > 0 ? 3 * (1 + 2 * height) / 7 : 0;
}

void Sky::validate() const {
  constexpr double largest = 1e170;  // the limit of materials
  for (const double value : {exitance.r, exitance.g, exitance.b}) {
    if (!(value >= 0 && value <= largest)) {
      throw InputError(
          fmt::format("sky: an exitance of {} is not in the range 0 to {}", value, largest));
    }
  }
  if (!is_finite(up) || std::abs(norm(up) - 1) > 1e-9) {
    throw InputError(fmt::format("up: the vector {} {} {} is not a unit vector", up.x, up.y, up.z));
  }
  sun.validate();
}

}  // namespace transillum
