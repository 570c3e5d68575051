// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

namespace transillum {

/// A wrong call or bad input. `what()` is one sentence for the user: where (file, line, face)
/// and what is wrong. The programs print it and exit with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown out of long work whose Cancellation was set. Carries no message for the user.
class Canceled : public std::exception {
 public:
  const char* what() const noexcept override { return "canceled"; }
};

}  // namespace transillum
