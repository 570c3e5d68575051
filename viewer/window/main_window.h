// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QMainWindow>

#include "widgets/full_screen.h"
#include "window/base/dock_layouts.h"
#include "window/base/open_scene.h"
#include "window/base/window_views.h"
#include "window/menus/appearance_actions.h"

class QDockWidget;
class QMenu;
class QPlainTextEdit;

namespace transillum::viewer {

class BreakpointPanel;
class CompareView;
class ConvergenceView;
class DirectionView;
class ErrorView;
class ExportActions;
class FileActions;
class FrameRecorder;
class InspectionPanels;
class LayoutMemory;
class LessonExport;
class LobeView;
class PatchInspector;
class ProgressLine;
class ProjectorMode;
class ReceivedView;
class SceneEdits;
class SolveActions;
class SolveSummary;
class StepActions;
class StepPanel;
class StudyDialog;
class SunDrag;
class TimelineBar;
class VerticalControl;
class ViewStateApplier;
class WindowSession;

/// The one window: creates the views and the objects that act on all of them, places them in docks
/// and menus, and connects them. Their behavior is in their own files; only main() and the tests
/// include this file.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// @param state the state that the views follow; must outlive the window
  /// @param remember restore the layout of the last run, and save it for the next
  MainWindow(SharedState& state, bool remember, QWidget* parent = nullptr);
  ~MainWindow() override;

  WindowFrame frame();
  WindowViews views();
  FileActions& files() { return *files_; }
  ViewStateApplier& applier() { return *applier_; }
  WorkGuard& work_guard() { return work_guard_; }
  void show_failure(const QString& message);
  /// Whether the solver is idle and every view shows the newest state.
  bool settled() const;
  /// Closes the window without a dialog. Notes that have not been saved are written to a session
  /// file, whose path is returned; it is empty if there are no such notes.
  /// @throws std::runtime_error where that file cannot be written; the window is closed
  QString close_without_questions();

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void make_views();
  void make_whole_window_actions();
  void make_docks();
  void watch_maps();
  void connect_views();
  void connect_scene();
  void show_debugging_of_scene();
  void connect_failures();
  void show_patches(const std::shared_ptr<const LoadedScene>& loaded);
  void show_title_and_warnings(const LoadedScene& loaded);
  void make_menus();
  void make_file_menu();
  void make_view_menu();
  /// Asks about long work and unsaved notes. @returns whether the window may close
  bool may_close();

  SharedState& state_;
  const bool remember_;
  bool asks_ = true;  ///< about unsaved notes, when the window closes
  DockLayouts docks_{*this};
  FullScreen full_screen_{*this};
  ProjectorMode* projector_;
  AppearanceActions appearance_{this};
  WorkGuard work_guard_{state_.scene};

  ScenePage* page_;
  Notifier* notifier_;
  MapView* map_view_;
  ErrorView* error_view_;
  ConvergenceView* convergence_view_;
  DirectionView* direction_view_;
  ReceivedView* received_view_;
  LobeView* lobe_view_;
  CompareView* compare_view_;
  PatchInspector* inspector_;
  SettingsPanel* settings_;
  SolveSummary* summary_;
  ProgressLine* progress_;
  TimelineBar* timeline_;
  AlgorithmView* algorithm_;
  BreakpointPanel* breakpoint_panel_;
  StepPanel* step_panel_;
  LessonPanel* lesson_panel_;
  QPlainTextEdit* notes_;
  InspectionPanels* inspection_;
  StudyDialog* study_;
  QDockWidget* map_dock_;
  QList<QDockWidget*> map_docks_;  ///< panels that show maps

  SolveActions* solve_actions_;
  StepActions* step_actions_;
  QAction* study_action_;
  SceneEdits* edits_;
  SunDrag* sun_;
  ViewStateApplier* applier_;
  VerticalControl* vertical_;
  WindowSession* session_;
  FileActions* files_;
  LayoutMemory* memory_;
  ExportActions* exports_;
  FrameRecorder* recorder_;
  LessonExport* lesson_export_;
};

}  // namespace transillum::viewer
