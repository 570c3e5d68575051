// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <optional>

#include "view_state.h"

namespace transillum::viewer {

class MainWindow;

/// Brings the window to what a page of a lesson or a session file tells, step by step: the scene is
/// loaded, its solve begun, then the moment is looked for.
class Stage : public QObject {
  Q_OBJECT

 public:
  explicit Stage(MainWindow& window);

  /// A newer wish replaces an older. A scene that is open with the same options is not solved anew.
  void show(const ViewState& state);
  /// Reads the open scene's file again, and shows the same of it.
  void reload();
  /// Whether nothing of the newest wish is still to come.
  bool arrived() const;
  /// What the window shows now.
  ViewState state() const;

 private:
  enum class Act { idle, awaits_scene, awaits_run, awaits_direction };

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
  Act act_ = Act::idle;
  bool opens_ = false;  ///< the scene was asked for by us; it may come more than once
};

}  // namespace transillum::viewer
