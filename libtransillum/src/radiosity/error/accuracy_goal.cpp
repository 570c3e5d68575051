// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/accuracy_goal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <charconv>
#include <cmath>

#include "base/choice.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::array accuracies{
    Choice{AccuracyOf::surfaces, "surfaces", "Worst surface"},
    Choice{AccuracyOf::groups, "groups:NAME,...", "Surfaces named"},
    Choice{AccuracyOf::irradiance, "irradiance", "Irradiance"},
    Choice{AccuracyOf::rms, "rms", "RMS"},
    Choice{AccuracyOf::max, "max", "Largest"},
    Choice{AccuracyOf::patch, "patch:I", "Patch"},
    Choice{AccuracyOf::mean, "mean"},
};

constexpr std::array obstacles{
    Choice{AccuracyObstacle::none, "none"},
    Choice{AccuracyObstacle::seconds, "seconds"},
    Choice{AccuracyObstacle::passes, "passes"},
    Choice{AccuracyObstacle::directions, "directions"},
    Choice{AccuracyObstacle::first_shot, "first-shot"},
    Choice{AccuracyObstacle::stalled, "stalled"},
    Choice{AccuracyObstacle::no_light, "no-light"},
};

/// Reads all of `text`; nothing else may follow.
template <class Number>
bool read_number(const std::string& text, Number& value) {
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last;
}

}  // namespace

template <>
const Choices& choices_of<AccuracyOf>() {
  static const Choices choices = texts_of<accuracies>("accuracy");
  return choices;
}

template <>
const Choices& choices_of<AccuracyObstacle>() {
  static const Choices choices = texts_of<obstacles>("obstacle of an accuracy");
  return choices;
}

void AccuracyGoal::validate() const {
  if (!(accuracy >= 0 && accuracy < 1)) {
    throw InputError(fmt::format("accuracy: {} is not between 0 and 1 (100 %)", accuracy));
  }
  if (!(seconds >= 0 && std::isfinite(seconds))) {
    throw InputError(fmt::format("seconds: {} is not a finite number of at least 0", seconds));
  }
  if (passes < 0) {
    throw InputError(fmt::format("accuracy: {} passes are less than 0", passes));
  }
  if (of == AccuracyOf::groups && surfaces.empty()) {
    throw InputError("accuracy: no group is named");
  }
  if (patch < 0) {
    throw InputError(fmt::format("accuracy: patch {} does not exist", patch));
  }
}

double accuracy_from_text(const std::string& text) {
  const bool percent = text.ends_with('%');
  double value = 0;
  const bool number = read_number(percent ? text.substr(0, text.size() - 1) : text, value);
  value *= percent ? 0.01 : 1;
  if (!number || !(value > 0 && value < 1)) {
    throw InputError(fmt::format(
        "accuracy: \"{}\" is neither a percentage such as 1% nor a number between 0 and 1", text));
  }
  return value;
}

AccuracyGoal accuracy_of_from_name(const std::string& name) {
  AccuracyGoal goal;
  if (name.starts_with("patch:")) {
    goal.of = AccuracyOf::patch;
    if (!read_number(name.substr(6), goal.patch) || goal.patch < 0) {
      throw InputError(
          fmt::format("accuracy of: \"{}\" does not name a patch; write patch:0", name));
    }
    return goal;
  }
  if (name.starts_with("groups:")) {
    goal.of = AccuracyOf::groups;
    boost::split(goal.surfaces, name.substr(7), [](char c) { return c == ','; });
    for (std::string& surface : goal.surfaces) {
      boost::trim(surface);
      if (surface.empty()) {
        throw InputError(
            fmt::format("accuracy of: \"{}\" has an empty name; write groups:floor,walls", name));
      }
    }
    return goal;
  }
  goal.of = from_name<AccuracyOf>(name);
  if (goal.of == AccuracyOf::groups) {
    throw InputError("accuracy of: groups:NAME,... needs names of groups, as in groups:floor");
  }
  if (goal.of == AccuracyOf::patch) {
    throw InputError("accuracy of: patch:I needs the number of a patch, as in patch:0");
  }
  return goal;
}

std::string name_of_accuracy(const AccuracyGoal& goal) {
  switch (goal.of) {
    case AccuracyOf::patch:
      return fmt::format("patch:{}", goal.patch);
    case AccuracyOf::groups:
      return fmt::format("groups:{}", fmt::join(goal.surfaces, ","));
    case AccuracyOf::surfaces:
    case AccuracyOf::irradiance:
    case AccuracyOf::rms:
    case AccuracyOf::max:
    case AccuracyOf::mean:
      break;
  }
  return name_of(goal.of);
}

}  // namespace transillum
