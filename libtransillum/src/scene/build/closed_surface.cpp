// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/closed_surface.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace transillum {

bool is_closed_surface(const Scene& scene) {
  struct Side {
    PointId low, high;
    int runs;  ///< 1 from low to high, -1 from high to low
  };
  std::vector<Side> sides;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      sides.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  const auto key = [](const Side& s) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(s.low)) << 32 |
           static_cast<std::uint32_t>(s.high);
  };
  std::sort(sides.begin(), sides.end(),
            [&](const Side& a, const Side& b) { return key(a) < key(b); });
  for (std::size_t begin = 0; begin < sides.size();) {
    int runs = 0;
    std::size_t end = begin;
    for (; end < sides.size() && key(sides[end]) == key(sides[begin]); ++end) {
      runs += sides[end].runs;
    }
    if (runs != 0) {
      return false;
    }
    begin = end;
  }
  return true;
}

}  // namespace transillum
