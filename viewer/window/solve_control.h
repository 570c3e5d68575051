// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "model/requests/patch_forecast.h"
#include "model/snapshot.h"
#include "session/error_report.h"
#include "support/newest_result.h"
#include "window/base/window_views.h"

namespace transillum::viewer {

class SolveActions;
class SolveUndo;
class ViewStateApplier;

/// Connects the actions and settings of a solve with the runner: run, pause, step, start over, and
/// solving again with changed settings. Says how many patches other settings would make, and asks
/// before it makes very many.
class SolveControl : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  SolveControl(const WindowFrame& frame, SettingsPanel& settings, SolveActions& actions,
               ViewStateApplier& applier);

 signals:
  /// A solve was refused, because nothing emits light: SolveOptions::why_dark().
  void light_missing(const QString& why);

 public slots:
  /// Solves to the end, with the changed materials.
  void finish();
  /// Solves with the settings of the panel. @returns false where there is no light, or where the
  /// user keeps the present solve
  bool solve_settings();
  /// Carries out a step of ColorChoice::errors(): solves again with more passes, more iterations or
  /// divided patches.
  void take_step(const transillum::NextStep& step);

 private:
  void run();
  void advance(Goal::Kind kind);
  /// Whether a solve has light; if not, emits light_missing().
  bool finds_light(const SolveOptions& options);
  /// Solves with the settings of the panel; reads the scene again where its options differ.
  void solve_again();
  /// Asks about long work. @returns whether the solve may be discarded
  bool may_solve_again() const;
  void solve_with_replicas();
  void request_forecast(const SceneOptions& options);
  void show_forecast(const PatchForecast::Request& request, const PatchForecast::Answer& answer);
  /// Asks about a scene of very many patches. @returns whether to make it
  bool may_refine(std::int64_t patches);
  RunOptions wanted_options() const;
  void open_again();
  void start_over();
  void divide_along_shadows();
  void show_division();
  void show_state(RunState state);

  WindowFrame frame_;
  SettingsPanel& settings_;
  SolveActions& actions_;
  ViewStateApplier& applier_;
  SolveUndo& undo_;
  bool awaits_forecast_ = false;  ///< to open the scene again
  NewestResult<PatchForecast::Request, PatchForecast::Answer> forecast_;
};

}  // namespace transillum::viewer
