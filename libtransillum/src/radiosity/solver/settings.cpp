// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/memory_limit.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {
namespace {

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

std::vector<Setting> direction_settings(const SolveOptions& solve) {
  return {
      {"directions", "a number", "number of directions per iteration (one pass each)",
       fmt::to_string(solve.directions)},
      {"sampling", "a name",
       "set of directions (section 4 of the paper); of one-way passes fibonacci by default",
       name_of(default_sampling(true))},
      {"seed", "a number",
       "random seed of random, sobol and scrambled-hammersley directions, and of the engine rays",
       fmt::to_string(solve.seed)},
      {"rotate", "a number, or none", "apply a random rotation with this seed to all directions",
       "none"},
  };
}

std::vector<Setting> engine_settings(const SolveOptions& solve, const EngineOptions& engine) {
  return {
      {"engine", "a name", "algorithm that computes visibility along a direction",
       name_of(solve.engine)},
      {"resolution", "a number",
       "zbuffer and painter: pixels along the longer side of the projected scene; rays: lines "
       "along that side, instead of a number per patch; hemicube: pixels along a side of the "
       "cube, even",
       fmt::format("{}, hemicube 64", EngineOptions::default_resolution)},
      {"points", "a number",
       "engine pairs: number of points along a patch as large as its distance from the other, "
       "where "
       "something is between",
       fmt::to_string(EngineOptions::default_points), false},
      {"lines", "a number", "engine rays: lines per patch and direction",
       fmt::to_string(engine.lines_per_patch), false},
      {"order", "a name",
       "engine painter: order of the patches (newell fails if patches overlap in a cycle)",
       name_of(engine.order), false},
      {"random-lines", "yes or no",
       "engine rays: random lines instead of one in each cell of a grid",
       yes_or_no(!engine.gridded), false},
  };
}

std::vector<Setting> iteration_settings(const SolveOptions& solve) {
  return {
      {"two-way", "yes or no", "use each pass for a direction and its opposite",
       yes_or_no(solve.two_way)},
      {"normalize", "a name",
       "none: the paper's estimator; rows: divide each row of form factors by the quadrature of "
       "its cosine; symmetric: scale rows and columns alike so that rows sum to 1",
       name_of(solve.normalize)},
      {"scheme", "a name",
       "fixed: the same directions in every iteration; growing: twice as many in each iteration, "
       "up to M; semi-iterative: new directions in each iteration, and the mean over iterations; "
       "conjugate-gradients: as fixed, solved in symmetric form",
       name_of(solve.scheme)},
      {"basis", "a name",
       "constant: one value of B per patch; linear: a linear function on each patch, from engines "
       "fast, local, exact and pairs",
       name_of(solve.basis)},
      {"glossy", "yes or no",
       "lobes of materials (MTL: Ks with Ns or Pr; glTF: metallic and rough) reflect too",
       yes_or_no(solve.glossy)},
      {"first-shot", "none, auto or a number",
       "treat small bright sources separately before the iteration: those with R2/A of at least "
       "this ratio, R the scene's diagonal and A the source's area; auto: those for which it takes "
       "less time than the passes it saves; with an accuracy, auto is the default",
       "none"},
      {"burn-in", "a number, or auto",
       "semi-iterative: first iterations to exclude from the mean; auto: until what is left of the "
       "start counts for less than the differences between iterations",
       "auto"},
      {"replicas", "a number", "split M into this many rotated sets; their spread gives error bars",
       fmt::to_string(solve.replicas)},
      {"accuracy", "a percentage or a number, 0: none",
       "choose M and the replicas so that the error of B is at most that, with 95 % confidence",
       "none"},
      {"accuracy-of", "a name",
       "error that the accuracy is about, relative to reflected light, B - E, without patches that "
       "emit: rms, the RMS error over the RMS; max, the largest error over the largest value; "
       "patch:I, the error of patch I; mean, the error of the mean",
       name_of_accuracy(solve.goal)},
      {"seconds", "a number, 0: none",
       "time limit in s, loading excluded: the most accurate result that it allows", "none"},
      {"iterations", "a number, 0: none", "stop after this many iterations",
       fmt::to_string(solve.iterations)},
      {"tolerance", "a number",
       "stop when the light not yet propagated is at most this fraction of the reflected light, of "
       "all patches and of the dimmest tenth of their area; semi-iterative: when the estimated "
       "error of the mean, 95 % confidence, is at most that",
       fmt::to_string(solve.tolerance)},
  };
}

std::vector<Setting> sky_settings(const Sky& sky) {
  return {
      {"sky", "W/m2, one number or three; 0: none",
       "what escapes from an open scene meets a sky: what an unobstructed patch turned upward "
       "receives from it, in W/m2",
       "none"},
      {"sky-model", "a name",
       "uniform: the same from everywhere, also from below; cie-overcast: three times as bright at "
       "the zenith as at the horizon, nothing from below",
       name_of(sky.model)},
      {"up", "a direction x,y,z", "the zenith of the sky cie-overcast",
       fmt::format("{},{},{}", sky.up.x, sky.up.y, sky.up.z)},
  };
}

std::vector<Setting> scene_settings(const SceneOptions& scene) {
  return {
      {"two-sided", "yes or no",
       "every face emits and receives on both sides: two opposite patches per face",
       yes_or_no(scene.two_sided)},
      {"max-patch-area", "m2, 0: none", "divide faces into patches of at most this area, in m2",
       fmt::to_string(scene.max_patch_area)},
      {"refine-by", "a name, or none",
       "divide faces in rounds, worst patches first, until there are as many patches as asked "
       "for; jump: where B jumps across edges; error: where a solve with every patch divided "
       "differs most",
       "none"},
      {"patches", "a number", "with rounds of refinement: the most patches to make", "0"},
      {"refine-until", "a percentage or a number, 0: none",
       "end the rounds when their figure is this small: relative RMS jump, or relative L2 error",
       "none"},
  };
}

std::vector<Setting> machine_settings() {
  return {
      {"memory", "a size such as 2G or 800M",
       "memory for stored form factors; beyond it they are recomputed in each iteration, which "
       "changes last digits",
       "a quarter of the machine's", false},
      {"threads", "a number", "number of threads; results do not depend on it", "all cores", false},
  };
}

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = [] {
    const SolveOptions solve;
    std::vector<Setting> list = direction_settings(solve);
    for (const auto& group :
         {engine_settings(solve, EngineOptions()), iteration_settings(solve),
          sky_settings(solve.sky), scene_settings(SceneOptions()), machine_settings()}) {
      list.insert(list.end(), group.begin(), group.end());
    }
    return list;
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

std::uint64_t default_memory_limit() { return memory_limit(0); }

}  // namespace transillum
