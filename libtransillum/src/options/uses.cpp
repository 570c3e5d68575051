// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Options that only some runs read.
#include <algorithm>
#include <iterator>

#include "options/option_table.h"

namespace transillum {
namespace {

bool has_directions(const RunOptions& run) { return takes_directions(run.solve.engine); }

bool takes_resolution(const RunOptions& run) {
  return traits_of(run.solve.engine).takes_resolution;
}
bool takes_points(const RunOptions& run) {
  return traits_of(run.solve.engine).takes_points || run.solve.used_first_shot();
}
bool takes_order(const RunOptions& run) { return traits_of(run.solve.engine).takes_order; }

bool draws_random_numbers(const RunOptions& run) {
  const SolveOptions& solve = run.solve;
  const bool seeded_rotations = (solve.replicas > 1 || solve.goal.is_set()) && !solve.rotation;
  return has_directions(run) &&
         (is_seeded(solve.used_sampling()) ||
          traits_of(solve.engine).error == EngineTraits::Error::statistical || seeded_rotations ||
          (traits_of(solve.scheme).renews_directions &&
           differs_by_iteration(solve.used_sampling())));
}

bool has_goal(const RunOptions& run) { return run.solve.goal.is_set(); }
bool has_accuracy(const RunOptions& run) { return run.solve.goal.accuracy > 0; }
bool has_no_goal(const RunOptions& run) { return !has_goal(run); }
bool has_sky(const RunOptions& run) { return run.solve.sky.is_bright(); }
bool has_sun(const RunOptions& run) {
  return run.solve.sky.sun.is_set() || run.solve.sky.sun.below_horizon;
}
bool has_direction(const RunOptions& run) { return !(run.solve.sky.sun.direction == Vec3{}); }
bool has_sun_place(const RunOptions& run) { return run.sun.position || run.sun.site; }
bool has_site(const RunOptions& run) { return run.sun.site.has_value(); }
bool is_semi_iterative(const RunOptions& run) {
  return traits_of(run.solve.scheme).renews_directions;
}
bool stops_by_tolerance(const RunOptions& run) {
  return run.solve.iterations == 0 && run.solve.averaged_iterations == 0;
}
bool has_rounds(const RunOptions& run) { return run.refine.is_set(); }

/// An option that only some runs read; all runs read the others.
struct Use {
  const char* option;
  bool (*used)(const RunOptions&);
  const char* why_not;
};

constexpr const char* without_directions =
    "not used with engine hemicube or pairs, which have no directions";
constexpr const char* chosen_by_goal = "not used with an accuracy or a time limit, which choose it";

constexpr Use uses[] = {
    {"directions", has_directions, without_directions},
    {"directions", has_no_goal, chosen_by_goal},
    {"replicas", has_no_goal, chosen_by_goal},
    {"accuracy-of", has_goal, "used only with an accuracy or a time limit"},
    {"total", has_accuracy, "used only with an accuracy"},
    {"most-passes", has_goal, "used only with an accuracy or a time limit"},
    {"sampling", has_directions, without_directions},
    {"rotate", has_directions, without_directions},
    {"one-way", has_directions, without_directions},
    {"seed", draws_random_numbers,
     "used only with sampling random, sobol or scrambled-hammersley, with engine rays, with scheme "
     "semi-iterative, or to rotate replicas"},
    {"resolution", takes_resolution, "used only with engine zbuffer, painter, rays or hemicube"},
    {"points", takes_points, "used only with engine pairs and with a first shot"},
    {"order", takes_order, "used only with engine painter"},
    {"sky-model", has_sky, "used only with a sky"},
    {"sun-direction", has_sun, "used only with sun-irradiance"},
    {"sun-irradiance", has_direction, "used only with a direction or site of the sun"},
    {"sun-disc", has_sun, "used only with a sun"},
    {"time", has_site, "used only with site"},
    {"north", has_sun_place, "used only with an azimuth or site of the sun"},
    {"burn-in", is_semi_iterative, "used only with scheme semi-iterative"},
    {"tolerance", stops_by_tolerance, "not used with a given number of iterations"},
    {"refine-until", has_rounds, "used only with --refine-by"},
};

/// Why a first shot where it pays is not taken in any of these runs.
std::string why_no_first_shot(const std::vector<RunOptions>& runs) {
  std::string why;
  for (RunOptions run : runs) {
    if (!run.solve.first_shot || run.solve.used_first_shot()) {
      return {};
    }
    run.solve.first_shot = 0;
    why = takes_directions(run.solve.engine) ? first_conflict(run) : without_directions;
  }
  return why;
}

}  // namespace

std::string why_unused(const std::string& name, const std::vector<RunOptions>& runs) {
  if (name == "first-shot") {
    return why_no_first_shot(runs);
  }
  // option() throws for a misspelled name, which would never be found.
  static const bool all_exist = std::all_of(std::begin(uses), std::end(uses), [](const Use& use) {
    return option(use.option).name == use.option;
  });
  for (const Use& use : uses) {
    if (all_exist && use.option == name && std::none_of(runs.begin(), runs.end(), use.used)) {
      return use.why_not;
    }
  }
  return {};
}

}  // namespace transillum
