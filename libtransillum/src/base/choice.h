// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Tables of choices, checked by the compiler.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "transillum/choice.h"

namespace transillum {

/// A line of a table: one value of an enumeration.
template <class Value>
struct Choice {
  Value value;
  const char* name;
  const char* label = nullptr;  ///< null: the name with a capital
  const char* sentence = "";
};
/// Clang 14 does not deduce the arguments of aggregates itself.
template <class Value>
Choice(Value, const char*, const char* = nullptr, const char* = "") -> Choice<Value>;

/// Whether the enumeration has an enumerator with this value: the compiler writes others as
/// numbers.
template <auto value>
constexpr bool is_enumerator() {
  constexpr std::string_view function = __PRETTY_FUNCTION__;
  constexpr std::size_t begin = function.rfind("value = ");
  static_assert(begin != std::string_view::npos);
  return function[begin + std::string_view("value = ").size()] != '(';
}

/// Whether the lines of a table, which have a member `value`, are all values of the enumeration, in
/// its order.
template <const auto& table>
constexpr bool lists_all() {
  using Value = decltype(table[0].value);
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (static_cast<std::size_t>(table[k].value) != k) {
      return false;
    }
  }
  return !is_enumerator<static_cast<std::remove_cv_t<Value>>(table.size())>();
}

/// @param label null: `name` with a capital
void add_choice(Choices& choices, const char* name, const char* label, const char* sentence);

/// The texts of a table, which has to list all values.
/// @param what a value is, such as "engine"
template <const auto& table>
const Choices& texts_of(const char* what) {
  static_assert(lists_all<table>());
  static const Choices choices = [&] {
    Choices made{what, {}, {}, {}};
    for (const auto& line : table) {
      add_choice(made, line.name, line.label, line.sentence);
    }
    return made;
  }();
  return choices;
}

}  // namespace transillum
