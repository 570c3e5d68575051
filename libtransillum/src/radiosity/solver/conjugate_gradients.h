// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

namespace transillum {

/// Known properties of the entries of the matrix S, where K = I - S.
enum class Entries {
  at_least_zero,  ///< with right >= 0: where some x is below 0, the sum of the powers of S diverges
  any_sign,       ///< diverges where v·K v < 0 for some v; the vectors of the search are tried
};

/// Solves K x = right for a symmetric positive definite matrix K.
/// @param product computes y = K x; both are as long as `right`
/// @param tolerance norm of the residual over that of `right`; not below what rounding permits
/// @throws NotConvergent where the tolerance is not reached or the sum of the powers of S diverges;
/// what `product` throws
void solve_by_conjugate_gradients(const std::function<void(const double* x, double* y)>& product,
                                  const std::vector<double>& right, double tolerance,
                                  Entries entries, std::vector<double>& x);

}  // namespace transillum
