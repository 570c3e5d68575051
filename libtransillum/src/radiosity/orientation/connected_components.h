// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// A connected component of patches.
struct ConnectedComponent {
  bool orientable = true;  ///< its patches can be made consistent with each other
  bool closed = true;  ///< consistent, every edge is used as often in one direction as in the other
  double area = 0;     ///< m²
  Bounds bounds;       ///< m
  double volume = 0;   ///< enclosed if closed, m³; > 0: patches of sign 1 face outward
};

/// The patches of a scene by connected component.
///
/// Two patches are connected where they alone share an edge, or belong to one face. Of patches on
/// the same points, only the first counts; if they face opposite ways, none does: they are a
/// two-sided surface already.
struct ConnectedComponents {
  static constexpr std::int32_t none = -1;

  std::vector<std::int32_t> component;  ///< by patch: its component, or none
  std::vector<std::int8_t> sign;  ///< by patch: 1 or -1; patches of one sign are consistent, and
                                  ///< most of the component's area has sign 1
  std::vector<PatchId> first;     ///< by patch: the first patch on the same points
  std::vector<ConnectedComponent> components;  ///< in the order of their first patches
};

/// @param scene without two-sided faces.
/// Time: O(n log n) in the corners.
/// @throws Canceled
ConnectedComponents find_connected_components(const Scene& scene, const Cancellation& cancellation);

}  // namespace transillum
