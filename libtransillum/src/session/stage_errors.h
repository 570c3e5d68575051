// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Errors of a stage of a solve to an accuracy, as the goal measures them.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/error/error_estimate.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The relative error that `goal` is about: its limit with 95 % confidence.
/// @param scene the scene.
/// @param b radiosity, W/m², one per patch.
/// @param error the error estimate of `b`.
/// @returns infinity without an estimate; 0 where B is 0.
/// @throws InputError where the scene does not have the goal's patch.
double error_for(const AccuracyGoal& goal, const Scene& scene, const std::vector<Rgb>& b,
                 const ErrorEstimate& error);

/// Sets the worst surface of a report, where its goal is about surfaces.
/// @param error of the result.
void name_worst_surface(const AccuracyGoal& goal, const ErrorEstimate& error,
                        AccuracyReport& report);

/// The result of a stage, diffuse or with lobes.
struct StageResult {
  const Scene& scene;
  const SolveOptions& options;
  const std::vector<Rgb>& radiosity;  ///< B, W/m²
  SolveStatistics statistics;
  ErrorEstimate error;
  const DirectLight* shot = nullptr;  ///< null where it is unknown, or there is none
  double seconds_preparing = 0;       ///< wall time of the tree and of all shots so far
  double seconds_first_shot = 0;      ///< wall time of all shots
};

/// The parts of a stage's error that more passes do not decrease. The arguments must outlive it.
class StageErrors {
 public:
  /// @param surfaces of the scene.
  StageErrors(const StageResult& result, const ErrorSurfaces& surfaces, const AccuracyGoal& goal)
      : result_(result), surfaces_(surfaces), goal_(goal) {}

  /// The part of error_for() that missing iterations make; 0 without an estimate.
  double of_iteration() const;
  /// The part that the first shot makes, of a stage that has one.
  double of_shot() const;
  /// The patches whose direct light makes the largest part of the error, as few as leave the
  /// first shot an error of at most `allowed` if theirs had none.
  std::vector<PatchId> patches_to_refine(double allowed) const;

 private:
  double of_bias(const std::vector<Rgb>& bias) const;
  double of_shot(const DirectLight& shot) const;
  /// The light that errors of a patch are relative to; nothing where they do not count.
  std::optional<Rgb> unit_of(PatchId patch) const;
  std::vector<double> shares_of_shot() const;

  const StageResult& result_;
  const ErrorSurfaces& surfaces_;
  const AccuracyGoal& goal_;
};

}  // namespace transillum
