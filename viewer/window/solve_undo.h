// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "model/snapshot.h"
#include "state/camera_views.h"
#include "window/base/window_views.h"

namespace transillum::viewer {

/// Undo of "Solve again": the light of the earlier solve comes back, with its patches and settings.
/// Form factors and the light of single iterations are not kept. One earlier solve is kept.
class SolveUndo : public QObject {
  Q_OBJECT

 public:
  /// @param frame  must outlive this object
  explicit SolveUndo(const WindowFrame& frame);

  /// To be called before another solve of the open scene replaces the one that is shown.
  void remember();

 signals:
  /// An earlier solve is shown again.
  void returned(const transillum::SolveOptions& options);

 private:
  class Command;
  struct Earlier;
  struct Kept {
    std::shared_ptr<const Earlier> solve;
  };
  /// The light of a solve, as for a result file.
  struct Earlier {
    std::shared_ptr<const LoadedScene> loaded;  ///< with the light
    SolveOptions options;
    SceneInput input;
  };
  std::shared_ptr<const Earlier> shown() const;
  void push();
  void show(const Earlier& earlier);

  WindowFrame frame_;
  std::shared_ptr<const Earlier> earlier_;  ///< the solve of Undo; null if nothing can be undone
  std::weak_ptr<Kept> kept_;                ///< the solve of the command in the list
  std::string spec_;                        ///< its scene
  std::shared_ptr<const Earlier> returns_;  ///< about to be shown; null if none is
  ViewPoint view_;                          ///< the camera that it is to have
};

}  // namespace transillum::viewer
