// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>

#include "radiosity/exchange/owned_patches.h"
#include "radiosity/exchange/unknowns.h"
#include "radiosity/sun_light.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The options of the engine that makes the passes of a solve.
EngineOptions used_engine_options(const SolveOptions& options);

/// Number of passes that a goal is expected to take, for decisions made before the first; M without
/// a goal.
int expected_directions(const SolveOptions& options);

/// The light of the first shot that `options` ask for.
/// @param progress as for shoot()
/// @throws Canceled
DirectLight first_shot(const Scene& scene, const SolveOptions& options,
                       const Cancellation& cancellation,
                       const std::function<void(double)>& progress = {});

/// Makes a first shot more accurate.
/// @param light of first_shot() with the same scene and options
/// @param points DirectLight::points that are wanted
/// @param progress as for shoot()
/// @throws Canceled
DirectLight refined_shot(const Scene& scene, const SolveOptions& options, const DirectLight& light,
                         const std::vector<int>& points, const Cancellation& cancellation,
                         const std::function<void(double)>& progress = {});

/// The input of a solve; constant while passes are made, so any thread may read it.
struct SolverInput {
  std::shared_ptr<const Scene> scene;
  SolveOptions options;                     ///< validated
  Cancellation requested;                   ///< set from outside
  int threads = 1;                          ///< options.threads, or the number of cores
  std::shared_ptr<const DirectLight> shot;  ///< light of the first shot; zeros without one
  std::shared_ptr<const BspTree> tree;
  SunLight sun;                     ///< empty without a sun
  TransferEngine engine;            ///< null between release_engine() and require_engine()
  std::shared_ptr<PatchSums> sums;  ///< where they are kept
  Cancellation cancellation;        ///< PatchSums::own() of `requested`
  std::shared_ptr<const Unknowns> unknowns;
  double seconds_first_shot = 0, seconds_bsp = 0;  ///< time spent here; 0 for what was passed in

  /// Makes what is null: the light of the first shot, the tree, the engine.
  /// @throws InputError, Canceled
  SolverInput(std::shared_ptr<const Scene> scene, const SolveOptions& options,
              SolverResources resources, const Cancellation& cancellation);

  /// Frees the memory of an engine that was made here: no pass follows.
  void release_engine() {
    if (makes_engine_) {
      engine = {};
    }
  }
  /// Makes the engine if there is none.
  void require_engine();

  int directions_per_pass() const { return options.two_way ? 2 : 1; }
  OwnedPatches owned() const { return {*sums, scene->patch_count()}; }
  /// @throws Canceled, in every process
  void throw_if_canceled() const { owned().throw_if_canceled(requested); }
  std::size_t patch_count() const { return static_cast<std::size_t>(scene->patch_count()); }

 private:
  void prepare();

  bool makes_engine_;  ///< none was passed in
};

}  // namespace transillum
