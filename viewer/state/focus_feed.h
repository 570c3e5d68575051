// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "model/map_recorder.h"
#include "model/snapshot.h"
#include "state/focus.h"

namespace transillum::viewer {

/// Tells the focus how far the run is, and records the directions that it wants.
class FocusFeed : public QObject {
  Q_OBJECT

 public:
  explicit FocusFeed(Focus& focus, QObject* parent = nullptr);

  /// A new scene: nothing of the old one is delivered any more.
  void clear();
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Whether somebody looks: else no time is spent on the newest directions.
  void set_watched(bool watched);

 signals:
  void failed(const QString& message);

 private:
  void follow();
  void record(int iteration, int direction);

  Focus& focus_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  bool watched_ = true;
  MapRecorder recorder_;
};

}  // namespace transillum::viewer
