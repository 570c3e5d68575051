// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

namespace transillum {

/// Solves K x = right for a symmetric positive definite matrix K, given as its product: from x
/// to y = K x, both as long as `right`. Stops at a residual of `tolerance` of `right`.
/// @throws std::runtime_error where that is not reached; what the product throws.
void solve_by_conjugate_gradients(const std::function<void(const double* x, double* y)>& product,
                                  const std::vector<double>& right, double tolerance,
                                  std::vector<double>& x);

}  // namespace transillum
