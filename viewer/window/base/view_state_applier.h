// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <vector>

#include "lessons/view_state.h"
#include "window/base/window_views.h"

namespace transillum::viewer {

/// Brings the window to the state that a lesson page or a session file describes, in phases: the
/// scene is loaded, its solve is started, then the requested direction and step are shown.
class ViewStateApplier : public QObject {
  Q_OBJECT

 public:
  ViewStateApplier(const WindowFrame& frame, DockLayouts& docks, MapView& map,
                   AlgorithmView& algorithm, SettingsPanel& settings);

  /// A newer request replaces an older one. A scene that is open with the same options is not
  /// solved again.
  void show(const ViewState& state);
  /// The same for a page of a lesson: leave_lesson() restores the settings that the user had
  /// before.
  void show_page(const ViewState& page);
  /// Solves with another value of one option, for a control of a lesson's page; everything else
  /// stays as it is shown now.
  /// @param name,value  as in PageControl
  void set_option(const std::string& name, const std::string& value);
  /// Call before opening a scene for the user: restores the options from before the lesson now, and
  /// colors, overlays and camera once the scene is loaded.
  void leave_lesson();
  /// Whether a page has been shown, and leave_lesson() not called since.
  bool in_lesson() const { return before_lesson_ && !leaving_; }
  /// Shows the newest direction in lessons and in layouts that are about directions: in Teach
  /// without a lesson, while the solve runs.
  void follow_layout();
  void enable_sharp(bool enabled);
  /// Reads the file of the open scene again, and shows it in the same state.
  void reload();
  /// Reads the open scene again with other options and solves it. Camera, colors and changed
  /// materials stay; the selection does not, since patches may be others.
  void open_again(const RunOptions& options);
  /// Whether the newest request has been carried out.
  bool arrived() const;
  /// The state that the window shows now.
  ViewState state() const;

 signals:
  /// A position or patch of the newest request does not exist; the nearest position is shown.
  /// @param message as in the window
  void unreachable(const QString& message);

 private:
  enum class Awaits { nothing, scene, run, rounds, iteration, direction };

  void apply(const ViewState& state);
  /// Remembers what leave_lesson() restores.
  void enter_lesson();
  /// Applies colors, overlays and labels.
  void apply_appearance(const ViewState& state);
  ViewState appearance() const;
  void read_patches(ViewState& state) const;
  void restore_appearance();
  void start_run();
  void open_requested();
  void on_scene();
  void on_snapshot();
  void on_direction();
  bool run_has_started() const;
  bool is_requested(const SolverSnapshot& snapshot) const;
  bool has_patches() const;
  bool run_is_over() const;
  void fail(const QString& message);
  void apply_view();
  void apply_selection();
  void apply_focus();

  WindowFrame frame_;
  DockLayouts& docks_;
  MapView& map_;
  AlgorithmView& algorithm_;
  SettingsPanel& settings_;
  ViewState requested_;
  std::optional<ViewState> before_lesson_;  ///< appearance and options
  RunOptions applied_options_;              ///< in the settings panel after the last request
  bool leaving_ = false;                    ///< leave_lesson() was called for the next scene
  bool applies_view_ = false;               ///< within apply_view()
  Awaits awaits_ = Awaits::nothing;
  bool ended_ = false;  ///< the solve run that is shown
  /// The first directions of the run that the requested run replaces; null if it replaces none.
  /// Each run has its own copy.
  std::shared_ptr<const std::vector<Vec3>> run_before_;
  bool opened_here_ = false;  ///< the scene being loaded was requested by this object
};

}  // namespace transillum::viewer
