// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

namespace transillum::fuzz {

/// A violated property. No target catches this exception, so libFuzzer reports a crash.
class PropertyError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void require(bool holds, const std::string& what) {
  if (!holds) {
    throw PropertyError(what);
  }
}

}  // namespace transillum::fuzz
