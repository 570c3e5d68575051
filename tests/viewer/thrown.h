// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <new>
#include <stdexcept>

#include "transillum/cancellation.h"

namespace transillum::viewer {

/// Throws one of the kinds of exceptions that a job may throw, 0 to 3.
[[noreturn]] inline void throw_kind(int kind) {
  switch (kind) {
    case 0:
      throw std::bad_alloc();
    case 1:
      throw std::runtime_error("no such thing");
    case 2:
      throw 7;  // NOLINT(hicpp-exception-baseclass)
    default:
      throw Canceled();
  }
}

}  // namespace transillum::viewer
