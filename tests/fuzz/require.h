// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

namespace transillum::fuzz {

/// A property that did not hold: an exception that no target catches, so a crash to libFuzzer.
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
