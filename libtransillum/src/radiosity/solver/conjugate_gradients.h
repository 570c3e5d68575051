// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

namespace transillum {

/// Solves K x = right for a symmetric positive definite matrix K.
/// @param product computes y = K x; both are as long as `right`
/// @param tolerance norm of the residual over that of `right`; not below what rounding permits
/// @throws NotConvergent where the tolerance is not reached; what `product` throws
void solve_by_conjugate_gradients(const std::function<void(const double* x, double* y)>& product,
                                  const std::vector<double>& right, double tolerance,
                                  std::vector<double>& x);

}  // namespace transillum
