// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solve/sun_controls.h"
#include "support/newest_result.h"
#include "window/base/filmed_change.h"
#include "window/base/window_views.h"
#include "window/editing/live_scene.h"

class QTimer;

namespace transillum::viewer {

class SettingsPanel;

/// Shows the light while the user moves the sun in the settings, by the form factors of a finished
/// solve or else by a draft; when the hand rests, the scene is solved. A scene of very many patches
/// is only solved. A film shows the day that is set, with the exposure of noon unless it is fixed.
///
/// Threads: the main thread only.
class SunDrag : public FilmedChange {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  /// @param solve  solves with the settings of the panel, or returns false
  SunDrag(const WindowFrame& frame, SettingsPanel& settings, std::function<bool()> solve);
  ~SunDrag() override;

  bool can_film() const override;
  void begin_film(int count) override;
  void show_picture(int index) override;
  QString caption(int index) const override;
  void end_film() override;
  bool busy() const override;
  /// Whether there are form factors of a solve, so that no drafts are made while only the sun
  /// moves.
  bool by_form_factors() const { return factors_ != nullptr; }

 private:
  void follow();
  bool can_light() const;
  bool has_drafts() const;
  void request(const SolveOptions& options);
  void take_factors(const std::shared_ptr<const SolverSnapshot>& snapshot);
  void hold_solve();
  void take_light(const LiveLightRequest& request, const std::shared_ptr<const Solution>& light);
  void finish();
  void end();
  void return_to_solve();

  WindowFrame frame_;
  SettingsPanel& settings_;
  std::function<bool()> solve_;
  std::shared_ptr<const SolverSnapshot> solved_;  ///< from before the move; null while none is made
  /// The same with form factors, where it is finished and has them; else drafts are made.
  std::shared_ptr<const SolverSnapshot> factors_;
  std::shared_ptr<std::optional<SunLight>> sun_of_factors_;  ///< LiveLightRequest::sun_of_solve
  bool was_running_ = false;
  std::optional<Sky> awaited_;  ///< the sky of the solve that follows, until it has light
  std::vector<SunOfDay> day_;   ///< a film's; empty while there is none
  int picture_ = 0;             ///< the film's, shown once noon has set the exposure
  bool awaits_noon_ = false;
  QTimer* rest_timer_;
  NewestResult<LiveLightRequest, Solution> lights_;
};

}  // namespace transillum::viewer
