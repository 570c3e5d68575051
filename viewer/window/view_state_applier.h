// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <optional>

#include "lessons/view_state.h"

namespace transillum::viewer {

class MainWindow;

/// Brings the window to what a page of a lesson or a session file tells, step by step: the scene is
/// loaded, its solve begun, then the moment is looked for.
class ViewStateApplier : public QObject {
  Q_OBJECT

 public:
  explicit ViewStateApplier(MainWindow& window);

  /// A newer wish replaces an older. A scene that is open with the same options is not solved anew.
  void show(const ViewState& state);
  /// The same, of a lesson: what it sets is its own, and goes with it.
  void show_page(const ViewState& page);
  /// The next scene is the user's: it is looked at as at first, as before the lesson.
  void leave();
  /// Reads the open scene's file again, and shows the same of it.
  void reload();
  /// Whether nothing of the newest wish is still to come.
  bool arrived() const;
  /// What the window shows now.
  ViewState state() const;

 private:
  enum class Act { idle, awaits_scene, awaits_run, awaits_direction };

  void bring(const ViewState& state);
  /// Colors, overlays, labels.
  void put_on(const ViewState& state);
  ViewState look() const;
  void begin_with_first_look();
  void begin_run();
  void on_scene();
  void on_snapshot();
  void on_direction();
  bool run_has_begun() const;
  bool moment_is_there() const;
  void arrange();
  void focus();

  MainWindow& window_;
  ViewState wish_;
  std::optional<ViewState> before_;  ///< the look and options before a lesson
  RunOptions brought_options_;       ///< as the panel had them then
  bool left_ = false;
  Act act_ = Act::idle;
  bool opens_ = false;  ///< the scene was asked for by us; it may come more than once
};

}  // namespace transillum::viewer
