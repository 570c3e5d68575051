// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {

struct HemicubeOptions {
  int resolution = 64;  ///< R, pixels along a side of the cube, even, 2 … 2048
  std::uint64_t memory =
      0;            ///< bytes form factors may take, 12 each; 0: a quarter of the machine's
  int threads = 0;  ///< 0: all cores; the result does not depend on it

  /// @throws InputError naming the option and its range.
  void validate() const;
};

/// Form factors the classical way (Cohen and Greenberg 1985), not the paper's: from a point of
/// every patch the scene is drawn onto five sides of half a cube. What is seen from that point
/// stands for what is seen from the whole patch, so patches must be small against their distance;
/// what is smaller than a pixel is met or missed. Rows sum to 1 in a closed scene but for what
/// slips through between polygons; A_i F_ij = A_j F_ji does not hold. Time grows as the square of
/// the number of patches.
/// `progress`, if given, hears the share done, in [0,1], now and then on the calling thread.
/// @throws InputError, Canceled, std::runtime_error where they take more memory than allowed.
FormFactors hemicube_form_factors(const Scene& scene, const HemicubeOptions& options,
                                  const Cancellation& cancellation = {},
                                  const std::function<void(double)>& progress = {});

/// @throws InputError where solve_by_hemicubes() would.
void check_hemicube_options(const SolveOptions& options);

/// Solves with hemicube_form_factors() by the iteration that solve() uses, to the same tolerance or
/// number of steps; of the options those count, engine_options.resolution (0: the
/// default), memory and threads. In the statistics a pass is a hemicube
/// and a direction one of its pixels; `escaped` is the share of all that patches see that is not
/// another's lit side, and `energy_defect` what light gains or loses on its way for want of
/// reciprocity.
/// @throws InputError where an option wants directions; Canceled; std::runtime_error where the
/// iteration diverges.
Solution solve_by_hemicubes(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                            const Cancellation& cancellation = {},
                            const std::function<void(double)>& progress = {});

}  // namespace transillum
