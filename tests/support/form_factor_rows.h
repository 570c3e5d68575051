// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/at.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solve_options.h"

namespace transillum::testing {

/// F_ij; 0 if the matrix has no such entry.
inline double form_factor(const FormFactors& f, PatchId i, PatchId j) {
  for (std::size_t k = at(f.row_begin, i); k < at(f.row_begin, i + 1); ++k) {
    if (f.source[k] == j) {
      return f.value[k];
    }
  }
  return 0;
}

inline double row_sum(const FormFactors& f, PatchId i) {
  double sum = 0;
  for (std::size_t k = at(f.row_begin, i); k < at(f.row_begin, i + 1); ++k) {
    sum += f.value[k];
  }
  return sum;
}

/// The form factors of a finished solve.
inline FormFactors form_factors_of(const std::shared_ptr<const Scene>& scene,
                                   const SolveOptions& options) {
  RadiositySolver solver(scene, options);
  solver.advance(RadiositySolver::Until::finished);
  return solver.form_factors();
}

}  // namespace transillum::testing
