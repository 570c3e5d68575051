// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Values that are chosen by a name: what enumerations such as Engine or Scheme are called in
// options, files and lists of choices. Each has a table, which the compiler compares with it.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// The texts of an enumeration's values, each list in its order.
struct Choices {
  std::string what;                    ///< the word for a value, such as "engine"
  std::vector<std::string> names;      ///< in options and files
  std::vector<std::string> labels;     ///< in a list of choices
  std::vector<std::string> sentences;  ///< meaning of each value; may be empty texts

  /// The place of `name` in `names`.
  /// @throws InputError listing the names.
  std::size_t index_of(const std::string& name) const;
};

/// The texts of `Value`. Each enumeration that has them says so.
template <class Value>
const Choices& choices_of();

/// The names of all values, in the order of the enumeration.
template <class Value>
const std::vector<std::string>& names_of() {
  return choices_of<Value>().names;
}
/// The value called `name`.
/// @throws InputError listing the names.
template <class Value>
Value from_name(const std::string& name) {
  return static_cast<Value>(choices_of<Value>().index_of(name));
}
/// The name of a value.
template <class Value>
  requires std::is_enum_v<Value>
const std::string& name_of(Value value) {
  return choices_of<Value>().names[static_cast<std::size_t>(value)];
}

}  // namespace TRANSILLUM_API transillum
