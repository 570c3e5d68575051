// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/solution.h"

namespace transillum {

/// SolveStatistics::negative_corners of a solution.
inline std::int64_t negative_corners(const Solution& solution) {
  std::int64_t count = 0;
  for (PatchId i = 0; i < static_cast<PatchId>(solution.linear_terms.size()); ++i) {
    for (const Rgb& b : corner_radiosity(solution, i)) {
      count += b.r < 0 || b.g < 0 || b.b < 0 ? 1 : 0;
    }
  }
  return count;
}

/// B of each patch, with a linear basis followed by its linear term.
/// @param parts LinearTerms; empty with constant functions
inline std::vector<Rgb> coefficients_of(const std::vector<Rgb>& radiosity,
                                        const std::vector<LinearTerm>& terms) {
  if (terms.empty()) {
    return radiosity;
  }
  std::vector<Rgb> coefficients;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    coefficients.insert(coefficients.end(), {radiosity[i], terms[i].first, terms[i].second});
  }
  return coefficients;
}

}  // namespace transillum
