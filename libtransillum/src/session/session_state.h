// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// SolveSession::Impl: what a session is made of, from the outside in: rounds, stages, a solver.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "session/accuracy_plan.h"
#include "session/refinement_plan.h"
#include "session/running_solver.h"
#include "transillum/solve_session.h"

namespace transillum {

struct [[gnu::visibility("hidden")]] SolveSession::Impl {
  using Clock = std::chrono::steady_clock;

  SolveRequest request;  ///< scene and tree are those to start from
  Cancellation cancellation;
  std::optional<RefinementPlan> rounds;
  // State of the present round:
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;      ///< null: not built yet
  std::shared_ptr<const DirectLight> shot;  ///< null if there is none, or if it is not shot yet
  std::optional<AccuracyPlan> plan;         ///< plan for a goal
  std::optional<RunningSolver> solver;      ///< solver of the present stage; nothing: not prepared
  std::optional<AccuracyPlan::Next> next;   ///< after this stage, which has ended
  std::optional<Solution> best;             ///< with a goal: result of the last finished stage
  bool assessed = false;                    ///< the round has ended; its patches are to be divided
  double seconds_bsp = 0, seconds_first_shot = 0;
  double seconds_before = 0;                ///< time of finished calls
  std::optional<Clock::time_point> called;  ///< when the present call began
  bool finished = false;

  /// Counts the time of a call.
  class Call {
   public:
    explicit Call(Impl& session) : session_(session) { session_.called = Clock::now(); }
    ~Call() {
      session_.seconds_before = session_.seconds();
      session_.called.reset();
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    Impl& session_;
  };

  Impl(SolveRequest solve_request, const Cancellation& solve_cancellation);

  bool in_rounds() const { return rounds && !rounds->finished(); }
  double seconds() const;
  /// Begins the solve of a scene.
  void begin(const std::shared_ptr<const Scene>& solved);
  void prepare(const Cancellation& interruption);
  /// Advances the solver of the stage.
  /// @returns whether it is to be called again for this stage
  bool advance_stage(RadiositySolver::Until until, const std::function<bool()>& observer);
  /// Begins what follows after a stage.
  /// @returns whether something does
  bool begin_next();

 private:
  void make_solver();
  void build_tree(const Cancellation& interruption);
  void shoot_first(const Cancellation& interruption);
};

}  // namespace transillum
