// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QUndoStack>

#include "colors/color_choice.h"
#include "colors/run_beside.h"
#include "model/requests/per_direction_visibility.h"
#include "model/requests/relighting.h"
#include "model/solver/solve_runner.h"
#include "state/breakpoints.h"
#include "state/focus.h"
#include "state/focus_feed.h"
#include "state/selection.h"
#include "state/vertical.h"
#include "state/watches.h"
#include "window/base/open_scene.h"

class QMainWindow;
class QPlainTextEdit;

namespace transillum::viewer {

class AlgorithmView;
class DockLayouts;
class LessonPanel;
class MapView;
class Notifier;
class ScenePage;
class SettingsPanel;
class WorkGuard;

/// The state that the views follow and change. It outlives every widget of the window.
struct SharedState {
  QUndoStack undo;  ///< commands of everything that can be undone
  Selection selection;
  Vertical vertical;
  ColorChoice colors{selection};
  SolveRunner runner;
  Relighting relighting{undo};
  OpenScene scene{runner, relighting};
  Focus focus;
  FocusFeed focus_feed{focus};
  RunBeside beside{focus, colors, selection};
  Breakpoints breakpoints;
  Watches watches;
  PerDirectionVisibility visibility;
};

/// The references that objects need which act on the whole window (files, exports, applying a saved
/// state). The views that they act on are passed one by one.
struct WindowFrame {
  QMainWindow& window;
  SharedState& state;
  ScenePage& page;
  Notifier& notifier;
  const WorkGuard& guard;
};

/// Views that main() and the tests reach into.
struct WindowViews {
  ScenePage& page;
  DockLayouts& docks;
  MapView& map;
  AlgorithmView& algorithm;
  SettingsPanel& settings;
  LessonPanel& lessons;
  QPlainTextEdit& notes;
};

}  // namespace transillum::viewer
