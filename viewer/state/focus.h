// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The position in the solve run (iteration, direction, step, phase) that all views share.
#pragma once

#include <QObject>
#include <QString>
#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/requests/recorded_map.h"
#include "state/step_events.h"
#include "support/has_index.h"
#include "transillum/at.h"

namespace transillum::viewer {

/// A position in the sequence of steps of a solve run, ordered by time.
struct RunPosition {
  int iteration = 0;       ///< n, from 0; iteration n computes B(n+1) from B(n)
  int direction = 0;       ///< from 0: number of the pass
  std::int32_t step = -1;  ///< step of the direction, from 0; -1 before the first

  // clang-tidy 14 takes the 0 that a result is compared with for a pointer.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const RunPosition&, const RunPosition&) = default;
};

/// The part of a step that is shown, in the order of the paper's pseudo-code (section 3.2).
enum class Phase {
  before,  ///< polygon i is next; V is as the previous step left it
  split,   ///< V is clipped by i: the inside and the outside list
  after,   ///< V without the inside list and with i
};

/// Why a step is shown.
enum class StepReason {
  none,        ///< no step has been chosen: the whole direction is meant
  stepped,     ///< next to the step shown before
  chosen,      ///< by the user, in a view
  found,       ///< by a search
  breakpoint,  ///< a breakpoint holds
  page,        ///< a lesson or a session file names it
};
/// A few words.
QString text_of(StepReason reason);

/// The position in the solve run that all views show, and the commands that change it. Views follow
/// it and do not refer to each other.
///
/// The history of a direction must be recorded before it can be shown: map_requested() requests it
/// and show_map() delivers it. Until then the old position stays; a newer target replaces an older.
///
/// Threads: the main thread only.
class Focus : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Starts a solve run with new directions; nothing is shown yet.
  /// @param passes  per iteration
  /// @param renews  each iteration has its own directions
  void begin_run(int passes, bool renews = false);
  /// The number of iterations that have begun; later ones cannot be shown.
  void set_iterations(int count);
  /// The number of passes of each iteration that has begun, if not all have passes().
  void set_passes_of_iterations(std::vector<int> passes);
  int iterations() const { return iterations_; }
  int passes() const { return passes_; }
  /// The number of passes of an iteration.
  int passes_of(int iteration) const {
    return has_index(iteration_passes_, iteration) ? at(iteration_passes_, iteration) : passes_;
  }

  /// The shown position; map() has its direction. Valid only with a map.
  const RunPosition& position() const { return position_; }
  std::shared_ptr<const RecordedMap> map() const { return map_; }
  Phase phase() const { return phase_; }
  /// The step whose V makes a picture: position().step, or the fullest of a whole direction.
  /// Valid only with a map.
  std::int32_t picture_step() const {
    return at_step() ? position_.step : map_->record().fullest_step();
  }
  /// The requested position, or position() if none is requested. The step may be unknown (-1) until
  /// the direction is recorded.
  const RunPosition& target() const { return target_; }
  bool arrived() const { return !under_way_; }
  /// Why position() has its step. Without a reason, it is after the last step.
  StepReason reason() const { return reason_; }
  /// Whether a step is shown, rather than the whole direction.
  bool at_step() const { return reason_ != StepReason::none; }
  /// Whether the position follows the newest direction.
  bool following() const { return following_; }
  bool seeking() const { return under_way_ && seek_left_ > 0; }

  /// The point of the plane whose line along omega is inspected; cleared with its direction.
  const std::optional<Vec2>& probe() const { return probe_; }
  void set_probe(const std::optional<Vec2>& probe);
  /// Which events are listed; while it is on(), step_by() skips steps without one.
  const EventFilter& filter() const { return filter_; }
  void set_filter(const EventFilter& filter);

  // Each of these functions, except follow(), ends following. Values out of range are clamped.

  void go_to(const RunPosition& position, StepReason reason = StepReason::chosen);
  /// Goes to a step of the same direction.
  void go_to_step(std::int32_t step);
  /// Goes to the first step of a direction that `finder` finds; before the first step if it finds
  /// none.
  void go_to_first(int iteration, int direction, StepFinder finder);
  /// Goes at most to an end of the direction, and from there to the next direction. With a filter,
  /// continues to the nearest step that has an event which passes, like seek(). From a whole
  /// direction, steps forward begin before its first step.
  /// @return false at an end of the run
  bool step_by(std::int32_t steps);
  /// Shows the whole direction instead of a step.
  void show_whole();
  /// Goes to the same step of another direction; while no step is shown, to all of the direction.
  void go_to_direction(int iteration, int direction);
  void direction_by(int directions);
  void iteration_by(int iterations);
  /// Goes one phase forward (+1) or back (-1), over the ends of a step.
  void phase_by(int phases);
  void set_phase(Phase phase);
  /// Goes to the nearest step after (before) this one that `finder` finds, searching all directions
  /// of the run; ends with seek_ended() or seek_stopped().
  void seek(StepFinder finder, StepOrder order, StepReason reason = StepReason::found);
  /// Drops the target and ends a search.
  void stop();
  /// If `following`, shows the whole newest direction, now and on each follow().
  void set_following(bool following);
  /// Reports the newest direction of the solve run.
  void follow(int iteration, int direction);

  /// Shows the map of the same direction in a scene whose faces are moved. A step that it does not
  /// have becomes its last.
  void replace_map(std::shared_ptr<const RecordedMap> map);

  /// Delivers a map after map_requested().
  void show_map(std::shared_ptr<const RecordedMap> map);

 signals:
  void moved();           ///< position, map or phase
  void target_changed();  ///< target, valid range, following() or seeking()
  void map_requested(int iteration, int direction);
  void seek_ended(bool found);
  void seek_stopped(int searched);  ///< number of directions searched without success
  void probed();
  void filtered();  ///< filter()

 private:
  /// Selects the step of a recorded direction; MapHistory::none continues with another direction.
  using Arrival = std::function<std::int32_t(const MapHistory&)>;

  /// Whether `map` is of the direction at `position`.
  bool shows(const RecordedMap& map, const RunPosition& position) const;
  /// `from` if the result would be outside the run.
  RunPosition moved_by(const RunPosition& from, int directions, std::int32_t step) const;
  void set_target(int iteration, int direction, std::int32_t step, Arrival arrival);
  void go_to_newest();
  void arrive(std::int32_t step);
  void continue_seek();
  /// Goes to the nearest end of a direction, and searches it from there.
  void seek_in(const RunPosition& direction);
  void seek_from(std::int32_t step, StepFinder finder, StepOrder order, StepReason reason);
  void end_seek();
  /// Ends a search without success.
  void lose();
  void end_following();

  int passes_ = 0, iterations_ = 1;
  std::vector<int> iteration_passes_;
  bool renews_ = false;
  RunPosition position_, target_, newest_;
  std::shared_ptr<const RecordedMap> map_;
  Phase phase_ = Phase::after;
  StepReason reason_ = StepReason::none, target_reason_ = StepReason::none;
  std::optional<Phase> phase_unless_found_;  ///< comes back if a search ends without success
  std::optional<Vec2> probe_;
  EventFilter filter_;
  bool following_ = true;
  bool under_way_ = false;
  Arrival arrival_;
  StepFinder finder_;
  StepOrder order_ = StepOrder::forward;
  std::int64_t seek_total_ = 0,
               seek_left_ = 0;  ///< numbers of directions: of the search, and to be searched
};

}  // namespace transillum::viewer
