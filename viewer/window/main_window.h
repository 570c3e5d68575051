// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QMainWindow>
#include <memory>
#include <string>

#include "colors/color_choice.h"
#include "lessons/session_file.h"
#include "model/per_direction_visibility.h"
#include "model/run_options.h"
#include "model/solve_runner.h"
#include "state/breakpoints.h"
#include "state/focus.h"
#include "state/focus_feed.h"
#include "state/selection.h"
#include "widgets/full_screen.h"
#include "window/appearance_actions.h"
#include "window/dock_layouts.h"

class QDockWidget;
class QMenu;
class QPlainTextEdit;

namespace transillum::viewer {

class AlgorithmView;
class BreakpointPanel;
class CompareView;
class ConvergenceView;
class DirectionView;
class ExportActions;
class FileActions;
class InspectionPanels;
class LessonPanel;
class MapView;
class PatchInspector;
class ProgressLine;
class ReceivedView;
class ScenePage;
class SceneView;
class SettingsPanel;
class SolveActions;
class SolveSummary;
class ViewStateApplier;
class StepActions;
class StudyDialog;
class TimelineBar;

/// The one window: lays out the views and carries snapshots to them.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// `remember`: take the layout from the last time, and keep it for the next.
  explicit MainWindow(bool remember, QWidget* parent = nullptr);
  ~MainWindow() override;

  void set_options(const SolveOptions& solve, const SceneOptions& scene);
  void open(const QString& spec, Goal then = {Goal::Kind::finished});
  /// The same, as who chooses a scene expects: nothing of a lesson stays, it is looked at as at
  /// first, exposed by itself, and the newest direction followed.
  void open_afresh(const QString& spec, Goal then = {Goal::Kind::finished});
  /// A lesson of a JSON file; shows its first page, or says what is wrong with it.
  void open_lesson(const QString& path);
  /// Goes where a session was saved, and what a session is to keep now.
  void show_session(const Session& session);
  Session current_session() const;
  /// The notes are in a file now: nothing is lost when the window closes.
  void keep_notes();
  FileActions& files() { return *files_; }
  ExportActions& exports() { return *exports_; }
  /// Says what has gone wrong above the scene.
  void show_failure(const QString& message);
  /// Says for a while in the status bar that a file has been written.
  void say_written(const QString& path);
  /// As the command line names it: a file, or a number from 1. @throws InputError
  void begin_lesson(const std::string& which, int page);
  /// What the next solve will be told.
  RunOptions options() const;
  /// The open scene, and how it was read.
  const std::string& spec() const { return spec_; }
  const SceneOptions& scene_options_in_effect() const { return scene_options_; }
  /// Whether `spec` is open, read with `options`; a result's file has options of its own.
  bool shows(const std::string& spec, const SceneOptions& options) const;
  /// Whether the open scene's patches have outlines unless they are hidden.
  bool outlined_at_first() const;

  /// Whether the worker rests and every view shows the newest there is.
  bool settled() const;
  SolveRunner& runner() { return runner_; }
  Focus& focus() { return focus_; }
  Breakpoints& breakpoints() { return breakpoints_; }
  Selection& selection() { return selection_; }
  ColorChoice& colors() { return colors_; }
  std::shared_ptr<const SolverSnapshot> snapshot() const { return snapshot_; }
  DockLayouts& docks() { return docks_; }
  FullScreen& full_screen() { return full_screen_; }
  ScenePage* page() const { return page_; }
  InspectionPanels& inspection() { return *inspection_; }
  MapView* map_view() const { return map_view_; }
  AlgorithmView* algorithm() const { return algorithm_; }
  ViewStateApplier& stage() { return *stage_; }
  QString banner_text() const;

 signals:
  void failed(const QString& message, bool bad_input);
  void scene_shown();
  void snapshot_shown();

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void make_center();
  void make_docks();
  void make_menus();
  void fill_open_menu(QMenu& menu);
  void connect_runner();
  void restore_layout();
  void choose_lesson();
  void run();
  void solve_anew();
  void solve_with_replicas();
  void show_loaded(std::shared_ptr<const LoadedScene> loaded);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void show_state(RunState state);
  bool at_start() const;
  /// Whether the window may close: unsaved notes are asked about.
  bool notes_may_go();

  const bool remember_;
  Selection selection_;
  ColorChoice colors_{selection_};
  SolveRunner runner_;
  Focus focus_;
  FocusFeed focus_feed_{focus_};
  Breakpoints breakpoints_;
  PerDirectionVisibility visibility_;
  DockLayouts docks_{*this};
  FullScreen full_screen_{*this};
  AppearanceActions appearance_{this};
  std::string asked_spec_, spec_;  // the scene asked for last, and the open one
  SceneOptions asked_scene_options_, scene_options_;
  std::shared_ptr<const LoadedScene> loaded_;
  std::shared_ptr<const SolverSnapshot> snapshot_;

  ViewStateApplier* stage_ = nullptr;
  InspectionPanels* inspection_;
  FileActions* files_;
  ExportActions* exports_;
  QPlainTextEdit* notes_;
  SolveActions* actions_;
  StepActions* step_actions_;
  ScenePage* page_;
  SceneView* scene_view_;
  MapView* map_view_;
  ConvergenceView* convergence_view_;
  DirectionView* direction_view_;
  ReceivedView* received_view_;
  CompareView* compare_view_;
  PatchInspector* inspector_;
  SettingsPanel* settings_;
  SolveSummary* summary_;
  ProgressLine* progress_;
  TimelineBar* timeline_;
  AlgorithmView* algorithm_;
  BreakpointPanel* breakpoint_panel_;
  LessonPanel* lesson_panel_;
  QDockWidget* map_dock_;
  StudyDialog* study_;
};

}  // namespace transillum::viewer
