// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// Options of hemicube_form_factors().
struct HemicubeOptions {
  int resolution = 64;       ///< R, pixels along a side of the cube; even, 2 … 2048
  std::uint64_t memory = 0;  ///< limit for the form factors, bytes; 12 per nonzero entry; 0: a
                             ///< quarter of the machine's
  int threads = 0;           ///< 0 uses all cores; the result does not depend on it

  /// @throws InputError naming the option and its range.
  void validate() const;
};

/// Form factors by the classical hemicube method (Cohen and Greenberg 1985), for comparison: the
/// scene is drawn onto the five sides of half a cube about one point of every patch.
///
/// Visibility at that point represents the whole patch, so patches must be small against their
/// distance; what is smaller than a pixel is either hit or missed. In a closed scene rows sum to 1
/// except for pixels that fall through gaps between polygons; A_i F_ij = A_j F_ji does not hold.
/// Time grows as the square of the number of patches.
/// @param scene the scene.
/// @param options resolution, memory and threads.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError, Canceled; std::runtime_error where the memory limit does not suffice.
FormFactors hemicube_form_factors(const Scene& scene, const HemicubeOptions& options,
                                  const Cancellation& cancellation = {},
                                  const std::function<void(double)>& progress = {});

}  // namespace TRANSILLUM_API transillum
