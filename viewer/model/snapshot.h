// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "transillum/bounds.h"
#include "transillum/bsp_tree.h"
#include "transillum/picking.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// A scene with its order, and what finds its patches along rays. Immutable, shared by all threads.
struct LoadedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  std::shared_ptr<const Picker> picker;
  SceneMeasures measures;
  std::shared_ptr<const Solution> stored;  ///< of the result's file it comes from; else null
  std::string file;                        ///< that file
  double seconds_load = 0;
  double seconds_bsp = 0;
};

/// Passes that the steps so far rest on; one that a step takes over from those before (in the
/// growing scheme, or from kept sums) counts in each.
/// @param kept_passes of each step from 0 that has begun, as in SolverSnapshot
inline std::int64_t passes_done(const SolveProgress& progress,
                                const std::vector<int>& kept_passes) {
  const auto finished =
      std::min<std::size_t>(static_cast<std::size_t>(progress.iteration), kept_passes.size());
  return std::accumulate(kept_passes.begin(),
                         kept_passes.begin() + static_cast<std::ptrdiff_t>(finished),
                         std::int64_t{progress.direction});
}

/// Where a solve stands at one moment. Immutable: the worker makes it, the window shows it.
struct SolverSnapshot {
  std::shared_ptr<const LoadedScene> loaded;
  SolveOptions options;
  SolveProgress progress;
  std::shared_ptr<const std::vector<Vec3>> directions;  ///< omega of each pass of the newest step
  /// The same for each step from 0 that has begun, the first always: one list for all, but of their
  /// own in the semi-iterative scheme; null where memory would not do.
  std::vector<std::shared_ptr<const std::vector<Vec3>>> kept_directions;
  /// M of each step from 0 that has begun: fewer at first in the growing scheme.
  std::vector<int> kept_passes;
  SolveStatistics statistics;
  std::vector<Rgb> radiosity;   ///< running estimate, W/m², one a patch
  std::vector<Rgb> irradiance;  ///< of the last finished step, W/m², one a patch
  /// Of all passes so far; null until the session was asked for them and has them.
  std::shared_ptr<const FormFactors> form_factors;
  std::shared_ptr<const DirectLight> shot;  ///< of the first shot; zeros where there is none
  /// E and rho that radiosity and irradiance are of, where they are not the scene's; else null.
  std::shared_ptr<const std::vector<Material>> materials;
  /// The figures are those of loaded->stored: nothing has been solved here yet.
  bool of_file = false;
  bool form_factors_fit = true;  ///< false: they would take too much memory
  /// B(n), one a patch, for each n from 0 whose step has begun; null where memory would not do.
  std::vector<std::shared_ptr<const std::vector<Rgb>>> kept_radiosity;
  std::vector<double> form_factor_sums;   ///< one a patch
  std::vector<double> estimate_changes;   ///< of the newest step that has passes, one a pass
  std::vector<double> quadrature_errors;  ///< eps after each pass
  ErrorEstimate error;                    ///< from replicas, if any
  int estimate_iteration = 0;             ///< 0-based number of that step

  /// Directions of a step, the newest one's where they have not been kept.
  const std::shared_ptr<const std::vector<Vec3>>& directions_of(int iteration) const {
    const auto n = static_cast<std::size_t>(iteration);
    return n < kept_directions.size() && kept_directions[n] ? kept_directions[n] : directions;
  }
  /// How many of them the step took, or takes.
  int passes_of(int iteration) const {
    const auto n = static_cast<std::size_t>(iteration);
    return n < kept_passes.size() ? kept_passes[n] : progress.passes;
  }
};

/// E and rho that the snapshot is of.
inline const Material& material_of(const SolverSnapshot& snapshot, PatchId i) {
  const Scene& scene = *snapshot.loaded->scene;
  const auto m = static_cast<std::size_t>(scene.patch(i).material);
  return snapshot.materials ? (*snapshot.materials)[m] : scene.materials()[m];
}

/// What the session is doing.
enum class RunState { empty, loading, paused, running, finished };

}  // namespace transillum::viewer
