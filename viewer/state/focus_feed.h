// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "model/requests/recorded_map.h"
#include "model/snapshot.h"
#include "state/focus.h"
#include "support/newest_result.h"

namespace transillum::viewer {

/// Reports the progress of the solve run to the focus, and records the maps that it requests.
class FocusFeed : public QObject {
  Q_OBJECT

 public:
  explicit FocusFeed(Focus& focus, QObject* parent = nullptr);

  /// For a new scene: drops all requests for the old one.
  void clear();
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Whether a view shows the maps; if not, the newest directions are not recorded.
  void set_watched(bool watched);
  bool watched() const { return watched_; }

 signals:
  void failed(const QString& message);
  void watched_changed();

 private:
  void follow();
  void record(int iteration, int direction);

  Focus& focus_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  bool watched_ = false;  ///< until a view is shown
  NewestResult<MapRequest, RecordedMap> recorder_;
};

}  // namespace transillum::viewer
