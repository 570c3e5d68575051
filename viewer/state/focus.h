// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/recorded_map.h"
#include "state/step_finder.h"

namespace transillum::viewer {

/// A point in the time of a run; later ones are larger.
struct RunPosition {
  int iteration = 0;       ///< from 0: the step that makes B(n+1) of B(n)
  int direction = 0;       ///< from 0: number of the pass
  std::int32_t step = -1;  ///< of the direction, from 0; -1: before its first

  friend auto operator<=>(const RunPosition&, const RunPosition&) = default;
};

/// What of a step is looked at; the order of the paper's pseudo-code (section 3.2).
enum class Phase {
  before,  ///< polygon i is taken, V is what the steps before left
  split,   ///< what it cut out of V: the inside and the outside list
  after,   ///< V without the inside list and with i
};

/// The moment that all views show, and the ways to another one. The views know it, and never each
/// other.
///
/// A direction's history has to be recorded first: what is wanted goes out by map_requested() and
/// comes back by show_map(); until then the old moment stays, and a newer wish replaces an older.
class Focus : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// New directions, `passes` a step, of which nothing has been shown yet. `renews`: each step has
  /// directions of its own.
  void begin_run(int passes, bool renews = false);
  /// How many iteration steps have begun; no others can be focused.
  void set_iterations(int count);
  /// Of each step that has begun, where they have not all `passes`.
  void set_passes_of_steps(std::vector<int> passes);
  int iterations() const { return iterations_; }
  int passes() const { return passes_; }
  /// Directions that can be focused in a step.
  int passes_of(int iteration) const {
    const auto n = static_cast<std::size_t>(iteration);
    return n < step_passes_.size() ? step_passes_[n] : passes_;
  }

  /// What is shown; its direction is map()'s. Without a map there is no moment to show.
  const RunPosition& position() const { return position_; }
  std::shared_ptr<const RecordedMap> map() const { return map_; }
  Phase phase() const { return phase_; }
  /// Where it is going, or position(); of a direction not recorded yet the step may be unknown
  /// (-1).
  const RunPosition& target() const { return target_; }
  bool arrived() const { return !under_way_; }
  /// Whether it stays with the newest direction.
  bool following() const { return following_; }
  bool seeking() const { return under_way_ && seek_left_ > 0; }

  /// The point of the plane whose line is asked about; forgotten with its direction.
  const std::optional<Vec2>& probe() const { return probe_; }
  void set_probe(const std::optional<Vec2>& probe);

  /// Each of these but follow() ends the following. Out of range means the nearest there is.
  void go_to(const RunPosition& position);
  /// To the first step of a direction that `finder` finds; before its first where there is none.
  void go_to_first(int iteration, int direction, StepFinder finder);
  /// To an end of the direction at most; from there on to the next one. False at the run's end.
  bool step_by(std::int32_t steps);
  /// The same step of another direction, and of another iteration step.
  void direction_by(int directions);
  void iteration_by(int iterations);
  /// One phase on (or back), at the end of a step to the next (previous) one.
  void phase_by(int phases);
  void set_phase(Phase phase);
  /// To the nearest step after (before) this one that `finder` finds, through all directions of the
  /// run if need be; ends with seek_ended(), or with seek_stopped().
  void seek(StepFinder finder, StepOrder order);
  /// Stays where it is.
  void stop();
  /// Goes to the fullest step of a direction and stays with the newest ones, if `following`.
  void set_following(bool following);
  void follow(int iteration, int direction);

  /// The answer to map_requested().
  void show_map(std::shared_ptr<const RecordedMap> map);

 signals:
  void moved();           ///< position, map or phase
  void target_changed();  ///< what is wanted, what can be, whether it follows or seeks
  void map_requested(int iteration, int direction);
  void seek_ended(bool found);
  void seek_stopped(int searched);  ///< in vain until now: so many directions
  void probed();

 private:
  /// The step to show of a direction once it is known; MapHistory::none: another direction.
  using Arrival = std::function<std::int32_t(const MapHistory&)>;

  /// Whether `map` is of the direction at `moment`.
  bool shows(const RecordedMap& map, const RunPosition& position) const;
  /// `from` where the run does not reach so far.
  RunPosition moved_by(const RunPosition& from, int directions, std::int32_t step) const;
  void go(int iteration, int direction, std::int32_t step, Arrival arrival);
  void go_to_newest();
  void arrive(std::int32_t step);
  void seek_on();
  void end_seek();
  void leave_newest();

  int passes_ = 0, iterations_ = 1;
  std::vector<int> step_passes_;
  bool renews_ = false;
  RunPosition position_, target_, newest_;
  std::shared_ptr<const RecordedMap> map_;
  Phase phase_ = Phase::after;
  std::optional<Vec2> probe_;
  bool following_ = true;
  bool under_way_ = false;
  Arrival arrival_;
  StepFinder finder_;
  StepOrder order_ = StepOrder::forward;
  std::int64_t seek_all_ = 0, seek_left_ = 0;  ///< directions to be searched
};

}  // namespace transillum::viewer
