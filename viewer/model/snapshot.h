// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/patch_materials.h"
#include "model/run_options.h"
#include "session/total_plan.h"
#include "support/has_index.h"
#include "transillum/accuracy_goal.h"
#include "transillum/at.h"
#include "transillum/bounds.h"
#include "transillum/bsp_tree.h"
#include "transillum/glossy.h"
#include "transillum/radiosity_solver.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "visibility/embree/picking.h"

namespace transillum::viewer {

/// A scene with its BSP tree and ray picker. Immutable, shared by all threads.
struct LoadedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const SceneDescription>
      description;  ///< description of the scene; null for a result file
  std::shared_ptr<const BspTree> tree;
  std::shared_ptr<const Picker> picker;
  SceneMeasures measures;
  double back_fraction = 0;  ///< BackFraction::fraction
  /// BackFraction::open, 1 with two-sided faces, which have an outside; not set where a built-in
  /// scene has light, which needs neither fraction
  std::optional<double> open_fraction;
  std::shared_ptr<const Solution>
      stored;                     ///< solution of the result file that was opened; else null
  std::string file;               ///< path of the result file
  std::size_t divided_faces = 0;  ///< number of faces, where they were divided unasked
  double seconds_load = 0;        ///< wall-clock time of reading
  double seconds_bsp = 0;         ///< wall-clock time of building the tree
  /// The scene before patches were divided in rounds; null if none were divided.
  std::shared_ptr<const LoadedScene> whole;
  /// The divisions that make these patches from `whole`, as in SceneInput::divided.
  std::vector<std::string> divided = {};
  /// The same object in all that was made of one opened scene, with moved faces or other patches.
  std::shared_ptr<const int> origin = nullptr;
};

/// The scene as it was read, before rounds of refinement.
inline std::shared_ptr<const LoadedScene> whole_of(
    const std::shared_ptr<const LoadedScene>& loaded) {
  return loaded && loaded->whole ? loaded->whole : loaded;
}

/// Whether both were made of one opened scene.
inline bool is_same_origin(const std::shared_ptr<const LoadedScene>& a,
                           const std::shared_ptr<const LoadedScene>& b) {
  return whole_of(a) == whole_of(b) || (a && b && a->origin && a->origin == b->origin);
}

/// The progress of a refinement; its finished rounds are in SolveStatistics::refinement.
struct RefinementState {
  PatchId patches = 0;  ///< patches of the scene so far
  bool left = false;    ///< patches may be divided further after this solve
};

struct MeasuredErrors;

/// The progress of a solve to a total error.
struct TotalState {
  std::vector<TotalStage> stages;  ///< finished ones
  std::optional<TotalEnd> end;     ///< not set while further stages follow
};

/// The RMS error of B over RMS of B, estimated from replicas, and the limits that it is between in
/// 90 % of all runs.
struct ErrorBand {
  double lowest = 0, estimate = 0, limit = 0;
};

/// Linear functions to look at, in place of constant ones: they fit the means of the neighbors in
/// the same plane best, and are nowhere less than 0. One per patch.
struct FittedLight {
  std::vector<LinearTerm> terms;  ///< linear terms of B
  std::shared_ptr<const std::vector<LinearBasis>> bases;
};

/// The state of a solve run at one moment: its light is the running estimate. Immutable: created by
/// the worker, shown by the window.
struct SolverSnapshot : SolvedLight {
  std::shared_ptr<const LoadedScene> loaded;
  SolveOptions options;
  RefineChoice refine;
  RefinementState refinement;       ///< if `refine` or `total` is set
  std::optional<TotalState> total;  ///< if the accuracy limits the sum of all errors
  std::shared_ptr<const MeasuredErrors>
      measured_errors;  ///< errors of this solve, if it was made for a total error
  SolveProgress progress;
  /// The passes of all iterations so far. A pass that several iterations use (in the growing
  /// scheme, or from stored sums) counts in each.
  std::int64_t passes_done = 0;
  std::shared_ptr<const std::vector<Vec3>>
      directions;  ///< omega of each pass of the newest iteration
  /// The directions of each iteration that has begun, and always of the first: one shared list,
  /// except in the semi-iterative scheme; null if the memory limit was exceeded.
  std::vector<std::shared_ptr<const std::vector<Vec3>>> kept_directions;
  /// M of each iteration that has begun; smaller in the first ones of the growing scheme.
  std::vector<int> kept_passes;
  SolveStatistics statistics;
  /// The bases of the scene's patches; null without linear_terms.
  std::shared_ptr<const std::vector<LinearBasis>> bases;
  /// For the result of constant functions; null before it, and where patches are too small to show.
  std::shared_ptr<const FittedLight> fitted;
  /// The form factors of all passes so far; null until SolveRunner::include_form_factors() was
  /// called and they are assembled.
  std::shared_ptr<const FormFactors> form_factors;
  std::shared_ptr<const DirectLight> shot;  ///< light of the first shot; zeros without one
  /// E, rho and lobes that radiosity and irradiance were computed with, if they differ from the
  /// scene's; else null.
  std::shared_ptr<const PatchMaterials> materials;
  /// The values come from loaded->stored; nothing has been solved yet.
  bool of_file = false;
  /// The light is of a draft, or of the last finished stage; `progress` is of the solve that will
  /// replace it.
  bool of_draft = false;
  bool form_factors_fit = true;  ///< false: the memory limit was exceeded
  /// B(n), one per patch, for each iteration n that has begun; null if the memory limit was
  /// exceeded.
  std::vector<std::shared_ptr<const std::vector<Rgb>>> kept_radiosity;
  /// The linear terms of B(n) likewise; empty where B is constant on patches.
  std::vector<std::shared_ptr<const std::vector<LinearTerm>>> kept_linear_terms;
  std::vector<double>
      estimate_changes;  ///< changes in the newest iteration with passes, one per pass
  std::vector<double> quadrature_errors;  ///< epsilon after each pass
  ErrorEstimate error;                    ///< from replicas; empty without replicas
  std::vector<ErrorBand>
      errors;  ///< errors of B after each finished iteration; empty without replicas
  /// The number of standard errors in `error` that cannot be trusted. It is 0 for a result file,
  /// which does not say which sources were shot first.
  std::int64_t uncertain_patches = 0;
  /// The report of a solve with a goal, once its first stage is finished.
  std::optional<AccuracyReport> accuracy;
  int estimate_iteration = 0;  ///< number of the iteration of estimate_changes, from 0

  /// Directions of an iteration; the directions of the newest iteration if they were not stored.
  const std::shared_ptr<const std::vector<Vec3>>& directions_of(int iteration) const {
    const bool stored = has_index(kept_directions, iteration) && at(kept_directions, iteration);
    return stored ? at(kept_directions, iteration) : directions;
  }
  /// The number of passes of an iteration.
  int passes_of(int iteration) const {
    return has_index(kept_passes, iteration) ? at(kept_passes, iteration) : progress.passes;
  }
};

/// E and rho of patch i in the snapshot.
inline const Material& material_of(const SolverSnapshot& snapshot, PatchId i) {
  return snapshot.materials ? snapshot.materials->of(i) : snapshot.loaded->scene->material(i);
}

/// The present activity of the solve runner.
enum class RunState { empty, loading, paused, running, finished };

}  // namespace transillum::viewer
