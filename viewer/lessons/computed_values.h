// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "lessons/lesson_value.h"
#include "model/snapshot.h"
#include "transillum/cancellation.h"
#include "visibility/map/map_history.h"

namespace transillum::viewer {

/// Computes values of one scene; runs and maps that several values need are computed once.
///
/// Threads: one at a time. It solves the scene again, so that it needs nothing from the window, and
/// its values belong to the page, whatever the window shows now.
class ComputedValues {
 public:
  /// @param cancellation  checked in solves and maps
  /// @param progress  if set, called with the finished fraction of the values that are expected; on
  /// any thread, but never on two at once
  ComputedValues(std::shared_ptr<const LoadedScene> loaded, Cancellation cancellation,
                 std::function<void(double fraction)> progress = {});
  ~ComputedValues();

  /// Adds the solves of a value that will be asked for to those that the progress is about.
  void expect(const LessonValue& wanted);
  /// @throws InputError where the value names a patch or direction that does not exist, or needs
  /// replicas that the run does not have; Canceled; what a solve throws
  double value(const LessonValue& wanted);
  /// The value for each patch in turn, of a value that is_per_patch(). @throws as value()
  std::vector<double> of_patches(const LessonValue& wanted);
  /// Where the area of a projected_area or visible_area is on the plane: convex polygons that do
  /// not overlap. @throws as value()
  std::vector<std::vector<Vec2>> region(const LessonValue& wanted);

 private:
  struct Run;
  Run& run_of(const SolveOptions& options);
  const RadiositySolver& solved(const SolveOptions& options);
  /// The solution of a run in which lobes take part; null for other runs.
  const Solution* solved_with_lobes(const SolveOptions& options,
                                    const std::vector<MaterialChange>& changes = {});
  /// B or H of a patch, or its radiance toward the value's eye.
  Rgb light_of(const LessonValue& wanted);
  const MapHistory& history_of(const LessonValue& wanted);
  const std::vector<Rgb>& reference_of(const LessonValue& wanted);
  double covered(const LessonValue& wanted);
  double error_of(const LessonValue& wanted);
  double function_error(const LessonValue& wanted);
  const Solution& divided(double patch_area, const SolveOptions& options);
  double of_run(const LessonValue& wanted);
  double of_direction(const LessonValue& wanted);
  double of_patch(const LessonValue& wanted);
  double form_factor(const LessonValue& wanted);
  double jump(const LessonValue& wanted);
  std::vector<std::int32_t> rows_of(const LessonValue& wanted);
  void check_patch(PatchId patch) const;

  std::shared_ptr<const LoadedScene> loaded_;
  /// The work of a solve of the scene, or of patches of at most `patch_area`: passes times patches.
  double work_of(const SolveOptions& options, double patch_area = 0) const;
  void expect_solve(const SolveOptions& options, double patch_area = 0);
  /// Reports what a solve, which has this work in all, has done.
  void tell(double work, const SolveProgress& now) const;

  Cancellation cancellation_;
  std::function<void(double)> progress_;
  std::vector<std::pair<SolveOptions, double>> expected_;  ///< solves: options, and area of patches
  double expected_work_ = 0, done_work_ = 0;
  std::vector<std::unique_ptr<Run>> runs_;
  std::vector<std::pair<Vec3, MapHistory>> histories_;
  std::map<int, std::vector<Rgb>> references_;  ///< B of the reference, by its number of passes
  struct Divided;
  std::vector<std::unique_ptr<Divided>> divided_;
};

}  // namespace transillum::viewer
