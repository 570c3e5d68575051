// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/open_scene.h"

#include <QElapsedTimer>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "support/number_text.h"

namespace transillum::viewer {

OpenScene::OpenScene(SolveRunner& runner, Relighting& relighting)
    : runner_(runner), relighting_(relighting) {
  connect(&runner_, &SolveRunner::scene_loaded, this, &OpenScene::take_scene);
  connect(&runner_, &SolveRunner::patches_changed, this, &OpenScene::take_patches);
  connect(&runner_, &SolveRunner::snapshot_ready, this, &OpenScene::take_snapshot);
  connect(&runner_, &SolveRunner::failed, this, [this] { opening_ = false; });
  connect(&relighting_, &Relighting::changed, this, &OpenScene::show_again);
}

void OpenScene::open(const std::string& spec, const RunOptions& options, Goal goal,
                     bool first_look) {
  opening_ = true;
  emit opening();
  requested_spec_ = spec;
  requested_input_ = options.input;
  runner_.open({requested_spec_, options, goal, first_look});
}

void OpenScene::show_earlier(const std::shared_ptr<const LoadedScene>& loaded,
                             const SolveOptions& options, const SceneInput& input) {
  opening_ = true;
  emit opening();
  requested_spec_ = spec_;
  requested_input_ = input;
  runner_.open({.spec = spec_, .options = {.solve = options}, .then = {}, .earlier = loaded});
}

bool OpenScene::is_open(const std::string& spec, const RunOptions& options) const {
  return loaded_ && spec == spec_ &&
         ((loaded_->stored && !loaded_->description) ||
          RunOptions{{}, options.scene, options.input} == RunOptions{{}, options_, input_});
}

bool OpenScene::at_start() const {
  return !shown_ || (shown_->progress.iteration == 0 && shown_->progress.direction == 0 &&
                     shown_->statistics.refinement.empty() &&
                     !(shown_->total && !shown_->total->stages.empty()));
}

bool OpenScene::outlined_by_default() const {
  // Without outlines, large patches of similar brightness cannot be told apart, nor can patches
  // that rounds have divided.
  constexpr PatchId few_patches = 64;
  return loaded_ && (loaded_->scene->patch_count() <= few_patches || loaded_->whole);
}

void OpenScene::show_again() {
  if (newest_) {
    take_snapshot(newest_);
  }
}

void OpenScene::take_scene(std::shared_ptr<const LoadedScene> loaded) {
  opening_ = false;
  loaded_ = std::move(loaded);
  newest_ = shown_ = nullptr;
  spec_ = requested_spec_;
  options_ = loaded_->scene->options();
  input_ = requested_input_;
  input_.patches = 0;
  relighting_.show_scene(loaded_->scene);
  emit scene_loaded(loaded_);
  emit scene_shown();
}

void OpenScene::take_patches(std::shared_ptr<const LoadedScene> loaded) {
  if (whole_of(loaded) != whole_of(loaded_)) {
    return;  // the snapshot is of the previous scene
  }
  loaded_ = std::move(loaded);
  newest_ = shown_ = nullptr;
  const std::vector<MaterialChange> edits = relighting_.edits().changes();
  relighting_.show_scene(loaded_->scene);
  relighting_.edits().start_over(edits);  // all fit: faces, groups and materials are the same
  emit patches_changed(loaded_);
}

void OpenScene::take_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  if (snapshot->loaded != loaded_) {
    return;
  }
  QElapsedTimer timer;
  timer.start();
  newest_ = std::move(snapshot);
  shown_ = relighting_.lit(newest_);
  emit snapshot_ready(shown_);
  // A large scene is refreshed less often, so that the window stays responsive. While a draft
  // stands, only the progress changes, and the solver gets the time of the pictures.
  constexpr int longest_ms = 1500;
  const int shortest_ms = newest_->of_draft ? 500 : 66;
  runner_.set_refresh_interval(
      std::clamp(static_cast<int>(4 * timer.elapsed()), shortest_ms, longest_ms));
  emit snapshot_shown();
}

bool WorkGuard::may_lose(QWidget* parent, const QString& what) const {
  const auto snapshot = scene_.snapshot();
  const double seconds = snapshot && !scene_.at_start() ? snapshot->statistics.seconds_total : 0;
  if (!(seconds > long_seconds_)) {
    return true;
  }
  QMessageBox box(QMessageBox::Question, what,
                  QObject::tr("The solve took %1 so far. It is kept only in results that you "
                              "export (File → Export).")
                      .arg(duration_text(seconds)),
                  QMessageBox::Cancel, parent);
  box.setObjectName("long_work");
  const QPushButton* lose = box.addButton(what, QMessageBox::DestructiveRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == lose;
}

}  // namespace transillum::viewer
