// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/snapshot_solution.h"

namespace transillum::viewer {

Solution solution_of(const SolverSnapshot& snapshot, bool complete) {
  Solution solution;
  solution.scene = snapshot.loaded->scene;
  solution.radiosity = snapshot.radiosity;
  solution.linear_parts = snapshot.linear_parts;
  solution.irradiance = snapshot.irradiance;
  solution.error = snapshot.error;
  solution.statistics = snapshot.statistics;
  solution.complete = snapshot.of_file ? snapshot.loaded->stored->complete : complete;
  solution.accuracy = snapshot.accuracy;
  solution.glossy = snapshot.glossy;
  const bool any_pass = snapshot.passes_done > 0;
  if (any_pass) {
    solution.form_factor_sums = snapshot.form_factor_sums;
    solution.sky_shares = snapshot.sky_shares;
    solution.sky_irradiance = snapshot.sky_irradiance;
  } else if (snapshot.of_file) {
    solution.form_factor_sums = snapshot.loaded->stored->form_factor_sums;
    solution.sky_shares = snapshot.loaded->stored->sky_shares;
    solution.sky_irradiance = snapshot.loaded->stored->sky_irradiance;
  }
  return solution;
}

}  // namespace transillum::viewer
