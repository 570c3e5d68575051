// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/focus_feed.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "support/has_index.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

// While the solve is followed: at most two maps per second, and at most a quarter of one core.
constexpr Pause pause_between_maps{std::chrono::milliseconds(500), 3};

}  // namespace

FocusFeed::FocusFeed(Focus& focus, QObject* parent)
    : QObject(parent),
      focus_(focus),
      recorder_(
          *this, &record_map,
          [this](const MapRequest&, std::shared_ptr<const RecordedMap> map, const QString& error) {
            if (map) {
              focus_.show_map(std::move(map));
            } else {
              focus_.stop();
              emit failed(error);
            }
          },
          CurrentJob::finish, pause_between_maps) {
  connect(&focus_, &Focus::map_requested, this, &FocusFeed::record);
}

void FocusFeed::clear() {
  snapshot_ = nullptr;
  recorder_.clear();
  focus_.begin_run(0);
  focus_.set_filter({});  // its areas and its patch are of the old scene
}

void FocusFeed::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  const bool new_run =
      !snapshot_ || snapshot->kept_directions.front() != snapshot_->kept_directions.front();
  snapshot_ = std::move(snapshot);
  const SolveProgress& progress = snapshot_->progress;
  const int begun = progress.iteration + (progress.direction > 0 ? 1 : 0);
  if (new_run) {
    recorder_.clear();
    focus_.begin_run(static_cast<int>(snapshot_->directions->size()),
                     snapshot_->options.scheme == Scheme::semi_iterative);
  }
  focus_.set_passes_of_iterations(snapshot_->kept_passes);
  focus_.set_iterations(begun);
  follow();
}

void FocusFeed::set_watched(bool watched) {
  const bool changed = watched != watched_;
  watched_ = watched;
  follow();
  if (changed) {
    emit watched_changed();
  }
}

void FocusFeed::follow() {
  // While a draft stands, the picture has nothing of the newest direction, and maps would take
  // time from the solver.
  if (!snapshot_ || !watched_ || snapshot_->of_draft) {
    return;
  }
  const SolveProgress& progress = snapshot_->progress;
  // After the end of an iteration, the newest direction is the last one of that iteration; in the
  // growing scheme, this is not the last of all directions.
  if (progress.direction > 0) {
    focus_.follow(progress.iteration, progress.direction - 1);
  } else if (progress.iteration > 0) {
    const auto& kept = at(snapshot_->kept_directions, progress.iteration - 1);
    const auto& all = kept ? *kept : *snapshot_->directions;
    const auto last = std::find(all.rbegin(), all.rend(), progress.last_direction);
    focus_.follow(progress.iteration - 1, static_cast<int>(all.rend() - last) - 1);
  }
}

void FocusFeed::record(int iteration, int direction) {
  if (!snapshot_) {
    return;
  }
  const auto& kept = snapshot_->kept_directions;
  const auto& directions = has_index(kept, iteration) ? at(kept, iteration) : snapshot_->directions;
  if (!directions) {
    focus_.stop();
    emit failed(tr("The directions of iteration %1 were not stored: they exceed the memory limit")
                    .arg(iteration + 1));
    return;
  }
  recorder_.request({snapshot_->loaded, at(*directions, direction), iteration, direction,
                     focus_.passes(), snapshot_->options.memory},
                    focus_.following() ? Start::after_pause : Start::at_once);
}

}  // namespace transillum::viewer
