// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

namespace transillum {

/// Something that can only be wrong by a fault of ours.
class InvariantError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace transillum

/// States what always holds. Checked in builds with TRANSILLUM_CHECKS (the whole test run).
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
