// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "model/solver/error_runs.h"
#include "state/camera_views.h"
#include "support/request_worker.h"

class QPainter;
class QPushButton;

namespace transillum::viewer {

class MaterialEdits;

/// Pictures of the scene side by side, one for each set of directions, colored by the error of B
/// against a reference, all on one scale.
///
/// It solves on its own thread: the runs of a lesson's page as soon as they are shown, other runs
/// when the user asks.
class ErrorView : public QWidget {
  Q_OBJECT

 public:
  /// The measured errors of all runs.
  struct Result {
    std::vector<QImage> pictures;  ///< one per run
    std::vector<double> rms;       ///< RadiosityError::rms, one per run
    double most = 0;               ///< right end of the color scale, relative to that RMS
  };

  /// @param view  gives the camera that the pictures are taken from
  /// @param edits  changed materials have to be solved before errors are measured; outlives this
  ErrorView(std::function<ViewPoint()> view, const MaterialEdits& edits, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Measures these runs whenever the panel is visible and a scene is open. Without runs, it
  /// measures random, Hammersley and default directions when the user asks.
  void set_runs(const ErrorRuns& runs);
  bool busy() const { return busy_; }
  /// Null until the newest runs have been measured.
  const Result* result() const { return result_.get(); }

  QSize sizeHint() const override { return {460, 300}; }

 signals:
  void failed(const QString& message);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  struct Job {
    std::shared_ptr<const LoadedScene> loaded;
    ErrorRuns runs;
    ViewPoint view;
    int number = 0;
  };

  ErrorRuns usual_runs() const;
  void start(const ErrorRuns& runs);
  void start_if_wanted();
  void drop();
  void measure(const Job& job, const Cancellation& cancellation);
  void show_progress(int number, double fraction);
  void paint_run(QPainter& painter, const QRectF& box, std::size_t run) const;
  void paint_scale(QPainter& painter, const QRectF& box) const;
  void show_state();
  /// Why nothing can be measured now, for the user; empty if it can.
  QString why_not() const;
  void place_button();

  std::function<ViewPoint()> view_;
  const MaterialEdits& edits_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  ErrorRuns wanted_;   ///< runs of a lesson's page
  ErrorRuns running_;  ///< measured, or being measured
  std::shared_ptr<const LoadedScene> running_scene_;
  std::shared_ptr<const Result> result_;
  bool busy_ = false;
  double share_ = 0;  ///< finished fraction of the passes
  int number_ = 0;    ///< number of the newest job
  QPushButton* button_;
  RequestWorker<Job> worker_;
};

}  // namespace transillum::viewer
