// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <algorithm>
#include <string_view>

#include "transillum/radiosity.h"
#include "transillum/settings.h"

namespace transillum {
namespace {

bool has_directions(const SolveOptions& solve) { return takes_directions(solve.engine); }

bool has_pixels(const SolveOptions& solve) {
  return solve.engine == Engine::zbuffer || solve.engine == Engine::painter ||
         solve.engine == Engine::rays || solve.engine == Engine::hemicube;
}

bool draws_random_numbers(const SolveOptions& solve) {
  const bool seeded_rotations = (solve.replicas > 1 || solve.goal.set()) && !solve.rotation;
  return has_directions(solve) &&
         (is_seeded(solve.used_sampling()) || solve.engine == Engine::rays || seeded_rotations ||
          (solve.scheme == Scheme::semi_iterative && differs_by_iteration(solve.used_sampling())));
}

bool has_no_goal(const SolveOptions& solve) { return !solve.goal.set(); }

/// A setting that only some solves read; all solves read the others.
struct Use {
  std::string_view setting;
  bool (*used)(const SolveOptions&);
  const char* why_not;
};

constexpr const char* without_directions =
    "not used with engine hemicube or pairs, which have no directions";

constexpr const char* chosen_by_goal = "not used with an accuracy or a time limit, which choose it";

constexpr Use uses[] = {
    {"directions", has_directions, without_directions},
    {"directions", has_no_goal, chosen_by_goal},
    {"replicas", has_no_goal, chosen_by_goal},
    {"accuracy-of", [](const SolveOptions& solve) { return solve.goal.set(); },
     "used only with an accuracy or a time limit"},
    {"sampling", has_directions, without_directions},
    {"rotate", has_directions, without_directions},
    {"two-way", has_directions, without_directions},
    {"seed", draws_random_numbers,
     "used only with sampling random, sobol or scrambled-hammersley, with engine rays, with scheme "
     "semi-iterative, or to rotate replicas"},
    {"resolution", has_pixels, "used only with engine zbuffer, painter, rays or hemicube"},
    {"points", [](const SolveOptions& solve) { return solve.engine == Engine::pairs; },
     "used only with engine pairs"},
    {"lines",
     [](const SolveOptions& solve) {
       return solve.engine == Engine::rays && solve.engine_options.resolution == 0;
     },
     "used only with engine rays, and without a resolution"},
    {"random-lines", [](const SolveOptions& solve) { return solve.engine == Engine::rays; },
     "used only with engine rays"},
    {"order", [](const SolveOptions& solve) { return solve.engine == Engine::painter; },
     "used only with engine painter"},
    {"sky-model", [](const SolveOptions& solve) { return solve.sky.set(); },
     "used only with a sky"},
    {"burn-in", [](const SolveOptions& solve) { return solve.scheme == Scheme::semi_iterative; },
     "used only with scheme semi-iterative"},
};

}  // namespace

std::string why_unused(const std::string& name, const std::vector<SolveOptions>& solves) {
  for (const Use& use : uses) {
    if (use.setting == name && std::none_of(solves.begin(), solves.end(), use.used)) {
      return use.why_not;
    }
  }
  return {};
}

}  // namespace transillum
