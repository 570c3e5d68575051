// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTimer>
#include <algorithm>
#include <exception>
#include <optional>

#include "directions/direction_view.h"
#include "directions/lobe_view.h"
#include "directions/received_view.h"
#include "io/results/reference_cache.h"
#include "lessons/lesson_panel.h"
#include "lessons/question_box.h"
#include "map/compare_view.h"
#include "map/map_canvas.h"
#include "map/map_view.h"
#include "map/phase_pair.h"
#include "map/section_view.h"
#include "model/snapshot_values.h"
#include "patches/error_page.h"
#include "patches/patch_inspector.h"
#include "scene/color_controls.h"
#include "scene/error_view.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "scene/show_menu.h"
#include "solve/convergence_view.h"
#include "solve/progress_line.h"
#include "solve/round_panel.h"
#include "solve/settings_panel.h"
#include "solve/solve_actions.h"
#include "solve/solve_summary.h"
#include "solve/study_dialog.h"
#include "stepping/algorithm_view.h"
#include "stepping/breakpoint_panel.h"
#include "stepping/event_filter_row.h"
#include "stepping/play_control.h"
#include "stepping/step_actions.h"
#include "stepping/step_panel.h"
#include "stepping/timeline_bar.h"
#include "stepping/timeline_lanes.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "tree/tree_view.h"
#include "widgets/banner.h"
#include "widgets/build.h"
#include "widgets/scrolling.h"
#include "widgets/theme.h"
#include "window/base/notifier.h"
#include "window/base/view_state_applier.h"
#include "window/context_menus.h"
#include "window/editing/editing.h"
#include "window/editing/scene_edits.h"
#include "window/files/export_actions.h"
#include "window/files/file_actions.h"
#include "window/files/frame_recorder.h"
#include "window/files/lesson_export.h"
#include "window/files/recovery.h"
#include "window/files/thumbnails.h"
#include "window/files/window_session.h"
#include "window/inspection_panels.h"
#include "window/layout_memory.h"
#include "window/menus/command_actions.h"
#include "window/menus/help_pages.h"
#include "window/menus/leave_action.h"
#include "window/menus/palette_actions.h"
#include "window/menus/projector_mode.h"
#include "window/scene_bars.h"
#include "window/solve_control.h"
#include "window/start_control.h"
#include "window/sun_drag.h"
#include "window/vertical_control.h"
#include "window/workspace_bar.h"

namespace transillum::viewer {

namespace {

constexpr QSize usual_size(1600, 1000);

/// The fraction of light that escapes; not set before the first pass of a scene with light.
std::optional<double> escape_of(const SolverSnapshot& snapshot) {
  if (snapshot.passes_done > 0) {
    return snapshot.statistics.escaped;
  }
  return has_light(snapshot) ? std::nullopt : snapshot.loaded->open_fraction;
}

QString dropped_file(const QMimeData& data) {
  const QList<QUrl> urls = data.urls();
  return urls.size() == 1 && urls.front().isLocalFile() ? urls.front().toLocalFile() : QString();
}

}  // namespace

MainWindow::MainWindow(SharedState& state, bool remember, QWidget* parent)
    : QMainWindow(parent), state_(state), remember_(remember) {
  setWindowTitle(tr("transillum"));
  setAcceptDrops(true);
  guard_wheel(*qApp);
  make_views();
  // Views receive scenes and snapshots in the order in which they are connected here.
  connect_views();
  connect_scene();
  make_whole_window_actions();
  connect_failures();
  make_docks();
  make_menus();
  // To step and to teach, every direction is seen. The small scene beside a map has no room for all
  // buttons; a key and the menu switch sharp pictures, too.
  connect(&docks_, &DockLayouts::switched, &state_.runner, [this] {
    state_.runner.set_drafts(docks_.current() == Layout::inspect);
    applier_->follow_layout();
    page_->sharp_button()->setVisible(docks_.current() != Layout::debug);
  });
  docks_.arrange(Layout::inspect);
  resize(usual_size);  // a screenshot has the same size on every screen
  if (remember_) {
    memory_->restore();
    (new Recovery(frame(), *session_, Recovery::usual_folder()))->offer();
  }
  const auto* thumbnails = remember_ ? new Thumbnails(frame(), Thumbnails::usual_folder(),
                                                      [this] { return applier_->in_lesson(); })
                                     : nullptr;
  new StartControl(frame(), docks_, *files_, *lesson_panel_, full_screen_, thumbnails);
  docks_.cover(page_->shows_start());
}

MainWindow::~MainWindow() = default;

WindowViews MainWindow::views() {
  return {*page_, docks_, *map_view_, *algorithm_, *settings_, *lesson_panel_, *notes_};
}

WindowFrame MainWindow::frame() { return {*this, state_, *page_, *notifier_, work_guard_}; }

void MainWindow::make_views() {
  page_ = new ScenePage(state_.focus, state_.selection, state_.colors);
  setCentralWidget(page_);
  notifier_ = new Notifier(*page_->banner(), *statusBar());
  notifier_->setParent(this);
  step_actions_ = new StepActions(state_.focus, state_.selection, this);
  settings_ = new SettingsPanel;
  summary_ = new SolveSummary;
  inspector_ = new PatchInspector(state_.focus, state_.selection, state_.colors);
  map_view_ = new MapView(state_.focus, state_.selection, state_.colors, state_.beside);
  error_view_ = new ErrorView([this] { return page_->scene_view()->view_point(); },
                              state_.relighting.edits());
  convergence_view_ = new ConvergenceView(state_.focus);
  direction_view_ =
      new DirectionView(state_.focus, state_.selection, state_.colors, state_.visibility);
  received_view_ = new ReceivedView(state_.focus, state_.selection, state_.visibility);
  lobe_view_ = new LobeView(state_.selection, state_.colors);
  compare_view_ = new CompareView(state_.focus, state_.selection, state_.colors);
  algorithm_ = new AlgorithmView(state_.focus, state_.selection);
  step_panel_ = new StepPanel(state_.focus, state_.selection);
  breakpoint_panel_ = new BreakpointPanel(state_.focus, state_.selection, state_.breakpoints);
  lesson_panel_ = new LessonPanel(built_in_lessons(), state_.selection, state_.focus,
                                  state_.relighting.edits());
  if (remember_) {
    lesson_panel_->set_tally_folder(
        QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
        QStringLiteral("/tallies"));
  }
  lesson_panel_->question().set_scene_source([this](const ViewState& page) {
    return state_.scene.is_open(page.scene, page.options) ? whole_of(state_.scene.loaded())
                                                          : nullptr;
  });
  notes_ = named("notes", new QPlainTextEdit);
  notes_->setPlaceholderText(tr("Your notes; they are saved with the session."));
  timeline_ = new TimelineBar(state_.focus, state_.selection, state_.watches, *step_actions_);
  timeline_->lanes()->set_marks(
      [this](const MapHistory& history) { return state_.breakpoints.steps_in(history); });
  inspection_ = new InspectionPanels(state_, page_->hidden(), this);
  study_ = new StudyDialog(remember_ ? ReferenceCache::default_folder() : std::filesystem::path(),
                           state_.relighting.edits(), this);
  progress_ = new ProgressLine;
  statusBar()->addWidget(progress_, 1);
  statusBar()->setSizeGripEnabled(false);
}

void MainWindow::make_whole_window_actions() {
  const WindowFrame frame = this->frame();
  solve_actions_ = new SolveActions(this);
  applier_ = new ViewStateApplier(frame, docks_, *map_view_, *algorithm_, *settings_);
  auto* control = new SolveControl(frame, *settings_, *solve_actions_, *applier_);
  sun_ = new SunDrag(frame, *settings_, [control] { return control->solve_settings(); });
  vertical_ = new VerticalControl(frame, *settings_);
  session_ = new WindowSession(frame, docks_, *notes_, *applier_);
  files_ = new FileActions(frame, docks_, *settings_, *lesson_panel_, *applier_, *session_);
  memory_ = new LayoutMemory(frame, docks_, appearance_, *files_, *lesson_panel_);
  exports_ = new ExportActions(frame, *map_view_, *convergence_view_);
  recorder_ = new FrameRecorder(frame, *timeline_->play(), *map_view_);
  recorder_->set_change(FilmPlan::Over::day, *sun_);
  timeline_->play()->menu()->addSeparator();
  timeline_->play()->menu()->addAction(recorder_->film_action());
  new LoadingNotice(frame);
  lesson_export_ =
      new LessonExport(frame, *lesson_panel_, [this] { return settled() && !error_view_->busy(); });
  auto* light = new LightOffer(frame, docks_, *settings_, inspection_->materials(), *applier_);
  ErrorPage& errors = inspection_->errors();
  connect(&errors, &ErrorPage::solve_wanted, control, &SolveControl::finish);
  connect(&errors, &ErrorPage::step_chosen, control, &SolveControl::take_step);
  connect(&errors, &ErrorPage::save_wanted, exports_->errors_action(), &QAction::trigger);
  connect(control, &SolveControl::light_missing, light, &LightOffer::show_refusal);
  new OrientationOffer(frame, *settings_, *applier_);
  new SolidsOffer(frame, *settings_, *applier_);
  connect(lesson_panel_, &LessonPanel::page_shown, timeline_->play(), &PlayControl::stop);
  connect(lesson_panel_, &LessonPanel::page_shown, applier_, &ViewStateApplier::show_page);
  connect(lesson_panel_, &LessonPanel::option_chosen, applier_, &ViewStateApplier::set_option);
  connect(lesson_panel_, &LessonPanel::open_clicked, files_, &FileActions::choose_lesson);
  lesson_panel_->set_guard([this] {
    return applier_->in_lesson() ||
           work_guard_.may_lose(this, tr("Begin the lesson"), WorkGuard::Lost::scene);
  });
  state_.breakpoints.set_undo_stack(&state_.undo);
  state_.watches.set_undo_stack(&state_.undo);
  page_->bookmarks().set_undo_stack(&state_.undo);
  lesson_panel_->question().set_undo_stack(&state_.undo);
}

void MainWindow::make_docks() {
  docks_.add(tr("Lesson"), "lesson_dock", lesson_panel_);
  docks_.add(tr("Notes"), "notes_dock", notes_);
  docks_.add(tr("Solve settings"), "settings_dock", scrollable(settings_));
  docks_.add(tr("Patch"), "inspector_dock", scrollable(inspector_));
  docks_.add(tr("Summary"), "summary_dock", scrollable(summary_));
  inspection_->add_materials_to(docks_);
  map_dock_ = docks_.add(tr("Visibility map"), "map_dock", map_view_);
  auto* section = new SectionView(state_.focus, state_.selection, state_.colors);
  connect(lesson_panel_, &LessonPanel::callouts_shown, section, &SectionView::show_callouts);
  docks_.add(tr("Section"), "section_dock", section);
  docks_.add(tr("Error"), "error_dock", error_view_);
  docks_.add(tr("Lobes"), "lobe_dock", lobe_view_);
  docks_.add(tr("Compare engines"), "compare_dock", scrollable(compare_view_));
  inspection_->add_light_to(docks_, *received_view_);
  inspection_->add_tables_to(docks_);
  docks_.add(tr("Charts"), "convergence_dock", scrollable(convergence_view_));
  docks_.add(tr("Algorithm"), "algorithm_dock", scrollable(algorithm_));
  docks_.add(tr("Events"), "event_dock", step_panel_);
  docks_.add(tr("Breakpoints"), "breakpoint_dock", breakpoint_panel_);
  docks_.add(tr("BSP tree"), "tree_dock", new TreeView(state_.focus, state_.selection));
  docks_.add(tr("Directions"), "direction_dock", direction_view_);
  QDockWidget* timeline_dock = docks_.add(tr("Timeline"), "timeline_dock", timeline_);
  timeline_dock->setTitleBarWidget(new QWidget);  // a title would take too much of a projector
  // Maps are recorded only while a panel shows them.
  for (const char* name : {"map", "algorithm", "event", "tree", "compare", "section", "timeline"}) {
    auto* dock = findChild<QDockWidget*>(QStringLiteral("%1_dock").arg(name));
    map_docks_ << dock;
    // The docks outlive the members of the window.
    connect(dock, &QDockWidget::visibilityChanged, &docks_, [this] { watch_maps(); });
  }
}

void MainWindow::watch_maps() {
  state_.focus_feed.set_watched(
      std::any_of(map_docks_.begin(), map_docks_.end(),
                  [](const QDockWidget* dock) { return !dock->isHidden(); }));
}

/// Connects views with one another, through the shared state.
void MainWindow::connect_views() {
  inspection_->follow_links(*inspector_, *received_view_);
  connect(settings_, &SettingsPanel::errors_wanted, inspection_, &InspectionPanels::show_errors);
  connect(inspection_, &InspectionPanels::paths_shown, page_->scene_view(), &SceneView::show_paths);
  connect(inspection_, &InspectionPanels::face_chosen, page_->scene_view(),
          &SceneView::fit_selected);
  const auto raise = [this](auto* name) { return [this, name] { docks_.bring_to_front(name); }; };
  connect(notifier_, &Notifier::list_requested, this, raise("warnings"));
  connect(step_panel_->filter(), &EventFilterRow::requested, this, raise("event"));
  connect(compare_view_, &CompareView::enlarged, this,
          [this](bool large) { docks_.show_alone(large ? "compare" : ""); });
  connect(&docks_, &DockLayouts::alone, compare_view_->large(),
          [large = compare_view_->large()](const QString& panel) {
            large->setChecked(panel == QLatin1String("compare"));
          });
  connect(algorithm_, &AlgorithmView::region_shown, map_view_->canvas(), &MapCanvas::mark_region);
  connect(lesson_panel_, &LessonPanel::errors_wanted, error_view_, &ErrorView::set_runs);
  connect(lesson_panel_, &LessonPanel::callouts_shown, map_view_->canvas(),
          &MapCanvas::show_callouts);
  connect(lesson_panel_, &LessonPanel::callouts_shown, page_->scene_view(),
          &SceneView::show_callouts);
  connect(lesson_panel_, &LessonPanel::symbol_pointed, algorithm_, &AlgorithmView::point_at);
  connect(lesson_panel_, &LessonPanel::values_hidden, algorithm_,
          &AlgorithmView::set_values_hidden);
  connect(lesson_panel_, &LessonPanel::enlarged, &docks_, &DockLayouts::enlarge);
  connect(lesson_panel_, &LessonPanel::sketched, map_view_->canvas(), &MapCanvas::show_sketch);
  connect(page_->scene_view(), &SceneView::ray_clicked, &lesson_panel_->question(),
          &QuestionBox::take_ray);
  connect(&lesson_panel_->question(), &QuestionBox::surface_sketched, page_->scene_view(),
          &SceneView::show_sketch);
  connect(&state_.runner, &SolveRunner::state_changed, &lesson_panel_->question(),
          &QuestionBox::show_run);
  connect(&state_.breakpoints, &Breakpoints::changed, timeline_->lanes(),
          &TimelineLanes::count_columns);
  connect(&state_.runner, &SolveRunner::load_progressed, progress_, &ProgressLine::show_loading);
  connect(&state_.runner, &SolveRunner::state_changed, progress_, &ProgressLine::show_state);
  connect(&state_.runner, &SolveRunner::state_changed, page_->sharp(), [this](RunState run) {
    page_->sharp()->set_solving(run == RunState::running || run == RunState::loading);
  });
  projector_ =
      new ProjectorMode(frame(), docks_, *lesson_panel_, full_screen_, appearance_, *timeline_);
  connect(&appearance_, &AppearanceActions::changed, this, [this] {
    state_.scene.show_again();
    map_view_->update();
    lesson_panel_->refresh();
    projector_->follow_appearance();
    // After the layouts have received the new font.
    QTimer::singleShot(0, &docks_, &DockLayouts::follow_type);
  });
  // The call is made later: the window does not know the new least height yet.
  connect(
      timeline_, &TimelineBar::chart_shown, this,
      [this] {
        docks_.fit_bottom();
        projector_->follow_timeline();
      },
      Qt::QueuedConnection);
  connect(timeline_->play(), &PlayControl::turned, page_->scene_view(),
          [this](double degrees) { page_->scene_view()->turn(degrees, 0); });
}

void MainWindow::show_title_and_warnings(const LoadedScene& loaded) {
  const std::string& file = loaded.stored ? loaded.file : loaded.scene->name();
  setWindowTitle(tr("%1 – transillum").arg(QFileInfo(QString::fromStdString(file)).fileName()));
  QStringList warnings;
  for (const std::string& warning : loaded.scene->report().warnings) {
    warnings << QString::fromStdString(warning);
  }
  // Older messages were dismissed when the scene was requested.
  if (!warnings.isEmpty()) {
    notifier_->show_warnings(warnings, true);
  }
}

/// Views of the patches begin with the new patches.
void MainWindow::show_patches(const std::shared_ptr<const LoadedScene>& loaded) {
  state_.selection.select(no_patch);
  state_.focus_feed.clear();
  inspection_->show_scene(*loaded);
  map_view_->clear();
  direction_view_->clear();
  lobe_view_->clear();
  received_view_->clear();
  compare_view_->clear();
  page_->scene_view()->show_scene(loaded);
  progress_->show_scene(*loaded);
  study_->show_scene(loaded);
}

/// Connects every view with the open scene: the one place where scenes and snapshots go out.
void MainWindow::connect_scene() {
  using Loaded = std::shared_ptr<const LoadedScene>;
  using Snapshot = std::shared_ptr<const SolverSnapshot>;
  connect(&state_.scene, &OpenScene::opening, notifier_, &Notifier::dismiss);
  connect(&state_.scene, &OpenScene::opening, lesson_panel_, &LessonPanel::leave_scene);
  connect(&state_.scene, &OpenScene::scene_loaded, this, [this](const Loaded& loaded) {
    settings_->set_scene_fixed(!loaded->description);
    // How faces become patches belongs to the scene.
    settings_->set_options(settings_->solve_options(), state_.scene.options());
    vertical_->show_scene(*loaded);
    settings_->show_escape({});
    settings_->set_scene(*loaded->scene);
    show_debugging_of_scene();
    page_->show_scene();
    show_patches(loaded);
    page_->color_controls()->set_outlines(state_.scene.outlined_by_default());
    show_title_and_warnings(*loaded);
  });
  connect(&state_.scene, &OpenScene::patches_changed, this, [this](const Loaded& loaded) {
    const bool first = !page_->scene_view()->loaded()->whole && loaded->whole;
    show_patches(loaded);
    if (first) {
      page_->color_controls()->set_outlines(true);  // to see what the rounds divide
    }
  });
  connect(&state_.scene, &OpenScene::snapshot_ready, this, [this](const Snapshot& snapshot) {
    settings_->set_in_effect(snapshot, state_.scene.options());
    settings_->show_escape(escape_of(*snapshot));
    study_->show_solve(*snapshot);
    state_.colors.fit(snapshot);
  });
  const auto send_to = [this](auto* view) {
    using View = std::remove_pointer_t<decltype(view)>;
    if constexpr (std::is_invocable_v<decltype(&View::show_snapshot), View*, const Snapshot&>) {
      connect(&state_.scene, &OpenScene::snapshot_ready, view, &View::show_snapshot);
    } else {
      connect(&state_.scene, &OpenScene::snapshot_ready, view,
              [view](const Snapshot& snapshot) { view->show_snapshot(*snapshot); });
    }
  };
  send_to(page_->scene_view());
  send_to(map_view_);
  send_to(convergence_view_);
  send_to(direction_view_);
  send_to(lobe_view_);
  send_to(received_view_);
  send_to(compare_view_);
  send_to(inspector_);
  send_to(inspection_);
  send_to(algorithm_);
  send_to(summary_);
  connect(summary_, &SolveSummary::costs_wanted, &state_.colors, &ColorChoice::request_costs);
  connect(&state_.colors, &ColorChoice::costs_changed, summary_, &SolveSummary::show_costs);
  send_to(settings_->rounds());
  send_to(progress_);
  send_to(timeline_);
  send_to(lesson_panel_);
  send_to(error_view_);
  send_to(&state_.focus_feed);
}

/// Breakpoints and watches.
void MainWindow::show_debugging_of_scene() {
  if (applier_->in_lesson()) {
    state_.breakpoints.set_scene({});
    state_.breakpoints.set_list({});
    state_.watches.set_scene({});
    state_.watches.set_list({});
  } else {
    state_.breakpoints.set_scene(state_.scene.spec());
    state_.watches.set_scene(state_.scene.spec());
  }
}

void MainWindow::connect_failures() {
  connect(&state_.runner, &SolveRunner::failed, notifier_, &Notifier::show_failure);
  connect(page_->sharp(), &SharpView::failed, notifier_, &Notifier::show_failure);
  connect(inspection_, &InspectionPanels::failed, notifier_, &Notifier::show_failure);
  connect(error_view_, &ErrorView::failed, notifier_, &Notifier::show_failure);
  connect(lesson_panel_, &LessonPanel::failed, notifier_, &Notifier::show_failure);
  connect(&state_.focus_feed, &FocusFeed::failed, notifier_, &Notifier::show_failure);
  connect(&state_.visibility, &PerDirectionVisibility::failed, notifier_, &Notifier::show_failure);
}

void MainWindow::make_menus() {
  make_file_menu();
  inspection_->add_to(*menuBar());
  edits_ = add_editing(frame(), docks_, *findChild<QMenu*>("edit_menu"));
  recorder_->set_change(FilmPlan::Over::move, *edits_);

  QMenu* solve = menuBar()->addMenu(tr("&Solve"));
  solve_actions_->add_to(*solve);
  solve->addSeparator();
  study_action_ = make_action(this, "study", tr("Study…"),
                              tr("Error of B against the number of directions (Ctrl+T)"),
                              QKeySequence("Ctrl+T"));
  study_action_->setIcon(theme::icon(theme::Icon::study));
  connect(study_action_, &QAction::triggered, study_, &StudyDialog::present);
  solve->addAction(study_action_);

  QMenu* step = menuBar()->addMenu(tr("S&tep"));
  step_actions_->add_to(*step);
  step->addSeparator();
  step->addAction(timeline_->play()->action());
  step->addAction(map_view_->pair()->action());
  step->addSeparator();
  breakpoint_panel_->add_to(*step);
  step->addSeparator();
  step_panel_->filter()->add_to(*step);
  step->addMenu(timeline_->watch_menu());

  QMenu* lesson = menuBar()->addMenu(tr("&Lesson"));
  lesson_panel_->add_to(*lesson);
  lesson->addAction(lesson_export_->action());
  make_view_menu();

  QMenu* help = menuBar()->addMenu(tr("&Help"));
  help->addAction((new PaletteActions(frame(), docks_))->action());
  add_help_pages(*help, *this);
  addToolBar(
      new WorkspaceBar(docks_, *page_->start_action(), *files_->open_action(), *solve_actions_));
  new ContextMenus(frame(), docks_);
  show_tips_of_menus(*this);
}

void MainWindow::make_file_menu() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  files_->add_to(*file);
  file->addAction(exports_->save_scene_action());
  file->addAction(exports_->figure_action());
  file->addAction(recorder_->film_action());
  file->addAction(exports_->color_action());
  QMenu* exporting = file->addMenu(tr("Export"));
  exports_->add_to(*exporting);
  recorder_->add_to(*exporting);
  (new CommandActions(frame(), *map_view_, [this] {
    return exports_->save_edited();
  }))->add_to(*file);
  files_->set_saver([this] { return exports_->save_edited(); });
  file->addSeparator();
  file->addAction(tr("Quit"), this, &QWidget::close, QKeySequence(QStringLiteral("Ctrl+Q")));
}

void MainWindow::make_view_menu() {
  QMenu* view = menuBar()->addMenu(tr("&View"));
  view->addAction(page_->start_action());
  docks_.add_to(*view);
  view->addSeparator();
  appearance_.add_to(*view);
  view->addAction(full_screen_.action());
  view->addAction(compare_view_->large());
  view->addSeparator();
  view->addMenu(page_->camera_menu());
  view->addAction(tr("Show or hide the direction"), page_->color_controls(),
                  &ColorControls::toggle_direction, QKeySequence(Qt::Key_D));
  view->addAction(page_->sharp()->action());
  view->addAction(page_->color_controls()->show_menu()->next_clip_axis());
  view->addAction(new_leave_action(frame(), full_screen_));
}

bool MainWindow::may_close() {
  if (!work_guard_.may_lose(this, tr("Quit"), WorkGuard::Lost::scene)) {
    return false;
  }
  if (!session_->has_unsaved_notes()) {
    return true;
  }
  const auto answer = QMessageBox::question(
      this, tr("Notes"), tr("The notes have not been saved. Save the session?"),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
  if (answer == QMessageBox::Save) {
    files_->choose_session();
  }
  return answer == QMessageBox::Discard || !session_->has_unsaved_notes();
}

void MainWindow::show_failure(const QString& message) { notifier_->show_failure(message); }

bool MainWindow::settled() const {
  const bool idle =
      state_.runner.state() == RunState::paused || state_.runner.state() == RunState::finished;
  return idle && state_.scene.snapshot() && applier_->arrived() && !state_.relighting.busy() &&
         !state_.colors.busy() && !edits_->busy() && !sun_->busy() && page_->sharp()->settled() &&
         !inspection_->busy() && !compare_view_->busy() &&
         (map_dock_->isHidden() || map_view_->up_to_date()) && direction_view_->up_to_date();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (!dropped_file(*event->mimeData()).isEmpty()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QString file = dropped_file(*event->mimeData());
  if (file.isEmpty()) {
    return;
  }
  event->acceptProposedAction();
  // The file is opened later: the program from which it was dragged waits, and opening may ask a
  // question.
  QMetaObject::invokeMethod(
      files_, [this, file] { files_->try_open(file); }, Qt::QueuedConnection);
}

QString MainWindow::close_without_questions() {
  asks_ = false;
  QString written;
  std::exception_ptr failure;
  if (remember_ && session_->has_unsaved_notes()) {
    try {
      written = files_->save_unasked();
    } catch (...) {
      failure = std::current_exception();
    }
  }
  close();
  if (failure) {
    std::rethrow_exception(failure);
  }
  return written;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (remember_ && asks_ && !may_close()) {
    event->ignore();
    return;
  }
  full_screen_.show_all();
  if (remember_) {
    memory_->save();
  }
  QMainWindow::closeEvent(event);
}

}  // namespace transillum::viewer
