// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QObject>
#include <QTimer>
#include <atomic>
#include <optional>

#include "scene/sharp/sharp_picture.h"
#include "scene/sharp/surface_map.h"
#include "support/request_worker.h"
#include "widgets/plate.h"

class QAction;
class QWidget;

namespace transillum::viewer {

class SceneView;

/// Shows the sharp picture in the scene view while that rests, and hides it at once when anything
/// in it changes. Below it, and while the camera moves, the surfaces have a light map.
class SharpView : public QObject {
  Q_OBJECT

 public:
  explicit SharpView(SceneView& view, QObject* parent = nullptr);

  /// Enabled and checked: sharp pictures are made.
  QAction* action() const { return action_; }
  /// While a solve runs or a scene is loaded, none is made.
  void set_solving(bool solving);
  /// Whether the picture of the scene is final: the sharp picture is finished, or none is made.
  bool settled() const;
  /// Whether the light map is finished, or none is made.
  bool has_map() const { return !map_requested_ || map_finished_; }
  /// Makes the sharp picture of another size, pixels, behind a dialog.
  /// @returns null where none is shown; nothing where the user canceled, or where it failed or the
  /// subject has changed, which failed() tells
  std::optional<QImage> make(const QSize& size, QWidget* window);

 signals:
  void failed(const QString& message);
  /// Whether the scene is one that sharp pictures are made of, once it is solved.
  void wanted_changed(bool wanted);
  /// The picture number of the newest request has changed, or is finished.
  void progressed(double fraction, bool finished);

 private:
  struct Task {
    std::optional<SharpSubject> subject;  ///< none releases the light
    quint64 number = 0;
    bool begins_fine = false;  ///< the surfaces have a light map
  };
  bool wanted() const { return subject_ && !solving_; }
  void follow();
  void start();
  void request(const SharpSubject& subject);
  void stop();
  void run(const Task& task, const Cancellation& cancellation);
  void receive(const QImage& picture, const SharpProgress& progress);
  void show_progress(const SharpProgress& progress);
  void request_map();
  void release_map();
  void tell(const QString& reason);
  void receive_map(const SurfaceMap& map);

  SceneView& view_;
  QAction* action_;
  QString usual_tip_;
  QTimer* rest_timer_;  ///< from the last change until the picture is begun
  Plate* label_;
  bool solving_ = false;
  bool on_ = false;                      ///< the action is enabled and checked
  std::optional<SharpSubject> subject_;  ///< the subject to be shown; none without a sharp picture
  bool finished_ = false;                ///< its picture is shown at its final quality
  bool begun_ = false;
  bool is_inside_ = false;            ///< the eye is inside a solid
  QImage enlarged_;                   ///< the finished picture of make()
  quint64 number_ = 0;                ///< number of the newest request
  bool enlarges_ = false;             ///< the newest request is of make()
  std::atomic<bool> posted_ = false;  ///< a picture has not been received yet
  SharpRenderer renderer_;
  std::shared_ptr<const SolverSnapshot> map_requested_;  ///< its map is made; null if none is
  SurfaceMap map_;                                       ///< the map of map_requested_
  bool map_finished_ = false;
  RequestWorker<Task> worker_;
  RequestWorker<std::shared_ptr<const SolverSnapshot>> map_worker_;
};

}  // namespace transillum::viewer
