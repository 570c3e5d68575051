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

/// Number of unknowns of a patch with linear functions; unknown 3 i + a has the function phi_a.
constexpr std::size_t linear_unknowns = 3;

/// The values of phi_0 among the values of all unknowns.
template <class Value>
std::vector<Value> means_of(std::vector<Value> values, std::size_t per_patch) {
  if (per_patch > 1) {
    for (std::size_t i = 0; per_patch * i < values.size(); ++i) {
      values[i] = values[per_patch * i];
    }
    values.resize(values.size() / per_patch);
  }
  return values;
}

/// The values of phi_1 and phi_2 among the coefficients of linear functions.
inline std::vector<LinearTerm> linear_terms_of(const std::vector<Rgb>& coefficients) {
  std::vector<LinearTerm> terms;
  for (std::size_t u = 0; u < coefficients.size(); u += linear_unknowns) {
    terms.push_back({coefficients[u + 1], coefficients[u + 2]});
  }
  return terms;
}

}  // namespace transillum
