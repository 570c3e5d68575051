// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

namespace transillum {

/// A violated invariant: a bug of this library.
class InvariantError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace transillum

/// Asserts an invariant. Checked only in builds with TRANSILLUM_CHECKS (all tests use one).
#ifdef TRANSILLUM_CHECKS
#define TRANSILLUM_INVARIANT(condition, what)                                                    \
  do {                                                                                           \
    if (!(condition))                                                                            \
      throw ::transillum::InvariantError(std::string(__FILE__) + ": " #condition ": " + (what)); \
  } while (false)
#else
#define TRANSILLUM_INVARIANT(condition, what) \
  do {                                        \
  } while (false)
#endif
