// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "radiosity/orientation/connected_components.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {

/// Targets of random walks of light that start on one side of a component; means over the walks.
struct SideExposure {
  double other_area = 0;  ///< area of the patches of other components reached, relative to all area
  double own_area = 0;  ///< area of the patches of the same component reached, relative to all area
  double met_other = 0;   ///< fraction of the walks that reach another component
  double met_closed = 0;  ///< fraction that reach another closed component
  double lit = 0;  ///< fraction that reach a source in another component; where nothing emits: that
                   ///< leave the scene, since light can only come from outside
};

/// Exposures of one component: the side of the fronts of patches with sign 1, and the other side.
using ComponentExposure = std::array<SideExposure, 2>;

/// Follows random walks from both sides of every component. A walk is reflected diffusely, on the
/// side that it meets, until it leaves the scene or has met a few patches: so it explores the space
/// on that side, and goes round corners.
/// @param threads 0: all cores; the result does not depend on it.
/// @param progress as in plan_orientation()
/// @throws Canceled
std::vector<ComponentExposure> measure_exposure(const Scene& scene, const EmbreeScene& embree,
                                                const ConnectedComponents& components, int threads,
                                                const Cancellation& cancellation,
                                                const std::function<void(double)>& progress);

}  // namespace transillum
