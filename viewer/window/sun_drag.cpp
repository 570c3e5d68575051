// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/sun_drag.h"

#include <QMainWindow>
#include <QTimer>
#include <utility>

#include "model/solver/draft.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "solve/settings_panel.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr int sun_rest_ms = 300;  // from the last move until the scene is solved

}  // namespace

// A running job is finished: a late picture is better than none.
SunDrag::SunDrag(const WindowFrame& frame, SettingsPanel& settings, std::function<bool()> solve)
    : FilmedChange(&frame.window),
      frame_(frame),
      settings_(settings),
      solve_(std::move(solve)),
      rest_timer_(new QTimer(this)),
      lights_(
          *this, &live_light,
          [this](const LiveLightRequest& request, const std::shared_ptr<const Solution>& light,
                 const QString& error) {
            if (light) {
              take_light(request, light);
            } else if (!day_.empty()) {
              emit film_lost(error);
            }
          },
          CurrentJob::finish) {
  rest_timer_->setSingleShot(true);
  rest_timer_->setInterval(sun_rest_ms);
  connect(rest_timer_, &QTimer::timeout, this, &SunDrag::finish);
  connect(&settings_, &SettingsPanel::sun_moved, this, &SunDrag::follow);
  // The light that followed the sun stays until the solve has its own.
  connect(&frame_.state.runner, &SolveRunner::snapshot_ready, this,
          [this](const std::shared_ptr<const SolverSnapshot>& snapshot) {
            take_factors(snapshot);
            const bool has_light =
                snapshot->of_draft || snapshot->passes_done > 0 || snapshot->progress.finished;
            if (awaited_ && has_light && snapshot->options.sky == *awaited_) {
              end();
            }
          });
  connect(&frame_.state.runner, &SolveRunner::failed, this, [this] {
    if (awaited_) {
      end();
    }
  });
  for (const auto change : {&OpenScene::scene_loaded, &OpenScene::patches_changed}) {
    connect(&frame_.state.scene, change, this, [this] {
      if (!day_.empty()) {
        emit film_lost(tr("Scene or patches changed"));
      }
      const bool moves = solved_ && !awaited_;
      end();
      if (moves) {
        rest_timer_->start();  // the new patches are solved with the sun that is set
      }
    });
  }
}

SunDrag::~SunDrag() = default;

bool SunDrag::busy() const { return lights_.busy() || rest_timer_->isActive() || awaited_; }

/// Whether there is a scene that a sun can light.
bool SunDrag::can_light() const { return frame_.state.scene.snapshot() != nullptr; }

/// Whether light follows the sun. Requires can_light().
bool SunDrag::has_drafts() const {
  return frame_.state.scene.snapshot()->loaded->scene->patch_count() <= most_fitted_patches;
}

void SunDrag::follow() {
  if (!day_.empty()) {
    emit film_lost(tr("The sun was moved"));
  }
  if (!can_light()) {
    return;  // before the first picture, the solve that comes has this sun
  }
  if (has_drafts()) {
    hold_solve();
    request(settings_.solve_options());
  }
  rest_timer_->start();
}

void SunDrag::request(const SolveOptions& options) {
  const MaterialEdits& edits = frame_.state.relighting.edits();
  lights_.request({solved_->loaded, options, edits.any() ? edits.materials() : nullptr, factors_,
                   sun_of_factors_});
}

bool SunDrag::can_film() const {
  return can_light() && has_drafts() && !busy() && !settings_.sun_through_day(2).empty();
}

void SunDrag::begin_film(int count) {
  hold_solve();
  day_ = settings_.sun_through_day(count);
  awaits_noon_ = true;
  show_picture(count / 2);
}

void SunDrag::show_picture(int index) {
  picture_ = index;
  if (solved_ && !lights_.busy()) {
    SolveOptions options = solved_->options;
    options.sky.sun = at(day_, index).sun;
    request(options);
  }
}

QString SunDrag::caption(int index) const {
  return day_.empty() ? QString() : at(day_, index).time;
}

void SunDrag::end_film() {
  if (day_.empty()) {
    return;
  }
  day_.clear();
  awaits_noon_ = false;
  frame_.state.colors.hold_range(false);
  return_to_solve();
}

/// A film keeps to the kind of light with which it began.
void SunDrag::take_factors(const std::shared_ptr<const SolverSnapshot>& snapshot) {
  if (solved_ && !awaited_ && day_.empty() && snapshot->loaded == solved_->loaded &&
      snapshot->progress.finished && !snapshot->of_draft && snapshot->form_factors) {
    factors_ = snapshot;
    sun_of_factors_ = std::make_shared<std::optional<SunLight>>();
  }
}

void SunDrag::hold_solve() {
  const bool runs = frame_.state.runner.state() == RunState::running;
  if (!solved_) {
    solved_ = frame_.state.scene.snapshot();
    was_running_ = runs;
    take_factors(solved_);
    if (solved_->progress.finished && !solved_->of_file && !solved_->glossy) {
      frame_.state.runner.include_form_factors();
    }
    frame_.state.scene.hold(true);
    frame_.page.sharp()->set_solving(true);
  } else if (!std::exchange(awaited_, std::nullopt)) {
    return;
  }
  frame_.state.runner.pause();
}

void SunDrag::take_light(const LiveLightRequest& request,
                         const std::shared_ptr<const Solution>& light) {
  if (!solved_ || request.loaded != solved_->loaded) {
    return;
  }
  auto live = std::make_shared<SolverSnapshot>(*solved_);
  live->options.sky = request.options.sky;
  live->materials = request.materials;
  live->glossy = nullptr;
  live->form_factors = nullptr;
  live->fitted = nullptr;
  show_light_of(*light, *live);
  frame_.state.colors.fit_moved(live);
  frame_.page.scene_view()->show_snapshot(live);
  if (std::exchange(awaits_noon_, false)) {
    frame_.state.colors.hold_range(true);
    show_picture(picture_);
    return;
  }
  emit lit();
}

void SunDrag::finish() {
  if (lights_.busy()) {
    rest_timer_->start();  // the last place is to be seen
    return;
  }
  const bool held = solved_ != nullptr;
  if (held) {
    awaited_ = settings_.solve_options().sky;
  }
  if (!solve_() && held) {
    return_to_solve();
  }
}

void SunDrag::return_to_solve() {
  const bool runs_on = was_running_ && solved_ && solved_->loaded == frame_.state.scene.loaded();
  end();
  if (runs_on) {
    frame_.state.runner.run();
  }
}

void SunDrag::end() {
  awaited_.reset();
  if (!solved_) {
    return;
  }
  rest_timer_->stop();
  lights_.clear();
  solved_ = nullptr;
  factors_ = nullptr;
  sun_of_factors_ = nullptr;
  frame_.state.scene.hold(false);
  const RunState state = frame_.state.runner.state();
  frame_.page.sharp()->set_solving(state == RunState::running || state == RunState::loading);
}

}  // namespace transillum::viewer
