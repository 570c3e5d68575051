// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/solve_undo.h"

#include <QMainWindow>
#include <QUndoCommand>
#include <utility>

#include "model/snapshot_values.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "window/base/open_scene.h"

namespace transillum::viewer {

class SolveUndo::Command : public QUndoCommand {
 public:
  Command(SolveUndo& owner, std::shared_ptr<Kept> kept)
      : QUndoCommand(SolveUndo::tr("solving again")), owner_(owner), kept_(std::move(kept)) {}

  // Opening the earlier solve clears the list, so that there is no redo.
  void undo() override {
    if (kept_->solve) {
      owner_.show(*kept_->solve);
    }
  }

 private:
  SolveUndo& owner_;
  std::shared_ptr<Kept> kept_;
};

SolveUndo::SolveUndo(const WindowFrame& frame) : QObject(&frame.window), frame_(frame) {
  // New patches clear the list of what can be undone, before this is called.
  connect(&frame_.state.scene, &OpenScene::patches_changed, this, &SolveUndo::push);
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, [this] {
    const auto now = std::exchange(returns_, nullptr);
    if (now) {
      emit returned(now->options);
      frame_.page.scene_view()->set_view_point(view_);
    }
    if (now || spec_ != frame_.state.scene.spec()) {
      earlier_ = nullptr;
    }
    push();
  });
}

std::shared_ptr<const SolveUndo::Earlier> SolveUndo::shown() const {
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot || !snapshot->loaded->description || !snapshot->progress.finished ||
      snapshot->materials) {
    return nullptr;
  }
  auto loaded = std::make_shared<LoadedScene>(*snapshot->loaded);
  loaded->stored = std::make_shared<const Solution>(solution_of(*snapshot, true));
  loaded->file = loaded->scene->name();
  loaded->divided_faces = 0;
  return std::make_shared<const Earlier>(
      Earlier{std::move(loaded), snapshot->options, frame_.state.scene.input()});
}

void SolveUndo::remember() {
  if (const auto before = kept_.lock()) {
    before->solve = nullptr;  // its command does nothing any more
  }
  kept_.reset();
  earlier_ = shown();
  spec_ = frame_.state.scene.spec();
  push();
}

void SolveUndo::push() {
  if (earlier_ && kept_.expired()) {
    const auto kept = std::make_shared<Kept>(Kept{earlier_});
    kept_ = kept;
    frame_.state.undo.push(new Command(*this, kept));
  }
}

void SolveUndo::show(const Earlier& earlier) {
  returns_ = std::make_shared<const Earlier>(earlier);
  view_ = frame_.page.scene_view()->view_point();
  frame_.state.scene.show_earlier(earlier.loaded, earlier.options, earlier.input);
}

}  // namespace transillum::viewer
