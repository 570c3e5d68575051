// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/open_scene.h"

#include <QElapsedTimer>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "model/snapshot_values.h"
#include "support/number_text.h"

namespace transillum::viewer {

OpenScene::OpenScene(SolveRunner& runner, Relighting& relighting)
    : runner_(runner), relighting_(relighting) {
  connect(&runner_, &SolveRunner::scene_loaded, this, &OpenScene::take_scene);
  connect(&runner_, &SolveRunner::patches_changed, this, &OpenScene::take_patches);
  connect(&runner_, &SolveRunner::snapshot_ready, this, &OpenScene::take_snapshot);
  connect(&runner_, &SolveRunner::failed, this, [this] {
    opening_ = false;
    given_ = {};
  });
  connect(&relighting_, &Relighting::changed, this, &OpenScene::show_again);
}

void OpenScene::open(const std::string& spec, const RunOptions& options, Goal goal,
                     bool first_look) {
  opening_ = true;
  emit opening();
  requested_spec_ = spec;
  requested_input_ = options.input;
  requested_edited_ = spec == given_.first ? given_.second : spec == spec_ ? edited_ : nullptr;
  runner_.open({requested_spec_, options, goal, first_look, nullptr, requested_edited_});
}

void OpenScene::solve_faces(const std::shared_ptr<const LoadedScene>& loaded, const Faces& faces,
                            const SolverSnapshot& before, bool runs) {
  const RunOptions options = run_options_of(before, options_, faces.input);
  Goal goal{Goal::Kind::finished};
  if (!options.solve.why_dark(loaded->scene->has_light()).empty()) {
    goal = {};
  } else if (!runs && !before.progress.finished) {
    goal = {Goal::Kind::passes, before.passes_done};
  }
  spec_ = faces.spec;
  input_ = faces.input;
  edited_ = faces.edited;
  saved_changes_.reset();
  awaits_faces_ = true;
  SolveWorker::Choice choice = SolveWorker::choice_of(options);
  choice.from = loaded;
  runner_.restart(std::move(choice), goal);
}

void OpenScene::hold(bool held) {
  holds_ += held ? 1 : -1;
  if (holds_ == 0) {
    show_again();
  }
}

bool OpenScene::has_unsaved_faces() const {
  return edited_ && saved_changes_ != relighting_.edits().changes();
}

void OpenScene::set_saved(const std::string& file, const std::vector<MaterialChange>& changes) {
  if (edited_) {
    spec_ = file;
    saved_changes_ = changes;
  }
}

void OpenScene::show_earlier(const std::shared_ptr<const LoadedScene>& loaded,
                             const SolveOptions& options, const SceneInput& input) {
  opening_ = true;
  emit opening();
  requested_spec_ = spec_;
  requested_input_ = input;
  requested_edited_ = edited_;
  runner_.open({.spec = spec_, .options = {.solve = options}, .then = {}, .earlier = loaded});
}

bool OpenScene::is_open(const std::string& spec, const RunOptions& options) const {
  const bool is_given = given_.second && given_.first == spec;
  return loaded_ && spec == spec_ && !is_given &&
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
  given_ = {};
  loaded_ = std::move(loaded);
  newest_ = shown_ = nullptr;
  spec_ = requested_spec_;
  if (edited_ != requested_edited_) {
    saved_changes_.reset();
  }
  edited_ = requested_edited_;
  awaits_faces_ = false;
  options_ = loaded_->scene->options();
  input_ = requested_input_;
  input_.patches = 0;
  relighting_.show_scene(loaded_->scene);
  emit scene_loaded(loaded_);
  emit scene_shown();
}

void OpenScene::take_patches(std::shared_ptr<const LoadedScene> loaded) {
  if (!is_same_origin(loaded, loaded_)) {
    return;  // the snapshot is of the previous scene
  }
  const bool edited = whole_of(loaded) != whole_of(loaded_);
  loaded_ = std::move(loaded);
  newest_ = shown_ = nullptr;
  const std::vector<MaterialChange> edits = relighting_.edits().changes();
  awaits_faces_ = awaits_faces_ && !edited;
  relighting_.show_scene(loaded_->scene, edited);
  if (!edited) {
    relighting_.edits().start_over(edits);  // all fit: faces, groups and materials are the same
  }
  emit patches_changed(loaded_);
}

void OpenScene::take_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  if (snapshot->loaded != loaded_) {
    return;
  }
  QElapsedTimer timer;
  timer.start();
  newest_ = std::move(snapshot);
  if (holds_ > 0) {
    return;
  }
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

bool WorkGuard::may_lose(QWidget* parent, const QString& what, Lost lost) const {
  const auto snapshot = scene_.snapshot();
  const double seconds = snapshot && !scene_.at_start() ? snapshot->statistics.seconds_total : 0;
  QStringList losses;
  if (lost == Lost::scene && scene_.has_unsaved_faces()) {
    losses << QObject::tr(
        "Faces of the scene were edited, and no file has them yet (File → Save "
        "scene).");
  }
  if (seconds > long_seconds_) {
    losses << QObject::tr(
                  "The solve took %1 so far. It is kept only in results that you export "
                  "(File → Export).")
                  .arg(duration_text(seconds));
  }
  if (losses.isEmpty()) {
    return true;
  }
  QMessageBox box(QMessageBox::Question, what, losses.join(QLatin1Char('\n')), QMessageBox::Cancel,
                  parent);
  box.setObjectName("long_work");
  const QPushButton* lose = box.addButton(what, QMessageBox::DestructiveRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == lose;
}

}  // namespace transillum::viewer
