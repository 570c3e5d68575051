// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Defaults that depend on other options, and the options that must be given to get others than the
// defaults.
#include <algorithm>
#include <utility>

#include "options/option_table.h"
#include "transillum/errors.h"
#include "transillum/study.h"

namespace transillum {
namespace {

/// The choices of the paper.
constexpr std::pair<const char*, const char*> paper_choices[] = {
    {"directions", "1024"}, {"sampling", "hammersley"}, {"one-way", "yes"},
    {"basis", "constant"},  {"first-shot", "none"},     {"accuracy", "none"}};

/// The accuracy where nothing else is given, and the most passes that it takes.
constexpr double default_accuracy = 0.01;
constexpr std::int64_t default_most_passes = 16384;

void set_default_accuracy(RunOptions& options, const std::set<std::string>& given) {
  for (const char* excluding : {"accuracy", "seconds", "directions", "replicas", "iterations"}) {
    if (given.count(excluding) > 0) {
      return;
    }
  }
  RunOptions accurate = options;
  accurate.solve.goal.accuracy = default_accuracy;
  if (given.count("most-passes") == 0) {
    accurate.solve.goal.passes = default_most_passes;
  }
  // With lobes, the time of a solve grows as the square of M.
  if (takes_directions(options.solve.engine) && !options.solve.glossy &&
      first_conflict(accurate).empty()) {
    options = accurate;
  }
}

/// Sets the direction of a sun that is given by angles, or by place and time.
/// @throws InputError
void place_sun(RunOptions& options, const std::set<std::string>& given) {
  const SunPlace& place = options.sun;
  if (!place.position && !place.site) {
    return;
  }
  Sky& sky = options.solve.sky;
  if (!place.position && !place.time) {
    throw InputError("site: requires a time");
  }
  if (!place.position && given.count("sun-irradiance") == 0) {
    throw InputError("site: requires sun-irradiance, in W/m2");
  }
  if (given.count("up") == 0) {
    throw InputError("the sun: its azimuth and elevation require a vertical, up");
  }
  const SolarPosition position =
      place.position ? *place.position : solar_position(*place.site, place.time->utc);
  sky.sun.direction = direction_of(position, sky.up, place.north.value_or(default_north(sky.up)));
  sky.sun.below_horizon = position.elevation <= 0;
  if (sky.sun.below_horizon) {
    sky.sun.irradiance = {};
  }
}

}  // namespace

void set_dependent_defaults(RunOptions& options, const std::set<std::string>& given) {
  place_sun(options, given);
  SolveOptions& solve = options.solve;
  if (options.paper) {
    for (const auto& [name, value] : paper_choices) {
      const bool is_other = given.count(name) > 0 ||
                            (given.count("accuracy") > 0 && name == std::string("directions"));
      if (!is_other) {
        option(name).parse(options, value);
      }
    }
  } else {
    set_default_accuracy(options, given);
  }
  // Its error decreases as 1 / sqrt(iterations): the default tolerance would take days.
  const bool stops = solve.iterations > 0 || solve.tolerance != SolveOptions{}.tolerance;
  solve.averaged_iterations =
      traits_of(solve.scheme).renews_directions && !stops ? default_averaged_iterations : 0;
  if (solve.sampling == default_sampling(solve.two_way)) {
    solve.sampling.reset();
  }
  if (options.refine.is_set() || options.total) {
    options.input.patches = 0;
  }
}

bool set_window_defaults(RunOptions& options, std::int64_t patches) {
  const bool is_chosen = options.input.patches > 0 || options.scene.max_patch_area > 0 ||
                         options.refine.is_set() || options.total;
  if (is_chosen || patches == 0) {
    return false;
  }
  options.input.patches = patches;
  RunOptions linear = options;
  linear.solve.basis = Basis::linear;
  if (first_conflict(linear).empty()) {
    options = linear;
  }
  return true;
}

std::vector<std::pair<std::string, std::string>> differences_from_default(const RunOptions& asked) {
  RunOptions options = asked;
  if (!options.refine.is_set() && !options.total) {
    options.refine = {};
  }
  std::vector<std::pair<std::string, std::string>> differences;
  const auto make = [&] {
    RunOptions made;
    std::set<std::string> given;
    for (const auto& [name, text] : differences) {
      option(name).parse(made, text);
      given.insert(name);
    }
    set_dependent_defaults(made, given);
    return made;
  };
  RunOptions made = make();
  std::set<std::string> given;
  // An option that is given may change the default of another.
  for (bool added = true; added;) {
    added = false;
    for (const Option& o : transillum::options()) {
      const std::string text = o.print(options);
      if (given.count(o.name) == 0 && text != o.print(made) &&
          why_unused(o.name, {options}).empty()) {
        differences.emplace_back(o.name, text);
        given.insert(o.name);
        added = true;
      }
    }
    made = make();
  }
  // Options that others imply are not needed.
  const auto is_asked = [&] {
    const RunOptions again = make();
    return std::all_of(transillum::options().begin(), transillum::options().end(),
                       [&](const Option& o) { return o.print(again) == o.print(made); });
  };
  for (std::size_t k = differences.size(); k-- > 0;) {
    const auto difference = differences[k];
    differences.erase(differences.begin() + static_cast<std::ptrdiff_t>(k));
    if (!is_asked()) {
      differences.insert(differences.begin() + static_cast<std::ptrdiff_t>(k), difference);
    }
  }
  return differences;
}

}  // namespace transillum
