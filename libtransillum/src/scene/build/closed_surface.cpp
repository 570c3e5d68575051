// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/closed_surface.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace transillum {

bool is_closed_surface(const Scene& scene) {
  struct DirectedEdge {
    PointId low, high;
    int sign;  ///< 1 from low to high, -1 from high to low
  };
  std::vector<DirectedEdge> edges;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  const auto key = [](const DirectedEdge& e) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(e.low)) << 32 |
           static_cast<std::uint32_t>(e.high);
  };
  std::sort(edges.begin(), edges.end(),
            [&](const DirectedEdge& a, const DirectedEdge& b) { return key(a) < key(b); });
  for (std::size_t begin = 0; begin < edges.size();) {
    int balance = 0;
    std::size_t end = begin;
    for (; end < edges.size() && key(edges[end]) == key(edges[begin]); ++end) {
      balance += edges[end].sign;
    }
    if (balance != 0) {
      return false;
    }
    begin = end;
  }
  return true;
}

}  // namespace transillum
