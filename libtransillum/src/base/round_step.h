// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cmath>

namespace transillum {

/// A tick distance of 1, 2 or 5 times a power of ten, for about `count` ticks over `width`.
inline double round_step(double width, int count) {
  const double rough = width / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

}  // namespace transillum
