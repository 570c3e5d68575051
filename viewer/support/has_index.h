// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iterator>

namespace transillum::viewer {

/// Whether `index` is the index of an element of `container`. False for negative ones.
template <class Container>
bool has_index(const Container& container, int index) {
  return index >= 0 && index < std::ssize(container);
}

}  // namespace transillum::viewer
