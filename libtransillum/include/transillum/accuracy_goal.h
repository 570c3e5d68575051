// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// The error that an AccuracyGoal is about, relative to reflected light (reflected_light()). All
/// are limits that are not exceeded in 95 % of all runs, by the spread of replicas, of the channel
/// that is off the most; each channel is relative to its own light.
enum class AccuracyOf {
  /// RMS error of B - E on the worst surface, over the RMS of B - E there (SurfaceErrors::limit).
  /// Surfaces are groups; in a file without, materials; without both, connected components.
  surfaces,
  groups,      ///< the same, of the surfaces named alone
  irradiance,  ///< the same as `surfaces`, of H instead of B - E
  rms,         ///< RMS error of B over RMS of reflected light, over patches
  max,         ///< largest error over the largest reflected light
  patch,       ///< error of one patch over its B - E
  mean,        ///< error of the area-weighted mean of B over the mean of B - E
};

/// The names of the errors (choice.h). The number of a patch follows the name `patch`, names
/// follow the name `groups`.
template <>
const Choices& choices_of<AccuracyOf>();

/// When a solve is accurate enough.
struct AccuracyGoal {
  double accuracy = 0;                   ///< relative error, [0,1); 0: as small as `seconds` allow
  AccuracyOf of = AccuracyOf::surfaces;  ///< the error to limit
  PatchId patch = 0;                     ///< the patch, for AccuracyOf::patch
  std::vector<std::string> surfaces = {};  ///< names of the surfaces, for AccuracyOf::groups
  double seconds = 0;       ///< wall time of the solve, without loading; 0 sets no limit
  std::int64_t passes = 0;  ///< most passes, in all stages; 0 sets no limit

  /// Whether there is a goal.
  bool is_set() const { return accuracy > 0 || seconds > 0; }
  /// @throws InputError naming the value and its range.
  void validate() const;
  /// Exact comparison of all members.
  friend bool operator==(const AccuracyGoal&, const AccuracyGoal&) = default;
};

/// The relative accuracy in `text`: `1%`, or a number such as `0.01`.
/// @throws InputError unless it is greater than 0 and less than 1 (100 %).
double accuracy_from_text(const std::string& text);
/// The error called `name`: `surfaces`, `irradiance`, `rms`, `max`, `mean`, `patch:I` with a patch
/// number, or `groups:NAME,...` with names of surfaces.
/// @returns a goal with only `of`, `patch` and `surfaces` set.
/// @throws InputError listing the choices.
AccuracyGoal accuracy_of_from_name(const std::string& name);
/// The name that accuracy_of_from_name() reads.
std::string name_of_accuracy(const AccuracyGoal& goal);

/// One run of a solve with a goal.
struct AccuracyStage {
  int directions = 0;  ///< M, all replicas together
  int replicas = 0;    ///< 2 or more
  double error = 0;    ///< relative: the limit of AccuracyGoal::of
};

/// Why a solve with a goal ended before it was reached.
enum class AccuracyObstacle {
  none,        ///< reached, or not finished
  seconds,     ///< AccuracyGoal::seconds are over
  passes,      ///< AccuracyGoal::passes allows no further stage
  directions,  ///< no more directions, or points of engine pairs, are possible
  first_shot,  ///< past blockers, the first shot is less accurate than the goal
  stalled,     ///< more directions have not decreased the error
  no_light,    ///< no direction has brought light to a patch that reflects
};

/// The names of the obstacles (choice.h).
template <>
const Choices& choices_of<AccuracyObstacle>();

/// The outcome of a solve with a goal.
struct AccuracyReport {
  AccuracyGoal goal;                  ///< the goal given
  std::vector<AccuracyStage> stages;  ///< in order; the last stage made the result
  double error = 0;                   ///< relative: the limit of AccuracyGoal::of, of the result
  std::string surface;                ///< the worst surface, where the goal is about surfaces
  bool is_dark = false;               ///< SurfaceError::is_dark of that surface
  bool reached = false;               ///< error <= goal.accuracy, and `trusted`
  AccuracyObstacle obstacle = AccuracyObstacle::none;  ///< why it is not reached
  bool trusted = false;  ///< light sources were met by at least least_light_directions per replica
  std::int64_t passes_made = 0;  ///< in all stages
};

}  // namespace TRANSILLUM_API transillum
