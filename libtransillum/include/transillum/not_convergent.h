// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>

namespace transillum {

/// The iteration does not converge: too few directions for the scene's largest reflectance
/// (eq. 24). `what()` is one sentence for the user.
class NotConvergent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace transillum
