// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solving until the sum of all four errors is as asked: patches are divided and directions added in
// turn, by what an ErrorReport measures.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "session/measure_errors.h"
#include "transillum/cancellation.h"
#include "transillum/solve_session.h"

namespace transillum {

/// One solve on the way to a total error, and its measured errors.
struct TotalStage {
  std::int64_t patches = 0;  ///< patches of the scene
  int passes = 0;            ///< per iteration
  std::string surface;       ///< the worst one
  CauseErrors errors = {};   ///< its errors
  double seconds = 0;        ///< wall time of solve and measurements
};

/// Why a solve to a total error ended.
enum class TotalEnd {
  reached,     ///< no surface has a larger total
  patches,     ///< a further division exceeds the most patches
  memory,      ///< a further division does not fit into memory
  directions,  ///< the error of the directions does not get as small as required
  thin,        ///< the patches to divide are too thin
  canceled,    ///< the result is the one of the stage before
  other,       ///< iterations and method alone exceed what was asked
};
/// The end as a phrase: "not reached with at most 5,000 patches".
std::string end_text(TotalEnd end, std::int64_t most_patches);

/// The goal of a solve to a total error.
struct TotalGoal {
  double total = 0.01;               ///< CauseErrors::total() of the worst surface, (0,1)
  std::int64_t patches = 1'000'000;  ///< the most patches to make
};

/// The stages of a solve to a total error. For each, the caller solves request(), measures its
/// errors, and calls next(). A third of the total is meant for directions, the rest for patches:
/// with errors that fall as 1/M and as the size of patches, this costs least. Not thread-safe.
class TotalPlan {
 public:
  /// @param request without rounds; its options need no goal.
  /// @throws InputError
  TotalPlan(SolveRequest request, const TotalGoal& goal);

  /// The next solve.
  const SolveRequest& request() const { return request_; }
  /// To be called after each stage.
  /// @param solve of request().
  /// @param report its errors.
  /// @param seconds wall time of both.
  /// @returns whether another stage follows
  /// @throws Canceled while patches are divided
  bool next(const MeasuredSolve& solve, const ErrorReport& report, double seconds,
            const Cancellation& cancellation = {});
  /// The finished stages, in order; none in a scene without surfaces to measure.
  const std::vector<TotalStage>& stages() const { return stages_; }
  /// Why no stage follows. Requires that next() has returned false.
  TotalEnd end() const { return end_; }

 private:
  bool end(TotalEnd why) {
    end_ = why;
    return false;
  }
  bool divide_worst(const ErrorReport& report, const Cancellation& cancellation);
  bool ask_more_of_directions(const CauseErrors& worst, const MeasuredSolve& solve);

  SolveRequest request_;
  TotalGoal goal_;
  double directions_;  ///< error of directions to reach in the next stage
  std::vector<TotalStage> stages_;
  TotalEnd end_ = TotalEnd::reached;
};

/// The outcome of a solve to a total error.
struct TotalSolve {
  MeasuredSolve solve;             ///< the last solve
  ErrorReport report;              ///< its errors
  std::vector<TotalStage> stages;  ///< in order; the last is of `solve`
  TotalEnd end = TotalEnd::reached;
};

/// Functions that are called meanwhile; each may be empty.
struct TotalObservers {
  SolveSession::Observer solve = {};             ///< observes each solve; its result is not used
  MeasurementObserver measurement = {};          ///< observes each measurement
  std::function<void(const TotalStage&)> stage;  ///< called after each stage
};

/// Which patches of a solve are to be divided for `total`, in ascending order: on each surface
/// whose patches are too large, the worst, until what is left of their error is small enough.
/// @param report of a solve of `scene`
/// @param kept AccuracyGoal::surfaces of the solve
std::vector<PatchId> patches_to_divide(const Scene& scene, const ErrorReport& report, double total,
                                       const std::vector<std::string>& kept = {});

/// Solves until the total error of each surface is at most as asked, by the stages of a TotalPlan.
/// @param request as for TotalPlan.
/// Once a stage has ended, a cancellation ends it with the result of that stage.
/// @throws InputError; Canceled in the first stage; exceptions of solve()
TotalSolve solve_to_total(SolveRequest request, const TotalGoal& goal,
                          const TotalObservers& observers = {},
                          const Cancellation& cancellation = {});

}  // namespace transillum
