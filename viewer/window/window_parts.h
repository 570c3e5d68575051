// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "colors/color_choice.h"
#include "model/per_direction_visibility.h"
#include "model/relighting.h"
#include "model/solve_runner.h"
#include "state/breakpoints.h"
#include "state/focus.h"
#include "state/focus_feed.h"
#include "state/selection.h"
#include "state/watches.h"
#include "window/open_scene.h"

class QMainWindow;
class QPlainTextEdit;

namespace transillum::viewer {

class AlgorithmView;
class ConvergenceView;
class DockLayouts;
class LessonPanel;
class MapView;
class Notifier;
class ScenePage;
class SettingsPanel;
class WorkGuard;

/// What the views follow and change. It outlives every widget of the window.
struct SharedState {
  Selection selection;
  ColorChoice colors{selection};
  SolveRunner runner;
  Relighting relighting;
  OpenScene scene{runner, relighting};
  Focus focus;
  FocusFeed focus_feed{focus};
  Breakpoints breakpoints;
  Watches watches;
  PerDirectionVisibility visibility;
};

/// References to the parts of the window, for what acts on all of it (files, exports, applying a
/// saved state).
struct WindowParts {
  QMainWindow& window;
  SolveRunner& runner;
  OpenScene& scene;
  Relighting& relighting;
  Focus& focus;
  Selection& selection;
  ColorChoice& colors;
  Breakpoints& breakpoints;
  Watches& watches;
  DockLayouts& docks;
  ScenePage& page;
  MapView& map;
  AlgorithmView& algorithm;
  ConvergenceView& charts;
  SettingsPanel& settings;
  LessonPanel& lessons;
  QPlainTextEdit& notes;
  Notifier& notifier;
  const WorkGuard& guard;
};

}  // namespace transillum::viewer
