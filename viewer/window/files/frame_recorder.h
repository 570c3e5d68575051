// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <deque>
#include <memory>
#include <mutex>

#include "support/request_worker.h"
#include "window/base/window_views.h"

class QAction;
class QLabel;
class QMenu;
class QToolButton;
class QWidget;

namespace transillum::viewer {

class GifFile;
class PlayControl;

/// Records each new picture of the scene, while solving and at each step: as numbered files of a
/// folder, or as an animated GIF, which a worker thread writes.
class FrameRecorder : public QObject {
  Q_OBJECT

 public:
  /// @param play  its pictures wait until the recording has room for them; must outlive this object
  FrameRecorder(const WindowFrame& frame, PlayControl& play);
  ~FrameRecorder() override;

  /// Adds both kinds of recording.
  void add_to(QMenu& menu) const;
  QAction* animation_action() const { return animation_action_; }

  /// From now on, each new picture becomes the next frame_00001.png of `folder`.
  void begin_frames(const QString& folder);
  /// From now on, each new picture is added to an animated GIF at the speed of PlayControl.
  void begin_animation(const QString& path);
  /// Ends the recording. The file of an animation is complete when writing() has become false.
  void end();
  /// Discards an animation at once.
  void cancel();
  /// Number of pictures of this recording; for frames, including earlier recordings in the folder.
  int frames() const { return frames_; }
  /// Whether an animation is being recorded or written.
  bool writing() const { return animation_ != nullptr; }

 private:
  /// An animation, shared with the worker.
  struct Animation {
    QString path;
    int delay_ms = 0;
    std::mutex mutex;  // guards the two below
    std::deque<QImage> waiting;
    bool ended = false;
    std::unique_ptr<GifFile> file;  ///< the worker's only
  };
  using AnimationRequest = std::shared_ptr<Animation>;

  void add_status(const WindowFrame& frame);
  void choose_folder();
  void choose_animation();
  void record();
  void on_written();
  void record_file();
  void record_animated();
  bool has_room() const;
  void write_waiting(const AnimationRequest& animation, const Cancellation& cancellation);
  void report(const AnimationRequest& animation, const QString& failure);
  void show_state();

  WindowFrame frame_;
  PlayControl& play_;
  QAction *frames_action_, *animation_action_;
  QWidget* status_;
  QLabel* status_text_;
  QToolButton* finish_;
  QString folder_;
  int frames_ = 0;
  AnimationRequest animation_;
  bool ended_ = false;   ///< the animation takes no more pictures
  bool missed_ = false;  ///< a picture that there was no room for
  RequestWorker<AnimationRequest> worker_;
};

}  // namespace transillum::viewer
