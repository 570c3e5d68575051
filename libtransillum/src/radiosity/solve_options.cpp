// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "transillum/errors.h"
#include "transillum/radiosity.h"

namespace transillum {

const std::vector<std::string>& engine_names() {
  static const std::vector<std::string> names{"local"};
  return names;
}

Engine engine_from_name(const std::string& name) {
  const auto& names = engine_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError(
        fmt::format("unknown engine \"{}\"; choose one of {}", name, fmt::join(names, ", ")));
  }
  return static_cast<Engine>(found - names.begin());
}

const std::string& name_of(Engine engine) {
  return engine_names()[static_cast<std::size_t>(engine)];
}

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
