// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstdint>

#include "transillum/scene.h"

namespace transillum {

/// A number for the edge between two points, the same both ways.
inline std::uint64_t edge_key(PointId a, PointId b) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32 |
         static_cast<std::uint32_t>(std::max(a, b));
}

}  // namespace transillum
