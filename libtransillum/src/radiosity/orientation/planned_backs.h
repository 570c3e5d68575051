// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/orientation/connected_components.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {

/// Which sides of a patch emit and receive, in a plan.
struct LitSides {
  bool front = true, back = false;
};

/// Surfaces that light meets.
struct MetSurfaces {
  std::int64_t met = 0;
  std::int64_t backs = 0;  ///< how many of them are met on a side that is not lit

  void add(bool is_back) {
    ++met;
    backs += is_back ? 1 : 0;
  }
  /// The fraction of backs, in [0,1].
  double fraction() const {
    return met > 0 ? static_cast<double>(backs) / static_cast<double>(met) : 0;
  }
};

/// Backs among what light meets, if the patches are lit on certain sides.
struct PlannedBacks {
  MetSurfaces all;
  std::vector<MetSurfaces> own;      ///< by component: what light meets of it
  std::vector<std::int64_t> starts;  ///< by component: paths that begin there
  std::vector<MetSurfaces> others;   ///< by component: what its light meets of others; where
                                     ///< something emits, zeros
  bool is_known = true;              ///< false: light meets next to nothing

  /// Backs of a component among all that light meets, in [0,1].
  double share(std::size_t component) const {
    return all.met > 0 ? static_cast<double>(own[component].backs) / static_cast<double>(all.met)
                       : 0;
  }
};

/// Follows light as back_fraction() does, but for a plan, so that plans are compared without
/// building their scenes. Paths begin at the sources; at all lit sides where nothing emits.
/// @param lit by patch
/// @param threads 0: all cores; the result does not depend on it.
/// @throws Canceled
PlannedBacks measure_planned_backs(const Scene& scene, const EmbreeScene& embree,
                                   const ConnectedComponents& components,
                                   const std::vector<LitSides>& lit, int threads,
                                   const Cancellation& cancellation);

}  // namespace transillum
