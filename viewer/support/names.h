// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Names of values in files: each enumeration has one table of them, used in both directions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>

namespace transillum::viewer {

template <class Value>
struct Name {
  const char* name;
  Value value;
};

/// @param value  in the table
template <class Value, std::size_t n>
const char* name_in_file(const Name<Value> (&names)[n], Value value) {
  return std::find_if(std::begin(names), std::end(names),
                      [value](const Name<Value>& known) { return known.value == value; })
      ->name;
}

template <class Value, std::size_t n>
std::optional<Value> value_named(const Name<Value> (&names)[n], const std::string& name) {
  for (const Name<Value>& known : names) {
    if (name == known.name) {
      return known.value;
    }
  }
  return std::nullopt;
}

/// All names in quotes, for a message.
template <class Value, std::size_t n>
std::string names_in_quotes(const Name<Value> (&names)[n]) {
  std::string choices;
  for (const Name<Value>& known : names) {
    choices += (choices.empty() ? "\"" : ", \"") + std::string(known.name) + '"';
  }
  return choices;
}

}  // namespace transillum::viewer
