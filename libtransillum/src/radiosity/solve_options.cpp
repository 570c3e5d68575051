// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include "transillum/errors.h"
#include "transillum/radiosity.h"

namespace transillum {

void SolveOptions::validate() const {
  if (directions < 1 || directions > (1 << 24)) {
    throw InputError(fmt::format("directions: {} is not from 1 to {}", directions, 1 << 24));
  }
  if (iterations < 0) {
    throw InputError(fmt::format("iterations: {} is less than 0", iterations));
  }
  if (!(tolerance > 0) || !(tolerance < 1)) {
    throw InputError(fmt::format("tolerance: {} is not between 0 and 1", tolerance));
  }
  if (threads < 0 || threads > 4096) {
    throw InputError(fmt::format("threads: {} is not from 0 to 4096", threads));
  }
}

}  // namespace transillum
