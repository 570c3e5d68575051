// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solving to an accuracy: chooses the stages by the errors of those before. Input: a Scene and
// SolveOptions with a goal.
#include "session/accuracy_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/memory_limit.h"
#include "radiosity/reflected_light.h"
#include "radiosity/state_archive.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

/// Fewest replicas whose spread shows how independent the errors of patches are. More would lose
/// more of the evenness of one set than their smaller quantile gains.
constexpr int replicas_at_first = 4;
/// The largest of many errors needs a steadier estimate of each.
constexpr int replicas_for_max = 8;
constexpr int most_replicas = 16;
/// Error over goal above which a new stage is cheaper than replicas.
constexpr double most_missing = 1.25;
constexpr int directions_at_first = 6;  ///< per replica
constexpr int directions_at_least = 4;  ///< per replica, where time is short
/// The error is expected to fall as M to this power, negative, before two stages show it.
constexpr double expected_exponent = 1;
/// Most directions per replica in a first stage, which should resolve the lobes of materials.
constexpr double most_at_first = 256;
/// A stage that is this many times smaller than the next costs little and shows the exponent.
constexpr double usual_growth = 8, largest_growth = 12;
/// Directions of a stage from which on a solve that diverges is not tried with more.
constexpr int enough_to_converge = 1 << 14;
/// Fraction of the time left that a stage is made for.
constexpr double time_fraction = 0.85;
/// Fraction of the goal from which on missing iterations are made, instead of more passes.
constexpr double iteration_fraction = 0.25;
/// The same for the error of the first shot, which more points decrease.
constexpr double shot_fraction = 0.5;

/// Directions per replica that resolve the lobes of a scene, up to most_at_first.
int directions_for_lobes(const Scene& scene) {
  double exponent = 0;
  for (const PatchId i : patches_with_lobes(scene)) {
    exponent = std::max(exponent, equivalent_exponent(scene.material(i).lobe));
  }
  return static_cast<int>(std::min(exponent / resolved_exponent(1), most_at_first));
}

/// Directions whose radiance surely fits into memory.
double fitting_directions(const StageResult& result) {
  const auto bytes = static_cast<double>(result.statistics.glossy.radiance_bytes);
  return bytes > 0 ? result.options.directions * (static_cast<double>(free_memory()) / (2 * bytes))
                   : max_directions;
}

}  // namespace

AccuracyPlan::AccuracyPlan(const SolveOptions& options, const Scene& scene)
    : surfaces_(scene, options.goal.surfaces, options.glossy),
      stage_(options),
      shot_points_(shot_options(options), scene.patches().size()) {
  options.validate();
  report_.goal = options.goal;
  error_for(options.goal, scene, {}, {});  // checks the patch
  if (options.replicas < 2) {
    const bool short_of_time = options.goal.seconds > 0;
    stage_.replicas = options.goal.of == AccuracyOf::max ? replicas_for_max : replicas_at_first;
    stage_.directions =
        stage_.replicas * (short_of_time ? directions_at_least : directions_at_first);
    if (options.glossy && !short_of_time) {
      stage_.directions =
          std::max(stage_.directions, stage_.replicas * directions_for_lobes(scene));
    }
  }
  if (options.goal.accuracy > 0) {
    // The change by further iterations is then a fiftieth of the goal.
    stage_.tolerance = std::min(stage_.tolerance, 0.02 * options.goal.accuracy);
  }
}

AccuracyPlan::Next AccuracyPlan::next(const StageResult& result, double seconds) {
  const auto& [scene, solved, b, statistics, estimate, shot, preparing, shooting] = result;
  const AccuracyGoal& goal = report_.goal;
  report_.error = error_for(goal, scene, b, estimate);
  if (!std::isfinite(report_.error)) {  // replicas of few directions may diverge
    report_.error = std::numeric_limits<double>::infinity();
  }
  name_worst_surface(goal, estimate, report_);
  report_.stages.push_back({solved.directions, solved.replicas, report_.error});
  light_directions_ = statistics.light_directions / solved.replicas;
  // Where no direction has met the light of a source, all replicas agree that there is none.
  const bool is_missed =
      statistics.rho_max > 0 && scene.has_light() && max_abs(estimate.mean_reflected) == 0;
  report_.trusted =
      !is_missed && (light_directions_ >= least_light_directions || light_directions_ == 0);
  report_.reached = report_.trusted && report_.error <= goal.accuracy;
  const auto made = static_cast<double>(statistics.passes_made - passes_before_);
  // A caller that resumes may not know how long the solve took before.
  const double per_pass = std::max(0.0, seconds - preparing - seconds_) / std::max(1.0, made);
  report_.passes_made += statistics.passes_made - passes_before_;
  passes_before_ = statistics.passes_made;
  seconds_ = seconds - preparing;
  const double left =
      goal.seconds > 0 ? goal.seconds - seconds : std::numeric_limits<double>::infinity();
  if (report_.reached) {
    return end(AccuracyObstacle::none);
  }
  if (is_missed && report_.error == 0) {
    return end(AccuracyObstacle::no_light);
  }
  if (left <= 0) {
    return end(AccuracyObstacle::seconds);
  }
  if (is_stalled()) {
    return end(AccuracyObstacle::stalled);
  }
  if (goal.accuracy > 0) {
    if (solved.directions * per_pass <= time_fraction * left && asks_for_iterations(result)) {
      return again();
    }
    if (const auto end_or_stage = refine_shot(result, time_fraction * left)) {
      return *end_or_stage;
    }
  }
  // Error ~ 1/sqrt(number of replicas); a new stage makes all its passes, but gains more.
  const double missing = report_.error / goal.accuracy;
  const int replicas = solved.replicas, per_replica = solved.directions / replicas;
  const double more = std::ceil(replicas * (missing * missing - 1));
  const bool replica_suffices = report_.trusted && goal.accuracy > 0 && missing <= most_missing &&
                                replicas + more <= most_replicas && statistics.glossy.patches == 0;
  if (replica_suffices && per_replica * per_pass <= left && per_replica <= passes_left()) {
    return Next::replica;
  }
  return grow(growth(), time_fraction * left / per_pass, fitting_directions(result));
}

/// The same stage again, with what has changed.
AccuracyPlan::Next AccuracyPlan::again() {
  if (stage_.directions > passes_left()) {
    return end(AccuracyObstacle::passes);
  }
  passes_before_ = 0;
  return Next::stage;
}

/// No number of passes replaces iterations, which the goal may ask more of than the tolerance: a
/// patch, where it is dark.
/// @returns whether the stage's tolerance is smaller now
bool AccuracyPlan::asks_for_iterations(const StageResult& result) {
  const double missing = StageErrors(result, surfaces_, report_.goal).of_iteration();
  const double allowed = iteration_fraction * report_.goal.accuracy;
  if (!(missing > allowed) || !std::isfinite(missing)) {
    return false;
  }
  const IterationRecord& last = result.statistics.iteration_records.back();
  const double reached = std::max(last.remainder, last.remainder_dimmest);
  if (is_rounding(last) || !(reached > 0)) {
    return false;
  }
  stage_.tolerance = 0.5 * allowed / missing * std::min(stage_.tolerance, reached);
  return true;
}

/// No number of passes makes the first shot more accurate.
/// @param seconds_left for more shots
/// @returns nothing where it is accurate enough
std::optional<AccuracyPlan::Next> AccuracyPlan::refine_shot(const StageResult& result,
                                                            double seconds_left) {
  if (result.shot == nullptr) {
    return {};
  }
  const double goal = report_.goal.accuracy;
  const StageErrors errors(result, surfaces_, report_.goal);
  const double error = errors.of_shot();
  if (!(error > shot_fraction * goal)) {
    return {};
  }
  const std::vector<PatchId> patches = errors.patches_to_refine(0.5 * shot_fraction * goal);
  const double work = shot_points_.work_to_refine(patches);
  const bool is_late =
      std::isfinite(work) && result.seconds_first_shot * work > seconds_left * shot_points_.work();
  if (std::isfinite(work) && !is_late) {
    shot_points_.refine(patches);
    return again();
  }
  if (error > goal) {
    return end(is_late ? AccuracyObstacle::seconds : AccuracyObstacle::first_shot);
  }
  return {};
}

AccuracyPlan::Next AccuracyPlan::end(AccuracyObstacle obstacle) {
  report_.obstacle = obstacle;
  return Next::done;
}

/// By how much M should grow for the goal. Of errors of different numbers of replicas, those are
/// compared that the stage's own number would have.
double AccuracyPlan::growth() const {
  const auto& stages = report_.stages;
  const auto per_replica = [](const AccuracyStage& stage) {
    return static_cast<double>(stage.directions) / stage.replicas;
  };
  const auto error = [&](const AccuracyStage& stage) {
    return stage.error * std::sqrt(static_cast<double>(stage.replicas) / stage_.replicas);
  };
  const AccuracyStage& last = stages.back();
  const auto before = std::find_if(stages.rbegin(), stages.rend(), [&](const AccuracyStage& stage) {
    return 2 * per_replica(stage) <= per_replica(last);
  });
  if (!std::isfinite(last.error) || last.error == 0) {
    return usual_growth;
  }
  double exponent = expected_exponent;
  if (before != stages.rend() && std::isfinite(before->error)) {
    const double measured =
        std::log(error(*before) / error(last)) / std::log(per_replica(last) / per_replica(*before));
    exponent = std::clamp(measured, 0.6, 1.3);
  }
  const double accuracy = report_.goal.accuracy;
  double factor = accuracy > 0 ? std::pow(error(last) / accuracy, 1 / exponent) : largest_growth;
  if (!report_.trusted) {
    factor = std::max(factor, 1.2 * least_light_directions / light_directions_);
  }
  if (factor > largest_growth) {
    factor = std::clamp(factor / usual_growth, 4.0, largest_growth);
  }
  return std::max(factor, 1.1);
}

AccuracyPlan::Next AccuracyPlan::grow(double factor, double by_time, double by_memory) {
  const double before = stage_.directions, per_replica = before / stage_.replicas;
  const double allowed = passes_left();
  const double possible = std::min(by_memory, double(max_directions));
  const double wanted = std::min({factor * before, by_time, possible, allowed});
  if (const double least = 1.1 * before; wanted < least) {
    return end(allowed < least   ? AccuracyObstacle::passes
               : by_time < least ? AccuracyObstacle::seconds
                                 : AccuracyObstacle::directions);
  }
  // A stage has at most as many passes as are left.
  const double count =
      std::max(per_replica, std::ceil(per_replica * wanted / before) - (wanted == allowed ? 1 : 0));
  stage_.directions = stage_.replicas * static_cast<int>(count);
  passes_before_ = 0;
  return Next::stage;
}

double AccuracyPlan::passes_left() const {
  const std::int64_t most = report_.goal.passes;
  return most > 0 ? static_cast<double>(std::max<std::int64_t>(0, most - report_.passes_made))
                  : std::numeric_limits<double>::infinity();
}

/// Whether something else than the number of directions bounds the error. Where light is rare, the
/// errors of few directions are too uncertain to tell.
bool AccuracyPlan::is_stalled() const {
  constexpr int more_directions = 16;
  const auto& stages = report_.stages;
  const AccuracyStage& last = stages.back();
  const auto before = std::find_if(stages.rbegin(), stages.rend(), [&](const AccuracyStage& stage) {
    return more_directions * stage.directions <= last.directions;
  });
  return before != stages.rend() && last.error > 0.9 * before->error;
}

bool AccuracyPlan::enlarge() {
  if (stage_.directions >= enough_to_converge) {
    return false;
  }
  constexpr int growth = 4;
  stage_.directions *= growth;
  passes_before_ = 0;
  return true;
}

template <class Archive, class Self>
void AccuracyPlan::visit_state(Archive& archive, Self& self) {
  constexpr std::uint64_t most_stages = 1000;
  auto& report = self.report_;
  std::uint64_t stages = report.stages.size();
  archive(stages);
  archive.require(stages < most_stages);
  if constexpr (Archive::reading) {
    report.stages.resize(static_cast<std::size_t>(stages));
  }
  for (auto& stage : report.stages) {
    archive(stage.directions, stage.replicas, stage.error);
  }
  std::vector<char> surface(report.surface.begin(), report.surface.end());
  auto obstacle = static_cast<int>(report.obstacle);
  archive(surface, report.is_dark, obstacle, self.shot_points_);
  archive.require(obstacle >= 0 &&
                  obstacle < static_cast<int>(choices_of<AccuracyObstacle>().names.size()));
  if constexpr (Archive::reading) {
    report.surface.assign(surface.begin(), surface.end());
    report.obstacle = static_cast<AccuracyObstacle>(obstacle);
  }
  archive(report.error, report.reached, report.trusted, report.passes_made, self.stage_.directions,
          self.stage_.replicas, self.stage_.tolerance, self.light_directions_, self.seconds_,
          self.passes_before_);
}

void AccuracyPlan::save(std::ostream& out) const {
  StateOutput archive(out);
  visit_state(archive, *this);
}

void AccuracyPlan::restore(std::istream& in, std::uint64_t size) {
  StateInput archive(in, size);
  visit_state(archive, *this);
  archive.finish();
  try {
    stage_.validate();
  } catch (const InputError&) {
    throw DamagedState();
  }
}

}  // namespace transillum
