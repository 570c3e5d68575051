// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// State machine of the shown position: a command sets the target and a rule that selects the step;
// the recorded map of the target's direction comes later, by show_map(), and completes the move.
#include "state/focus.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace transillum::viewer {

namespace {

std::int32_t nearest_step(const MapHistory& history, std::int32_t step) {
  return std::clamp(step, -1, history.step_count() - 1);
}

constexpr std::int32_t last_step = std::numeric_limits<std::int32_t>::max();

}  // namespace

QString text_of(StepReason reason) {
  switch (reason) {
    case StepReason::none:
      break;
    case StepReason::stepped:
      return Focus::tr("stepped to");
    case StepReason::chosen:
      return Focus::tr("chosen");
    case StepReason::found:
      return Focus::tr("found by the search");
    case StepReason::breakpoint:
      return Focus::tr("a breakpoint holds");
    case StepReason::page:
      return Focus::tr("set by the page");
  }
  return {};
}

void Focus::begin_run(int passes, bool renews) {
  passes_ = passes;
  renews_ = renews;
  iterations_ = 1;
  iteration_passes_.clear();
  position_ = target_ = newest_ = {};
  reason_ = target_reason_ = StepReason::none;
  map_ = nullptr;
  set_probe(std::nullopt);
  following_ = true;
  under_way_ = false;
  seek_left_ = 0;
  emit target_changed();
  emit moved();
}

void Focus::set_iterations(int count) {
  count = std::max(count, 1);
  if (count == iterations_) {
    return;
  }
  iterations_ = count;
  emit target_changed();
}

void Focus::set_passes_of_iterations(std::vector<int> passes) {
  if (passes == iteration_passes_) {
    return;
  }
  iteration_passes_ = std::move(passes);
  emit target_changed();
}

void Focus::go_to(const RunPosition& position, StepReason reason) {
  if (passes_ == 0) {
    return;
  }
  end_following();
  seek_left_ = 0;
  target_reason_ = reason;
  set_target(
      position.iteration, position.direction, position.step,
      [step = position.step](const MapHistory& history) { return nearest_step(history, step); });
}

void Focus::go_to_step(std::int32_t step) {
  go_to({position_.iteration, position_.direction, step});
}

void Focus::show_whole() {
  if (map_ && at_step()) {
    go_to({position_.iteration, position_.direction, last_step}, StepReason::none);
  }
}

void Focus::go_to_first(int iteration, int direction, StepFinder finder) {
  if (passes_ == 0) {
    return;
  }
  end_following();
  seek_left_ = 0;
  target_reason_ = StepReason::found;
  set_target(iteration, direction, -1, [finder = std::move(finder)](const MapHistory& history) {
    return finder(history, -1, StepOrder::forward);
  });
}

RunPosition Focus::moved_by(const RunPosition& from, int directions, std::int32_t step) const {
  RunPosition to{from.iteration, from.direction + directions, step};
  while (to.direction < 0) {
    if (to.iteration == 0) {
      return from;
    }
    to.direction += passes_of(--to.iteration);
  }
  while (to.direction >= passes_of(to.iteration)) {
    to.direction -= passes_of(to.iteration);
    if (++to.iteration == iterations_) {
      return from;
    }
  }
  return to;
}

bool Focus::step_by(std::int32_t steps) {
  if (!map_) {
    return false;
  }
  const std::int32_t last = map_->history.step_count() - 1;
  const std::int32_t now = !at_step() && steps > 0 ? -1 : position_.step;
  if (filter_.on()) {
    const auto passes = [filter = filter_](const MapHistory& history, std::int32_t k) {
      return filter.passes_at(history, k);
    };
    if (steps > 0) {
      seek_from(std::min(now + steps - 1, last), find_where(passes), StepOrder::forward,
                StepReason::stepped);
    } else {
      seek_from(std::clamp(now + steps + 1, 0, std::max(now, 0)), find_where(passes),
                StepOrder::backward, StepReason::stepped);
    }
    return true;
  }
  RunPosition to = position_;
  // The empty map of the next direction follows the last step; the last step of the previous
  // direction precedes an empty map.
  if (steps > 0 && now == last) {
    to = moved_by(position_, 1, -1);
  } else if (steps < 0 && now == -1) {
    to = moved_by(position_, -1, last_step);
  } else {
    to.step = std::clamp(now + steps, -1, last);
  }
  if (to == position_ && at_step()) {
    return false;
  }
  go_to(to, StepReason::stepped);
  return true;
}

void Focus::direction_by(int directions) {
  if (passes_ > 0) {
    const RunPosition to = moved_by(target_, directions, position_.step);
    go_to_direction(to.iteration, to.direction);
  }
}

void Focus::iteration_by(int iterations) {
  go_to_direction(target_.iteration + iterations, target_.direction);
}

void Focus::go_to_direction(int iteration, int direction) {
  go_to({iteration, direction, at_step() ? position_.step : last_step}, reason_);
}

void Focus::set_phase(Phase phase) {
  const bool changed = following_ || !at_step() || phase != phase_;
  end_following();
  phase_ = phase;
  if (!at_step()) {
    reason_ = target_reason_ = StepReason::chosen;
  }
  if (changed) {
    emit moved();
  }
}

void Focus::set_probe(const std::optional<Vec2>& probe) {
  probe_ = probe;
  emit probed();
}

void Focus::phase_by(int phases) {
  const int phase = static_cast<int>(phase_) + phases;
  const bool within = 0 <= phase && phase <= static_cast<int>(Phase::after);
  if (within && position_.step >= 0 && at_step()) {
    set_phase(static_cast<Phase>(phase));
    return;
  }
  const Phase now = std::exchange(phase_, phases > 0 ? Phase::before : Phase::after);
  phase_unless_found_ = now;
  if (!step_by(phases > 0 ? 1 : -1)) {
    phase_ = now;
  }
  if (!seeking()) {
    phase_unless_found_.reset();
  }
}

void Focus::set_filter(const EventFilter& filter) {
  if (filter == filter_) {
    return;
  }
  filter_ = filter;
  emit filtered();
}

void Focus::seek(StepFinder finder, StepOrder order, StepReason reason) {
  const bool begins = !at_step() && order == StepOrder::forward;
  seek_from(begins ? -1 : position_.step, std::move(finder), order, reason);
}

void Focus::seek_from(std::int32_t from, StepFinder finder, StepOrder order, StepReason reason) {
  if (passes_ == 0) {
    return;
  }
  end_following();
  finder_ = std::move(finder);
  order_ = order;
  target_reason_ = reason;
  // Visits every direction once, and the first one again for its steps on the other side of the
  // position.
  const bool same_directions = !renews_ && passes_of(0) == passes_;
  seek_total_ = seek_left_ = (same_directions ? 1 : std::int64_t{iterations_}) * passes_ + 1;
  if (!map_) {
    seek_in(newest_);
    return;
  }
  target_ = position_;
  const std::int32_t step = finder_(map_->history, from, order_);
  if (step != MapHistory::none) {
    position_.step = target_.step = step;
    reason_ = target_reason_;
    end_seek();
    emit moved();
    emit seek_ended(true);
  } else {
    continue_seek();
  }
}

void Focus::continue_seek() {
  const int by = order_ == StepOrder::forward ? 1 : -1;
  const RunPosition next = moved_by(target_, by, -1);
  if (--seek_left_ <= 0 || next == target_) {
    target_ = position_;
    lose();
    emit seek_ended(false);
    return;
  }
  seek_in(next);
}

void Focus::seek_in(const RunPosition& direction) {
  set_target(direction.iteration, direction.direction, -1, [this](const MapHistory& history) {
    return finder_(history, order_ == StepOrder::forward ? -1 : history.step_count(), order_);
  });
}

void Focus::lose() {
  target_reason_ = reason_;
  if (phase_unless_found_) {
    phase_ = *phase_unless_found_;
  }
  end_seek();
}

void Focus::end_seek() {
  phase_unless_found_.reset();
  seek_left_ = 0;
  under_way_ = false;
  emit target_changed();
}

void Focus::stop() {
  end_following();
  const bool sought = seeking();
  const auto searched = static_cast<int>(seek_total_ - seek_left_);
  target_ = position_;
  lose();
  if (sought) {
    emit seek_stopped(searched);
  }
}

void Focus::set_following(bool following) {
  if (following == following_) {
    return;
  }
  following_ = following;
  emit target_changed();
  if (following) {
    phase_ = Phase::after;
    go_to_newest();
  } else {
    emit moved();  // views mark the step only while not following
  }
}

void Focus::end_following() {
  if (!following_) {
    return;
  }
  following_ = false;
  emit target_changed();
}

void Focus::follow(int iteration, int direction) {
  const RunPosition newest{iteration, direction, -1};
  const bool changed = newest != newest_ || !map_;
  newest_ = newest;
  if (following_ && changed) {
    go_to_newest();
  }
}

void Focus::go_to_newest() {
  if (passes_ == 0) {
    return;
  }
  seek_left_ = 0;
  target_reason_ = StepReason::none;
  set_target(newest_.iteration, newest_.direction, -1,
             [](const MapHistory& history) { return nearest_step(history, last_step); });
}

void Focus::set_target(int iteration, int direction, std::int32_t step, Arrival arrival) {
  const int n = std::clamp(iteration, 0, iterations_ - 1);
  target_ = {n, std::clamp(direction, 0, passes_of(n) - 1), step};
  arrival_ = std::move(arrival);
  under_way_ = true;
  emit target_changed();
  if (map_ && shows(*map_, target_)) {
    show_map(map_);
  } else {
    emit map_requested(target_.iteration, target_.direction);
  }
}

bool Focus::shows(const RecordedMap& map, const RunPosition& position) const {
  return map.direction == position.direction && (!renews_ || map.iteration == position.iteration);
}

void Focus::replace_map(std::shared_ptr<const RecordedMap> map) {
  if (!map_ || !shows(*map, position_)) {
    return;
  }
  map_ = std::move(map);
  position_.step = nearest_step(map_->history, at_step() ? position_.step : last_step);
  emit moved();
}

void Focus::show_map(std::shared_ptr<const RecordedMap> map) {
  const bool stale = !under_way_ || map->passes != passes_;
  const bool superseded = !shows(*map, target_);
  if (stale || (superseded && seek_left_ > 0)) {
    return;
  }
  const std::int32_t step = arrival_(map->history);
  if (seek_left_ > 0 && step == MapHistory::none) {
    continue_seek();
    return;
  }
  const bool another = map != map_;
  map_ = std::move(map);
  reason_ = target_reason_;
  if (another && probe_) {
    set_probe(std::nullopt);
  }
  if (superseded) {
    // Scrubbing is faster than recording: show maps of older targets while waiting for the newest.
    position_ = {renews_ ? map_->iteration : target_.iteration, map_->direction, step};
    emit moved();
  } else {
    arrive(step);
  }
}

void Focus::arrive(std::int32_t step) {
  target_.step = step;
  position_ = target_;
  const bool sought = seek_left_ > 0;
  end_seek();
  emit moved();
  if (sought) {
    emit seek_ended(true);
  }
}

}  // namespace transillum::viewer
