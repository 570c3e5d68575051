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
#include "transillum/glossy.h"

namespace transillum::viewer {

namespace {

constexpr int sun_rest_ms = 300;  // from the last move until the scene is solved

}  // namespace

// A running job is finished: a late picture is better than none.
SunDrag::SunDrag(const WindowFrame& frame, SettingsPanel& settings, std::function<bool()> solve)
    : QObject(&frame.window),
      frame_(frame),
      settings_(settings),
      solve_(std::move(solve)),
      rest_timer_(new QTimer(this)),
      lights_(
          *this, &live_light,
          [this](const LiveLightRequest& request, const std::shared_ptr<const Solution>& light,
                 const QString&) { take_light(request, light); },
          CurrentJob::finish) {
  rest_timer_->setSingleShot(true);
  rest_timer_->setInterval(sun_rest_ms);
  connect(rest_timer_, &QTimer::timeout, this, &SunDrag::finish);
  connect(&settings_, &SettingsPanel::sun_moved, this, &SunDrag::follow);
  // The light of the draft stays until the solve has its own.
  connect(&frame_.state.runner, &SolveRunner::snapshot_ready, this,
          [this](const std::shared_ptr<const SolverSnapshot>& snapshot) {
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

void SunDrag::follow() {
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot) {
    return;  // the first solve has this sun
  }
  const SolveOptions options = settings_.solve_options();
  const Scene& scene = *snapshot->loaded->scene;
  if (options.glossy && has_lobes(scene)) {
    return;  // the settings say that lobes and a sun exclude each other
  }
  if (scene.patch_count() <= most_fitted_patches) {
    hold_solve();
    const MaterialEdits& edits = frame_.state.relighting.edits();
    lights_.request({solved_->loaded, options, edits.any() ? edits.materials() : nullptr});
  }
  rest_timer_->start();
}

void SunDrag::hold_solve() {
  const bool runs = frame_.state.runner.state() == RunState::running;
  if (!solved_) {
    solved_ = frame_.state.scene.snapshot();
    was_running_ = runs;
    frame_.state.scene.hold(true);
    frame_.page.sharp()->set_solving(true);
  } else if (!std::exchange(awaited_, std::nullopt)) {
    return;
  }
  frame_.state.runner.pause();
}

void SunDrag::take_light(const LiveLightRequest& request,
                         const std::shared_ptr<const Solution>& light) {
  if (!light || !solved_ || request.loaded != solved_->loaded) {
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
    const bool runs_on = was_running_;
    end();
    if (runs_on) {
      frame_.state.runner.run();
    }
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
  frame_.state.scene.hold(false);
  const RunState state = frame_.state.runner.state();
  frame_.page.sharp()->set_solving(state == RunState::running || state == RunState::loading);
}

}  // namespace transillum::viewer
