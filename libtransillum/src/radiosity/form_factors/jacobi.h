// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity.h"

namespace transillum {

/// Jacobi iteration of B_i = E_i + rho_i H_i, H_i = sum_j F_ij B_j, rows dealt out to threads; the
/// result does not depend on how many there are.
struct JacobiIteration {
  /// An iteration by tolerance that takes so many steps does not converge.
  static constexpr int most_steps = 10'000;

  /// From B = E on.
  /// @param materials E and rho: as many as the scene has, in its order
  /// @param threads 0: all cores
  JacobiIteration(const Scene& scene, const FormFactors& form_factors,
                  std::span<const Material> materials, int threads);

  std::vector<Rgb> b, h;  ///< W/m², one a patch; `b` may be set to start from it
  std::vector<IterationRecord> steps;
  bool converged = false;

  /// From now on this light goes on top, and what it has shot need not be gathered:
  ///   B_i = E_i + rho_i (H_i of the shot + sum_j F_ij (B_j - E_j shot)).
  /// @throws Canceled
  void shoot_first(const DirectLight& shot, const Cancellation& cancellation);
  /// Goes on for `most` steps, or until no patch changes by more than `tolerance` of the largest B.
  /// @throws Canceled, std::runtime_error where B outgrows all numbers.
  void run(int most, double tolerance, const Cancellation& cancellation);
  /// The same by tolerance only.
  /// @throws Canceled, std::runtime_error where it does not get there.
  void run_to(double tolerance, const Cancellation& cancellation);

 private:
  /// Calls visit(i) for every patch, on all threads.
  template <class Visit>
  void for_each_row(const Cancellation& cancellation, Visit visit) const;

  const Scene& scene_;
  const FormFactors& form_factors_;
  std::span<const Material> materials_;
  std::vector<Rgb> correction_;  ///< to sum_j F_ij B_j, by a first shot; empty: there was none
  int threads_;
};

}  // namespace transillum
