// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <mutex>

#include "model/snapshot.h"

namespace transillum::viewer {

/// Posts the messages of a solve to the window.
///
/// Threads: signals and state() belong to the thread that created the object. The other functions
/// may be called by any thread; the signals follow in the order of the calls. A snapshot that has
/// not been delivered yet is replaced by its successor.
class SolveMessages : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  RunState state() const { return state_; }

  void post_state(RunState state);
  /// Posts the open scene, or its new patches. Snapshots of what it replaces are dropped.
  void post_scene(std::shared_ptr<const LoadedScene> loaded);
  void post_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void post_load_progress(const QString& phase, double fraction);
  /// Posts the exception that is being handled, unless it is Canceled; to be called in a catch
  /// block.
  /// @param no_memory message for std::bad_alloc; failure_text() if it is empty
  void post_current_failure(const QString& no_memory = {});

 signals:
  void state_changed(transillum::viewer::RunState state);
  void scene_loaded(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  /// The open scene has other patches, of a round of refinement or of a new run.
  void patches_changed(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  void snapshot_ready(std::shared_ptr<const transillum::viewer::SolverSnapshot> snapshot);
  /// @param share  finished fraction, 0 to 1; negative if unknown
  void load_progressed(const QString& phase, double fraction);
  /// @param bad_input  the user can correct it (exit status 2)
  void failed(const QString& message, bool bad_input);

 private:
  void deliver_snapshot();
  void post(std::function<void()> message);

  RunState state_ = RunState::empty;              // the last state reported to the window
  std::shared_ptr<const LoadedScene> announced_;  // scene of the last signal

  std::mutex mutex_;  // guards pending_snapshot_
  std::shared_ptr<const SolverSnapshot> pending_snapshot_;
};

}  // namespace transillum::viewer
