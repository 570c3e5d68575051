// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// Invalid input or an invalid argument. `what()` is one sentence for the user that names the place
/// (file, line, face), the value and the valid range. The programs print it and exit with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown by a long operation after its Cancellation was set. Carries no message for the user.
class Canceled : public std::exception {
 public:
  /// Always "canceled".
  const char* what() const noexcept override { return "canceled"; }
};

}  // namespace TRANSILLUM_API transillum
