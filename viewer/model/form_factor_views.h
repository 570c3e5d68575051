// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <vector>

#include "model/snapshot.h"

namespace transillum::viewer {

/// F_ij of patches i and j; 0 where neither sees the other.
double form_factor(const FormFactors& form_factors, PatchId i, PatchId j);
/// F_ij of patch i for all j, one per patch.
std::vector<double> form_factors_from(const FormFactors& form_factors, PatchId i);
/// F_ji for all j and patch i, one per patch.
std::vector<double> form_factors_to(const FormFactors& form_factors, PatchId i);

/// The reason, for the user, why a snapshot has no form factors.
QString why_no_form_factors(const SolverSnapshot& snapshot);

}  // namespace transillum::viewer
