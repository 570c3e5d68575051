// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace TRANSILLUM_API transillum {

/// The matrix of form factors as a sparse matrix by rows: F_ij is the fraction of the light leaving
/// patch i that arrives directly at the front side of patch j.
struct FormFactors {
  std::vector<std::size_t> row_begin;  ///< first index of row i in the lists below; patches + 1
  std::vector<PatchId> source;         ///< j, ascending within a row
  std::vector<double> value;           ///< F_ij, > 0
  /// T^ab(i,j) / A_i over all directions, beside `value`, which T^00 / A_i is; empty unless they
  /// come from a solve with Basis::linear.
  std::vector<TransferMoments> moments = {};

  /// Number of nonzero entries.
  std::size_t size() const { return value.size(); }
};

/// Options of gather_form_factors().
struct GatherOptions {
  int rays_per_patch = 1000;  ///< N, 1 … 2^24
  std::uint64_t seed = 1;     ///< seed of the random numbers
  int threads = 0;            ///< 0 uses all cores; the result does not depend on it

  /// @throws InputError naming the option and its range.
  void validate() const;
};

/// Form factors by Monte Carlo ray tracing, for comparison: from every patch, rays with cosine
/// distribution to the first patch they hit.
///
/// Unbiased; N F_ij is a count of N rays per patch, so its error is about as large as for a
/// binomial count, less where the rays are stratified. Of coincident patches the one whose front
/// side faces the ray is hit.
/// @param scene the scene.
/// @param options rays, seed and threads.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError, Canceled
FormFactors gather_form_factors(const Scene& scene, const GatherOptions& options,
                                const Cancellation& cancellation = {},
                                const std::function<void(double)>& progress = {});

/// Solves B_i = E_i + rho_i sum_j F_ij B_j by Jacobi iteration until the light not yet propagated
/// is at most `tolerance` of the reflected light (SolveOptions::tolerance).
/// @returns B, W/m², one per patch.
/// @throws std::runtime_error after 10,000 iterations.
std::vector<Rgb> solve_radiosity(const Scene& scene, const FormFactors& form_factors,
                                 double tolerance);

}  // namespace TRANSILLUM_API transillum
