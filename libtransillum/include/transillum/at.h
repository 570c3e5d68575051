// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>

#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// The element of `container` at index `id`. Ids of patches, fragments and points are signed
/// 32-bit integers, so that -1 can mean "none"; containers are indexed by std::size_t. Unchecked,
/// like operator[].
/// @param container anything with operator[].
/// @param id 0 … size - 1.
template <class Container, class Id>
constexpr decltype(auto) at(Container&& container, Id id) {
  return container[static_cast<std::size_t>(id)];
}

}  // namespace TRANSILLUM_API transillum
