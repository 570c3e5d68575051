// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solving until the sum of all four errors is as asked: patches are divided and directions added in
// turn, by what an ErrorReport measures.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
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

/// The outcome of a solve to a total error.
struct TotalSolve {
  MeasuredSolve solve;             ///< the last solve
  ErrorReport report;              ///< its errors
  std::vector<TotalStage> stages;  ///< in order; the last is of `solve`
  TotalEnd end = TotalEnd::reached;
};

/// Which patches of a solve are to be divided for `total`, in ascending order: on each surface
/// whose patches are too large, the worst, until what is left of their error is small enough.
/// @param report of a solve of `scene`
/// @param kept AccuracyGoal::surfaces of the solve
std::vector<PatchId> patches_to_divide(const Scene& scene, const ErrorReport& report, double total,
                                       const std::vector<std::string>& kept = {});

/// The stages of a solve until the total error of each surface is at most as asked. Each stage: the
/// caller solves stage() in a SolveSession, then calls assess(). A third of the total is meant for
/// directions, the rest for patches: with errors that fall as 1/M and as the size of patches, this
/// costs least. Not thread-safe.
class TotalPlan {
 public:
  /// @param request without rounds; its options need no goal.
  /// @throws InputError
  TotalPlan(SolveRequest request, const TotalGoal& goal);

  /// The solve of the present stage.
  const SolveRequest& stage() const { return request_; }
  /// The divisions that make the scene of stage() from the one of the request: SceneInput::divided.
  std::vector<std::string> divisions() const;
  /// Whether no stage is left.
  bool finished() const { return finished_; }
  /// Whether outcome() has a solve.
  bool has_result() const { return outcome_.solve.solution.scene != nullptr; }
  /// The outcome so far.
  const TotalSolve& outcome() const { return outcome_; }
  /// Measures the errors of a stage, and divides patches or asks more of the directions.
  /// @param session of stage(), finished.
  /// @throws Canceled, after which the stage before is the last, and it may be called again;
  /// InputError
  void assess(const SolveSession& session, const Cancellation& cancellation = {},
              const MeasurementObserver& observer = {});
  /// Ends with the result of the stage before.
  void cancel();

  /// Writes what was decided so far. The result of the stage before is not kept.
  void save(std::ostream& out) const;
  /// Sets a new plan to what save() wrote from a plan with the same request and goal.
  /// @param size length of the state, bytes.
  /// @throws DamagedState, Canceled
  void restore(std::istream& in, std::uint64_t size, const Cancellation& cancellation = {});

 private:
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self);

  void end(TotalEnd why);
  void divide_worst(const Cancellation& cancellation);
  void solve_next(const std::shared_ptr<const Scene>& scene);
  void ask_more_of_directions(const CauseErrors& worst);

  SolveRequest request_;
  TotalGoal goal_;
  bool finished_ = false;
  TotalSolve outcome_;
  /// After each stage, the patches of its scene that were divided.
  std::vector<std::vector<PatchId>> divisions_;
};

}  // namespace transillum
