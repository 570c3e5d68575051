// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/solver_input.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/part_of_progress.h"
#include "base/seconds_since.h"
#include "base/worker_threads.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

const SolveOptions& validated(const SolveOptions& options) {
  options.validate();
  return options;
}

}  // namespace

EngineOptions used_engine_options(const SolveOptions& options) {
  EngineOptions used = options.engine_options;
  used.seed = options.seed;
  used.moments = options.basis == Basis::linear;
  return used;
}

int expected_directions(const SolveOptions& options) {
  if (!options.goal.is_set()) {
    return options.directions;
  }
  // Some hundred passes in most scenes; the error is expected to fall as 1/M.
  constexpr double at_1_percent = 128, most = 1 << 20;
  const double accuracy = options.goal.accuracy > 0 ? options.goal.accuracy : 1e-3;
  return static_cast<int>(std::clamp(at_1_percent * (0.01 / accuracy), 64.0, most));
}

DirectLight first_shot(const Scene& scene, const SolveOptions& options,
                       const Cancellation& cancellation,
                       const std::function<void(double)>& progress) {
  std::vector<PatchId> sources;
  if (const auto threshold = options.used_first_shot()) {
    sources = first_shot_sources(scene, *threshold, expected_directions(options), options.basis,
                                 cancellation);
  }
  const std::vector<PatchId> paired =
      options.glossy && !sources.empty() ? patches_with_lobes(scene) : std::vector<PatchId>();
  // Light of pairs is computed twice, and takes so much of the time.
  const double all = scene.patch_count();
  const double first = all / (all + static_cast<double>(paired.size()));
  DirectLight light = shoot(scene, sources, shot_options(options), cancellation,
                            part_of_progress(progress, 0, first));
  light.pairs = shoot_pairs(scene, sources, paired, shot_options(options), cancellation,
                            part_of_progress(progress, first, 1 - first));
  light.paired = paired;
  return light;
}

DirectLight refined_shot(const Scene& scene, const SolveOptions& options, const DirectLight& light,
                         const std::vector<int>& points, const Cancellation& cancellation,
                         const std::function<void(double)>& progress) {
  std::map<int, std::vector<PatchId>> receivers;
  double work = 0, done = 0;
  const auto work_of = [](int count) { return static_cast<double>(count) * count; };
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (light.points.empty() || at(points, i) != at(light.points, i)) {
      receivers[at(points, i)].push_back(i);
      work += work_of(at(points, i));
    }
  }
  DirectLight refined = light;
  for (const auto& [count, of_count] : receivers) {
    ShotOptions with_points = shot_options(options);
    with_points.points = count;
    const double share = work_of(count) * static_cast<double>(of_count.size()) / work;
    shoot_again(scene, of_count, with_points, refined, cancellation,
                part_of_progress(progress, done, share));
    done += share;
  }
  return refined;
}

SolverInput::SolverInput(std::shared_ptr<const Scene> solved_scene,
                         const SolveOptions& solve_options, SolverResources resources,
                         const Cancellation& solve_cancellation)
    : scene(std::move(solved_scene)),
      options(validated(solve_options)),
      requested(solve_cancellation),
      threads(thread_count(options.threads)),
      shot(std::move(resources.shot)),
      tree(std::move(resources.tree)),
      engine(std::move(resources.engine)),
      sums(resources.sums ? resources.sums : sums_in_memory()),
      cancellation(sums->own(requested)),
      makes_engine_(!engine) {
  sums->agree([this] { prepare(); });
}

void SolverInput::prepare() {
  if (!shot) {
    const auto start = Clock::now();
    shot = std::make_shared<const DirectLight>(transillum::first_shot(*scene, options, requested));
    seconds_first_shot = seconds_since(start);
  }
  if (!tree) {
    const auto start = Clock::now();
    tree = std::make_shared<const BspTree>(*scene, requested, std::function<void(double)>{},
                                           options.threads);
    seconds_bsp = seconds_since(start);
  }
  require_engine();
  // One that was passed in may know the directions of the passes only, as shards do.
  sun = sun_light(scene, tree, options, requested, makes_engine_ ? engine : TransferEngine());
  unknowns = std::make_shared<const Unknowns>(*scene, options.basis, *shot, sun);
}

void SolverInput::require_engine() {
  if (!engine) {
    const auto start = Clock::now();
    engine = make_engine(options.engine, scene, tree, used_engine_options(options), requested);
    seconds_bsp += seconds_since(start);
  }
}

}  // namespace transillum
