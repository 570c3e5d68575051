// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {
namespace {

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = [] {
    const SolveOptions solve;
    const SceneOptions scene;
    const EngineOptions engine;
    return std::vector<Setting>{
        {"directions", "a number", "passes that an iteration step takes, one a direction",
         fmt::to_string(solve.directions)},
        {"sampling", "a name", "where the directions come from (section 4 of the paper)",
         name_of(solve.sampling)},
        {"seed", "a number",
         "for random, sobol and scrambled-hammersley directions, and for the engine rays",
         fmt::to_string(solve.seed)},
        {"rotate", "a number, or none",
         "turn all directions by one random rotation; this is its seed", "none"},
        {"engine", "a name", "the algorithm that finds what sees what", name_of(solve.engine)},
        {"resolution", "a number",
         "for zbuffer and painter: pixels along the longer side of the projected scene; for rays: "
         "lines along it, instead of a number a patch; for hemicube: pixels along a side of the "
         "cube, even",
         fmt::format("{}, hemicube 64", EngineOptions::default_resolution)},
        {"lines", "a number", "for the engine rays: lines a patch and direction",
         fmt::to_string(engine.lines_per_patch), false},
        {"order", "a name", "of the painter; newell gives up where patches overlap in a cycle",
         name_of(engine.order), false},
        {"random-lines", "yes or no",
         "for the engine rays: lines anywhere instead of one in each cell of a grid",
         yes_or_no(!engine.gridded), false},
        {"two-way", "yes or no", "use each direction and its opposite in one pass",
         yes_or_no(solve.two_way)},
        {"normalize", "a name",
         "the paper's estimator, or rows divided by their quadrature of the cosine, or rows and "
         "columns scaled alike so that rows sum to 1",
         name_of(solve.normalize)},
        {"scheme", "a name",
         "the same directions in every step; twice as many each step up to M; others each step, "
         "and the mean over steps; the same, solved on the symmetric form",
         name_of(solve.scheme)},
        {"first-shot", "none, auto or a number",
         "shoot small bright sources first, from this R2/A on, R the scene's diagonal and A a "
         "source's area",
         "none"},
        {"burn-in", "a number", "semi-iterative: leave so many first steps out of the mean",
         fmt::to_string(solve.burn_in)},
        {"replicas", "a number",
         "make the M directions so many independently rotated sets; their spread gives standard "
         "errors",
         fmt::to_string(solve.replicas)},
        {"iterations", "a number, 0: none", "stop after so many iteration steps",
         fmt::to_string(solve.iterations)},
        {"tolerance", "a number",
         "stop when no patch changes by more than this share of the largest B",
         fmt::to_string(solve.tolerance)},
        {"two-sided", "yes or no",
         "every face lights and receives on both sides: two opposite patches",
         yes_or_no(scene.two_sided)},
        {"max-patch-area", "m2, 0: none", "refine faces into patches no larger than this, in m2",
         fmt::to_string(scene.max_patch_area)},
        {"memory", "a size as 2G or 800M",
         "what kept form factors may take; beyond it they are computed again each step",
         "a quarter of the machine's", false},
        {"threads", "a number", "how many work at once; the result does not depend on it",
         "all cores", false},
    };
  }();
  return all;
}

const char* description_of(const std::string& name) {
  const auto found = std::find_if(settings().begin(), settings().end(),
                                  [&](const Setting& setting) { return name == setting.name; });
  if (found == settings().end()) {
    throw std::out_of_range("there is no setting " + name);
  }
  return found->description;
}

}  // namespace transillum
