// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPointer>
#include <QSize>

#include "state/camera_views.h"
#include "state/focus.h"
#include "window/base/filmed_change.h"

namespace transillum::viewer {

class SceneView;

/// The content of a film.
struct FilmPlan {
  enum class Show { scene, map, both };
  /// The change from picture to picture.
  enum class Over {
    changes,     ///< each new picture of the window, until the recording is ended
    polygons,    ///< the steps of the direction shown
    directions,  ///< the directions of the iteration shown, each after its last step
    iterations,  ///< the iterations, in the direction shown
    turn,        ///< the camera turns once about the vertical of the scene
    day,         ///< the FilmedChange of the sun
    move,        ///< the FilmedChange of the faces moved last
  };
  Show show = Show::scene;
  Over over = Over::changes;
  QSize size;              ///< pixels
  double per_second = 10;  ///< pictures
};

/// Goes through the pictures of a film, and then back to the state before.
class FilmWalk {
 public:
  /// @param plan  not over changes
  /// @param focus must outlive this object
  /// @param change what is filmed, if it can be; null for the focus or the camera
  FilmWalk(const FilmPlan& plan, Focus& focus, SceneView& view, FilmedChange* change);
  ~FilmWalk();
  FilmWalk(const FilmWalk&) = delete;
  FilmWalk& operator=(const FilmWalk&) = delete;

  /// Number of pictures.
  int count() const { return count_; }
  /// Number of pictures for which next() was called.
  int done() const { return done_; }
  /// The text in the next picture; empty for none.
  QString caption() const { return change_ ? change_->caption(done_) : QString(); }
  /// Whether the views show the next picture. Where somebody else has moved the focus, goes there.
  bool arrived();
  /// Goes to the next picture. @returns false after the last
  bool next();

 private:
  void go();

  const FilmPlan plan_;
  Focus& focus_;
  const QPointer<SceneView> view_;  ///< null once the window is closing
  const QPointer<FilmedChange> change_;
  const RunPosition begin_;
  const ViewPoint view_point_;
  const bool followed_;
  int count_ = 0, done_ = 0;
};

}  // namespace transillum::viewer
