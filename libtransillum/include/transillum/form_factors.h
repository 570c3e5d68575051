// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// The matrix of form factors, row by row, without its zeros: F_ij is the share of what leaves
/// patch i that reaches the lit side of patch j.
struct FormFactors {
  std::vector<std::size_t> row_begin;  ///< of row i in the lists below; one more than patches
  std::vector<PatchId> source;         ///< j, rising within a row
  std::vector<double> value;           ///< F_ij > 0

  std::size_t size() const { return value.size(); }
};

struct GatherOptions {
  int rays_per_patch = 1000;  ///< 1 … 2^24
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all cores; the result does not depend on it

  /// @throws InputError naming the option and its range.
  void validate() const;
};

/// Monte Carlo form factors, the usual way and not the paper's: from every patch cosine-distributed
/// rays to what they meet first, by Embree. Unbiased; the error of F_ij is about that of a count
/// F_ij N of N rays, less where sampling is even. Coincident patches are met on their lit side.
/// `progress`, if given, hears the share done, in [0,1], now and then on the calling thread.
/// @throws InputError, Canceled
FormFactors gather_form_factors(const Scene& scene, const GatherOptions& options,
                                const Cancellation& cancellation = {},
                                const std::function<void(double)>& progress = {});

/// B of B_i = E_i + rho_i sum_j F_ij B_j by Jacobi iteration, W/m², one a patch; stops where no
/// patch changes by more than `tolerance` of the largest B.
/// @throws std::runtime_error where 10,000 steps do not get there.
std::vector<Rgb> solve_radiosity(const Scene& scene, const FormFactors& form_factors,
                                 double tolerance);

}  // namespace transillum
