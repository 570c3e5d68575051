// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// Calls visit(name, value) for each single number of a solve that a .vtp file keeps, by the name
/// of its field data array. Any may be missing from a file, for instance from an older version.
/// @tparam Result Solution, or const Solution
template <class Result, class Visit>
void visit_values(Result& solution, Visit visit) {
  visit("complete", solution.complete);
  auto& s = solution.statistics;
  visit("fragments", s.fragments);
  visit("directions", s.directions);
  visit("passes", s.passes);
  visit("passes_made", s.passes_made);
  visit("hemicubes", s.hemicubes);
  visit("pairs", s.pairs);
  visit("integrated_pairs", s.integrated_pairs);
  visit("iterations", s.iterations);
  visit("transfers", s.transfers);
  visit("form_factors", s.form_factors);
  visit("kept_form_factors", s.kept_form_factors);
  visit("converged", s.converged);
  visit("closure_defect_max", s.closure_defect_max);
  visit("closure_defect_grazing", s.closure_defect_grazing);
  visit("closure_defect_moments", s.closure_defect_moments);
  visit("negative_corners", s.negative_corners);
  visit("escaped", s.escaped);
  visit("energy_defect", s.energy_defect);
  visit("energy_balance", s.energy_balance);
  visit("rho_max", s.rho_max);
  visit("predicted_contraction", s.predicted_contraction);
  visit("seconds_total", s.seconds_total);
  auto& error = solution.error;
  visit("replicas", error.replicas);
  visit("error_quantile", error.quantile);
  visit("error_rms", error.rms);
  visit("mean_radiosity_r", error.mean_radiosity.r);
  visit("mean_radiosity_g", error.mean_radiosity.g);
  visit("mean_radiosity_b", error.mean_radiosity.b);
  visit("mean_standard_error_r", error.mean_standard_error.r);
  visit("mean_standard_error_g", error.mean_standard_error.g);
  visit("mean_standard_error_b", error.mean_standard_error.b);
}

}  // namespace transillum
