// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "model/snapshot.h"
#include "state/camera_views.h"
#include "window/base/window_views.h"

namespace transillum::viewer {

/// Undo and redo of "Solve again": the light of the other solve comes back, with its patches and
/// settings. Form factors and the light of single iterations are not kept. One solve is kept beside
/// the one shown.
class SolveUndo : public QObject {
  Q_OBJECT

 public:
  /// @param frame  must outlive this object
  explicit SolveUndo(const WindowFrame& frame);

  /// To be called before another solve of the open scene replaces the one that is shown.
  void remember();

 signals:
  /// A kept solve is shown again.
  void returned(const transillum::SolveOptions& options);

 private:
  class Command;
  /// The light of a solve, as for a result file.
  struct Light {
    std::shared_ptr<const LoadedScene> loaded;  ///< with the light
    SolveOptions options;
    SceneInput input;
  };
  struct Kept {
    std::shared_ptr<const Light> solve;
    bool is_earlier = true;  ///< for Undo; else for Redo
  };
  std::shared_ptr<const Light> shown() const;
  void on_scene();
  void push();
  void push_redo();
  void show(const Kept& kept);

  WindowFrame frame_;
  std::shared_ptr<const Light> earlier_;  ///< the solve of Undo; null if nothing can be undone
  std::weak_ptr<Kept> kept_;              ///< the solve of the command in the list
  std::string spec_;                      ///< its scene
  Kept returns_;                          ///< about to be shown; null if none is
  std::shared_ptr<const Light> left_;     ///< shown until then; null if it had not finished
  ViewPoint view_;                        ///< the camera that it is to have
};

}  // namespace transillum::viewer
