// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Kinds of options: how their values are read from text and printed, for the table of options.
// `get` returns the member of RunOptions that an option sets.
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <utility>

#include "options/option.h"
#include "options/option_values.h"
#include "transillum/errors.h"

namespace transillum::option_kinds {

/// Access to a member of RunOptions by a path of members.
template <class... Members>
auto member(Members... members) {
  return [=](auto& options) -> auto& { return (options.*....*members); };
}
template <class... Members>
auto solve(Members... members) {
  return member(&RunOptions::solve, members...);
}

inline std::string exact_text(double value) { return fmt::format("{}", value); }

/// A whole number; 0 stands for `unset`, unless that is empty.
template <class Get>
void whole(Option& o, Get get, std::int64_t low, std::int64_t high, std::string unset = {}) {
  o.json = Option::Json::number;
  o.unset = unset;
  o.zero_is_unset = !unset.empty();
  o.parse = [=](RunOptions& options, const std::string& text) {
    auto& value = get(options);
    using Value = std::remove_reference_t<decltype(value)>;
    value = !unset.empty() && text == unset
                ? Value{0}
                : static_cast<Value>(whole_number_from_text(text, low, high));
  };
  o.print = [=](const RunOptions& options) {
    const auto value = get(options);
    return value == 0 && !unset.empty() ? unset : fmt::to_string(value);
  };
}

/// A number that `is_valid`; 0 stands for `unset`, unless that is empty.
template <class Get, class IsValid>
void real(Option& o, Get get, IsValid is_valid, const char* valid, const std::string& unset = {}) {
  o.json = Option::Json::number;
  o.unset = unset;
  o.zero_is_unset = !unset.empty();
  o.parse = [=](RunOptions& options, const std::string& text) {
    if (!unset.empty() && text == unset) {
      get(options) = {};
      return;
    }
    const double value = number_from_text(text);
    if (!is_valid(value)) {
      throw InputError(fmt::format("\"{}\" is not {}", text, valid));
    }
    get(options) = value;
  };
  o.print = [=](const RunOptions& options) {
    const double value = get(options);
    return value == 0 && !unset.empty() ? unset : exact_text(value);
  };
}

/// An optional value; nothing stands for `unset`.
template <class Get, class FromText, class ToText>
void optional(Option& o, Get get, const std::string& unset, FromText from_text, ToText to_text) {
  o.unset = unset;
  o.parse = [=](RunOptions& options, const std::string& text) {
    auto& value = get(options);
    value.reset();
    if (text != unset) {
      value = from_text(text);
    }
  };
  o.print = [=](const RunOptions& options) {
    const auto& value = get(options);
    return value ? to_text(*value) : unset;
  };
}

/// A percentage, or a number between 0 and 1.
template <class Get>
void percentage(Option& o, Get get) {
  o.json = Option::Json::number;
  o.unset = "none";
  o.zero_is_unset = true;
  o.parse = [=](RunOptions& options, const std::string& text) {
    try {
      get(options) = text == "none" ? 0 : accuracy_from_text(text);
    } catch (const InputError&) {
      throw InputError(fmt::format(
          "\"{}\" is not a percentage such as 1%, or a number greater than 0 and less than 1",
          text));
    }
  };
  o.print = [=](const RunOptions& options) {
    return get(options) == 0 ? std::string("none") : exact_text(get(options));
  };
}

/// "fixed: the same directions in every iteration; growing: …"
template <class Value>
std::string meanings() {
  const Choices& choices = choices_of<Value>();
  std::string text;
  for (std::size_t k = 0; k < choices.names.size(); ++k) {
    text += fmt::format("{}{}: {}", k > 0 ? "; " : "", choices.names[k], choices.sentences[k]);
  }
  return text;
}

/// One of the names of an enumeration.
template <class Get>
void choice(Option& o, Get get) {
  using Value = std::remove_cvref_t<decltype(get(std::declval<RunOptions&>()))>;
  o.choices = names_of<Value>();
  o.parse = [=](RunOptions& options, const std::string& text) {
    get(options) = from_name<Value>(text);
  };
  o.print = [=](const RunOptions& options) { return name_of(get(options)); };
}

/// @param given the value that the flag gives
template <class Get>
void flag(Option& o, Get get, bool given = true) {
  o.json = Option::Json::flag;
  o.choices = {"yes", "no"};
  o.parse = [=](RunOptions& options, const std::string& text) {
    if (text != "yes" && text != "no") {
      throw InputError(fmt::format("\"{}\" is neither yes nor no", text));
    }
    get(options) = (text == "yes") == given;
  };
  o.print = [=](const RunOptions& options) {
    return std::string(get(options) == given ? "yes" : "no");
  };
}

inline std::string exact_text(const Vec3& value) {
  return fmt::format("{},{},{}", value.x, value.y, value.z);
}

inline std::string exact_text(const Rgb& value) {
  return value.r == value.g && value.g == value.b
             ? exact_text(value.r)
             : fmt::format("{},{},{}", value.r, value.g, value.b);
}

}  // namespace transillum::option_kinds
