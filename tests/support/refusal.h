// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/errors.h"

namespace transillum::test {

/// The sentence an input is refused with; empty where it is taken.
template <typename Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace transillum::test
