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

  // Opening the other solve clears the list; it then begins with a command for the way back.
  void undo() override { show(true); }
  void redo() override { show(false); }

 private:
  void show(bool undoes) {
    if (kept_->solve && kept_->is_earlier == undoes) {
      owner_.show(*kept_);
    }
  }

  SolveUndo& owner_;
  std::shared_ptr<Kept> kept_;
};

SolveUndo::SolveUndo(const WindowFrame& frame) : QObject(&frame.window), frame_(frame) {
  // New patches clear the list of what can be undone, before this is called.
  connect(&frame_.state.scene, &OpenScene::patches_changed, this, &SolveUndo::push);
  connect(&frame_.state.scene, &OpenScene::opening, this, [this] { returns_ = {}; });
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, &SolveUndo::on_scene);
}

void SolveUndo::on_scene() {
  const Kept now = std::exchange(returns_, {});
  if (now.solve) {
    emit returned(now.solve->options);
    frame_.page.scene_view()->set_view_point(view_);
    earlier_ = now.is_earlier ? nullptr : left_;
    if (now.is_earlier && left_) {
      push_redo();
    }
  } else if (spec_ != frame_.state.scene.spec()) {
    earlier_ = nullptr;
  }
  left_ = nullptr;
  push();
}

std::shared_ptr<const SolveUndo::Light> SolveUndo::shown() const {
  const auto snapshot = frame_.state.scene.snapshot();
  const bool complete = snapshot && (snapshot->progress.finished || snapshot->of_file);
  if (!complete || !snapshot->loaded->description || snapshot->materials) {
    return nullptr;
  }
  auto loaded = std::make_shared<LoadedScene>(*snapshot->loaded);
  loaded->stored = std::make_shared<const Solution>(solution_of(*snapshot, true));
  loaded->file = loaded->scene->name();
  loaded->origin = std::make_shared<const int>(0);  // counts as another scene
  loaded->divided_faces = 0;
  return std::make_shared<const Light>(
      Light{std::move(loaded), snapshot->options, frame_.state.scene.input()});
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
    const auto kept = std::make_shared<Kept>(Kept{earlier_, true});
    kept_ = kept;
    frame_.state.undo.push(new Command(*this, kept));
  }
}

// A list of commands is only filled by doing them: this one does nothing until it has been undone.
void SolveUndo::push_redo() {
  const auto kept = std::make_shared<Kept>();
  frame_.state.undo.push(new Command(*this, kept));
  frame_.state.undo.undo();
  *kept = {left_, false};
}

void SolveUndo::show(const Kept& kept) {
  left_ = shown();
  view_ = frame_.page.scene_view()->view_point();
  frame_.state.scene.show_earlier(kept.solve->loaded, kept.solve->options, kept.solve->input);
  returns_ = kept;
}

}  // namespace transillum::viewer
