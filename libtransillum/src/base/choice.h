// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "transillum/errors.h"

namespace transillum {

/// The enumerator whose index is that of `name` in `names`.
/// @throws InputError that lists the choices; `what` says what they are, such as "engine".
template <class Choice>
Choice choice_from_name(const std::vector<std::string>& names, const char* what,
                        const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError(
        fmt::format("unknown {} \"{}\"; choose one of {}", what, name, fmt::join(names, ", ")));
  }
  return static_cast<Choice>(found - names.begin());
}

}  // namespace transillum
