// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "transillum/glossy.h"
#include "transillum/radiosity.h"

namespace transillum::viewer {

/// The solver of a solve run: a GlossySolver where lobes take part, else a RadiositySolver.
///
/// Threads: as these.
class RunningSolver {
 public:
  explicit RunningSolver(std::unique_ptr<RadiositySolver> solver) : diffuse_(std::move(solver)) {}
  explicit RunningSolver(std::unique_ptr<GlossySolver> solver) : glossy_(std::move(solver)) {}
  /// A new solver; options.glossy has no effect on a scene without lobes.
  /// @throws InputError, Canceled
  static std::unique_ptr<RunningSolver> make(const LoadedScene& loaded, const SolveOptions& options,
                                             const Cancellation& cancellation);

  /// Null where lobes take part.
  RadiositySolver* diffuse() const { return diffuse_.get(); }
  /// Null where no lobes take part.
  GlossySolver* glossy() const { return glossy_.get(); }

  using Until = RadiositySolver::Until;
  /// Continues the solve. The observer is called after every pass and iteration, with lobes after
  /// groups of passes, and returns whether to go on.
  /// @returns whether the solve is unfinished
  bool advance(Until until, const std::function<bool()>& observer);

  const SolveOptions& options() const;
  SolveProgress progress() const;
  SolveStatistics statistics() const;
  /// Of the newest iteration.
  const std::vector<Vec3>& directions() const;
  std::vector<Vec3> directions_of(int iteration) const;
  int passes_of(int iteration) const;
  /// B of the last finished iteration, W/m².
  std::vector<Rgb> radiosity() const;
  std::vector<LinearPart> linear_parts() const;
  /// B after each pass of the iteration under way, relative changes.
  std::vector<double> estimate_changes() const;
  ErrorEstimate error_estimate() const;
  /// Sets the values of patches and figures.
  void write_to(SolverSnapshot& snapshot) const;

 private:
  std::unique_ptr<RadiositySolver> diffuse_;
  std::unique_ptr<GlossySolver> glossy_;
};

}  // namespace transillum::viewer
