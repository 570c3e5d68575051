// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "support/request_worker.h"
#include "window/base/window_views.h"
#include "window/files/film_plan.h"

class QAction;
class QLabel;
class QMenu;
class QToolButton;
class QWidget;

namespace transillum::viewer {

class FilmFile;
class PlayControl;

/// Writes each new picture of the scene to a numbered file in a folder, or writes the film of a
/// FilmPlan on a worker thread. While a film is recorded, the window has a red mark.
class FrameRecorder : public QObject {
  Q_OBJECT

 public:
  /// @param play  its pictures wait until the recording has room for them; must outlive this object
  FrameRecorder(const WindowFrame& frame, PlayControl& play, MapView& map);
  ~FrameRecorder() override;

  /// Adds both kinds of recording.
  void add_to(QMenu& menu) const;
  QAction* film_action() const { return film_action_; }
  /// Sets what a film over this shows; `change` must outlive the films.
  void set_change(FilmPlan::Over over, FilmedChange& change);

  /// From now on, each new picture becomes the next frame_00001.png of `folder`.
  void begin_frames(const QString& folder);
  /// Begins a film.
  /// @param path  as for FilmFile
  void begin_film(const QString& path, const FilmPlan& plan);
  /// Ends the recording. The file of a film is complete when writing() has become false.
  void end();
  /// Discards a film at once.
  void cancel();
  /// Number of pictures of this recording; for frames, including earlier recordings in the folder.
  int frames() const { return frames_; }
  /// Whether a film is being recorded or written.
  bool writing() const { return film_ != nullptr; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// A film, shared with the worker.
  struct Film {
    QString path;
    FilmPlan plan;
    std::mutex mutex;  // guards the two below
    std::deque<QImage> waiting;
    bool ended = false;
    std::shared_ptr<const LoadedScene> loaded;  ///< the scene
    std::unique_ptr<FilmFile> file;             ///< the worker's only
    bool finished = false;                      ///< the worker's only
  };
  using FilmRequest = std::shared_ptr<Film>;

  void make_mark();
  void place_mark();
  void choose_folder();
  void choose_film();
  void record();
  void walk_on();
  void walk_soon();
  void on_written();
  void record_file();
  void record_picture();
  void lose(const QString& why);
  QImage picture() const;
  bool has_room() const;
  void write_waiting(const FilmRequest& film, const Cancellation& cancellation);
  void report(const FilmRequest& film, const QString& failure);
  void show_state();

  WindowFrame frame_;
  PlayControl& play_;
  MapView& map_;
  std::map<FilmPlan::Over, FilmedChange*> changes_;
  QAction *frames_action_, *film_action_;
  QWidget* mark_;
  QLabel* mark_text_;
  QToolButton* finish_;
  QString folder_;
  int frames_ = 0;
  FilmPlan plan_;  ///< the newest
  FilmRequest film_;
  std::optional<FilmWalk> walk_;
  bool walks_soon_ = false;  ///< walk_on() has been posted
  bool ended_ = false;       ///< the film takes no more pictures
  bool missed_ = false;      ///< a picture that there was no room for
  RequestWorker<FilmRequest> worker_;
};

}  // namespace transillum::viewer
