// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <optional>

#include "support/newest_result.h"
#include "window/base/window_views.h"
#include "window/editing/live_scene.h"

class QTimer;

namespace transillum::viewer {

class SettingsPanel;

/// Shows the light of a draft while the user moves the sun in the settings; when the hand rests,
/// the scene is solved. A scene of very many patches is only solved.
///
/// Threads: the main thread only.
class SunDrag : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  /// @param solve  solves with the settings of the panel, or returns false
  SunDrag(const WindowFrame& frame, SettingsPanel& settings, std::function<bool()> solve);
  ~SunDrag() override;

  /// Whether something is computed that is not shown yet.
  bool busy() const;

 signals:
  void lit();  ///< the light of a place of the sun is shown

 private:
  void follow();
  void hold_solve();
  void take_light(const LiveLightRequest& request, const std::shared_ptr<const Solution>& light);
  void finish();
  void end();

  WindowFrame frame_;
  SettingsPanel& settings_;
  std::function<bool()> solve_;
  std::shared_ptr<const SolverSnapshot> solved_;  ///< from before the move; null while none is made
  bool was_running_ = false;
  std::optional<Sky> awaited_;  ///< the sky of the solve that follows, until it has light
  QTimer* rest_timer_;
  NewestResult<LiveLightRequest, Solution> lights_;
};

}  // namespace transillum::viewer
