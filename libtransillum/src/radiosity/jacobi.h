// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity.h"

namespace transillum {

/// Jacobi iteration of B_i = E_i + rho_i H_i, H_i = sum_j F_ij B_j, from B = E on.
struct JacobiIteration {
  std::vector<Rgb> b, h;  ///< W/m², one a patch
  std::vector<IterationRecord> steps;
  bool converged = false;

  /// Goes on for `most` steps, or until no patch changes by more than `tolerance` of the largest B.
  /// @throws Cancelled, std::runtime_error where B outgrows all numbers.
  void run(const Scene& scene, const FormFactors& form_factors, int most, double tolerance,
           const Cancellation& cancellation);
};

}  // namespace transillum
