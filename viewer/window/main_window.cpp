// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/main_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QTextDocument>
#include <QTimer>
#include <QToolBar>
#include <algorithm>
#include <utility>

#include "directions/direction_view.h"
#include "directions/received_view.h"
#include "lessons/lesson_panel.h"
#include "map/compare_view.h"
#include "map/map_canvas.h"
#include "map/map_view.h"
#include "patches/patch_inspector.h"
#include "scene/color_controls.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "solve/convergence_view.h"
#include "solve/progress_line.h"
#include "solve/settings_panel.h"
#include "solve/solve_actions.h"
#include "solve/solve_summary.h"
#include "solve/study_dialog.h"
#include "stepping/algorithm_view.h"
#include "stepping/breakpoint_panel.h"
#include "stepping/step_actions.h"
#include "stepping/step_panel.h"
#include "stepping/timeline_bar.h"
#include "stepping/timeline_lanes.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/reference_cache.h"
#include "tree/tree_view.h"
#include "widgets/banner.h"
#include "widgets/scrolling.h"
#include "widgets/theme.h"
#include "window/export_actions.h"
#include "window/file_actions.h"
#include "window/help_dialogs.h"
#include "window/inspection_panels.h"
#include "window/key_list.h"
#include "window/setting_list.h"
#include "window/view_state_applier.h"

namespace transillum::viewer {

namespace {

// Raise it when docks come, go or change their names: an old layout is then laid out anew.
constexpr int layout_version = 7;

constexpr PatchId few_patches = 64;

std::string fmt(const char* words, std::size_t number) {
  return QString::fromLatin1(words).arg(number).toStdString();
}

QString dropped_file(const QMimeData& data) {
  const QList<QUrl> urls = data.urls();
  return urls.size() == 1 && urls.front().isLocalFile() ? urls.front().toLocalFile() : QString();
}

}  // namespace

MainWindow::MainWindow(bool remember, QWidget* parent) : QMainWindow(parent), remember_(remember) {
  setWindowTitle(tr("transillum"));
  setAcceptDrops(true);
  actions_ = new SolveActions(this);
  step_actions_ = new StepActions(focus_, selection_, this);
  study_ =
      new StudyDialog(remember ? ReferenceCache::default_folder() : std::filesystem::path(), this);
  inspection_ = new InspectionPanels(selection_, colors_, runner_, this);
  files_ = new FileActions(*this);
  exports_ = new ExportActions(*this);
  make_center();
  make_docks();
  make_menus();
  progress_ = new ProgressLine;
  statusBar()->addWidget(progress_, 1);
  statusBar()->setSizeGripEnabled(false);
  connect_runner();
  breakpoints_.set_undo_stack(&inspection_->edits().undo_stack());
  page_->bookmarks().set_undo_stack(&inspection_->edits().undo_stack());
  stage_ = new ViewStateApplier(*this);
  connect(lesson_panel_, &LessonPanel::page_shown, stage_, &ViewStateApplier::show_page);
  connect(&appearance_, &AppearanceActions::changed, this, [this] {
    if (snapshot_) {
      show_snapshot(snapshot_);
    }
    map_view_->update();
    lesson_panel_->refresh();
    // Once the layouts have heard of the fonts.
    QTimer::singleShot(0, &docks_, &DockLayouts::follow_type);
  });
  restore_layout();
}

MainWindow::~MainWindow() {
  delete inspection_;           // it watches the window's events
  map_dock_->disconnect(this);  // it hides when most of the window is gone
}

void MainWindow::make_center() {
  page_ = new ScenePage(focus_, selection_, colors_);
  scene_view_ = page_->scene_view();
  connect(page_, &ScenePage::open_clicked, files_->open_action(), &QAction::trigger);
  connect(page_, &ScenePage::built_in_clicked, this,
          [this](const QString& name) { open_afresh(name); });
  setCentralWidget(page_);
}

void MainWindow::make_docks() {
  constexpr auto teach = Layout::teach;
  constexpr auto inspect = Layout::inspect, debug = Layout::debug;
  constexpr auto left = Qt::LeftDockWidgetArea, right = Qt::RightDockWidgetArea;
  constexpr auto bottom = Qt::BottomDockWidgetArea;
  settings_ = new SettingsPanel;
  summary_ = new SolveSummary;
  inspector_ = new PatchInspector(selection_, colors_);
  map_view_ = new MapView(focus_, selection_, colors_);
  convergence_view_ = new ConvergenceView(focus_);
  direction_view_ = new DirectionView(focus_, selection_, colors_, visibility_);
  received_view_ = new ReceivedView(focus_, selection_, visibility_);
  compare_view_ = new CompareView(focus_, selection_, colors_);
  algorithm_ = new AlgorithmView(focus_, selection_);
  connect(algorithm_, &AlgorithmView::region_shown, map_view_->canvas(), &MapCanvas::mark_region);
  breakpoint_panel_ = new BreakpointPanel(focus_, selection_, breakpoints_);
  lesson_panel_ = new LessonPanel(built_in_lessons());
  notes_ = new QPlainTextEdit;
  notes_->setObjectName("notes");
  notes_->setPlaceholderText(tr("Words of your own; a session file keeps them"));
  auto* events = new StepPanel(focus_, selection_);
  timeline_ = new TimelineBar(focus_, selection_, *step_actions_);
  timeline_->lanes()->set_marks(
      [this](const MapHistory& history) { return breakpoints_.steps_in(history); });

  docks_.add(tr("Lesson"), "lesson_dock", lesson_panel_, {{teach, left, 700}});
  docks_.add(tr("Notes"), "notes_dock", notes_, {{teach, left, 700, true}});
  docks_.add(tr("Solve settings"), "settings_dock", scrollable(settings_), {{inspect, left, 455}});
  docks_.add(tr("Patch"), "inspector_dock", scrollable(inspector_), {{inspect, left, 345}});
  docks_.add(tr("Figures"), "summary_dock", scrollable(summary_), {{inspect, left, 345, true}});
  inspection_->add_materials_to(docks_);
  map_dock_ = docks_.add(tr("Visibility map"), "map_dock", map_view_,
                         {{teach, right, 400}, {inspect, right, 450}, {debug, right, 480}});
  inspection_->add_tables_to(docks_);
  docks_.add(tr("Compare engines"), "compare_dock", scrollable(compare_view_),
             {{inspect, right, 450, true}});
  docks_.add(tr("Algorithm"), "algorithm_dock", scrollable(algorithm_),
             {{teach, right, 420}, {debug, left, 560}});
  docks_.add(tr("Breakpoints"), "breakpoint_dock", breakpoint_panel_, {{debug, left, 170}});
  docks_.add(tr("Charts"), "convergence_dock", scrollable(convergence_view_),
             {{teach, right, 420, true}, {inspect, right, 400}});
  docks_.add(tr("Directions"), "direction_dock", direction_view_,
             {{teach, right, 420, true}, {inspect, right, 400, true}});
  docks_.add(tr("Events"), "event_dock", events, {{teach, right, 420, true}, {debug, right, 260}});
  docks_.add(tr("BSP tree"), "tree_dock", new TreeView(focus_, selection_),
             {{teach, right, 420, true}, {debug, right, 260, true}});
  docks_.add(tr("Received light"), "received_dock", received_view_,
             {{inspect, right, 400, true}, {debug, right, 260, true}});
  QDockWidget* timeline_dock =
      docks_.add(tr("Timeline"), "timeline_dock", timeline_,
                 {{teach, bottom, 132}, {inspect, bottom, 132}, {debug, bottom, 132}});
  timeline_dock->setTitleBarWidget(new QWidget);  // no room for one on a projector
  connect(page_, &ScenePage::lesson_clicked, this, [this] { lesson_panel_->show_page(0, 0); });
  connect(lesson_panel_, &LessonPanel::open_clicked, this, &MainWindow::choose_lesson);
  connect(settings_, &SettingsPanel::restart_clicked, this, &MainWindow::solve_anew);
  connect(page_, &ScenePage::replicas_requested, this, &MainWindow::solve_with_replicas);
  connect(map_dock_, &QDockWidget::visibilityChanged, this,
          [this] { focus_feed_.set_watched(!map_dock_->isHidden()); });
  connect(&breakpoints_, &Breakpoints::changed, timeline_->lanes(), &TimelineLanes::count_columns);
}

void MainWindow::make_menus() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  fill_open_menu(*file->addMenu(theme::icon(theme::Icon::scene), tr("Built-in scene")));
  file->addAction(page_->scenes_action());
  files_->add_to(*file);
  exports_->add_to(*file->addMenu(tr("Export")));
  file->addSeparator();
  file->addAction(tr("Quit"), this, &QWidget::close, QKeySequence(QStringLiteral("Ctrl+Q")));

  inspection_->add_to(*menuBar());

  QMenu* solve = menuBar()->addMenu(tr("&Solve"));
  actions_->add_to(*solve);
  solve->addSeparator();
  auto* study = new QAction(theme::icon(theme::Icon::study), tr("Study…"), this);
  study->setObjectName("study");
  study->setShortcut(QKeySequence(QStringLiteral("Ctrl+T")));
  study->setToolTip(tr("Error of B against the number of directions (Ctrl+T)"));
  connect(study, &QAction::triggered, study_, &StudyDialog::present);
  solve->addAction(study);

  QMenu* step = menuBar()->addMenu(tr("S&tep"));
  step_actions_->add_to(*step);
  step->addSeparator();
  breakpoint_panel_->add_to(*step);

  lesson_panel_->add_to(*menuBar()->addMenu(tr("&Lesson")));

  QMenu* view = menuBar()->addMenu(tr("&View"));
  docks_.add_to(*view);
  view->addSeparator();
  appearance_.add_to(*view);
  view->addAction(full_screen_.action());
  view->addSeparator();
  view->addMenu(page_->camera_menu());
  view->addAction(tr("Show or hide the direction"), page_->color_controls(),
                  &ColorControls::toggle_direction, QKeySequence(Qt::Key_D));
  view->addAction(
      tr("Stop searching, or select nothing"), this,
      [this] {
        if (focus_.seeking()) {
          focus_.stop();
        } else {
          selection_.select(no_patch);
        }
      },
      QKeySequence(Qt::Key_Escape));

  QMenu* help = menuBar()->addMenu(tr("&Help"));
  QAction* keys = help->addAction(tr("Keys and mouse"), this, [this] { show_keys(*this); });
  keys->setShortcuts({QKeySequence(Qt::Key_Question), QKeySequence(Qt::Key_F1)});
  help->addAction(tr("All settings"), this, [this] { show_settings(*this); });
  help->addAction(tr("About transillum"), this, [this] { show_about(this); });

  auto* bar = new QToolBar(tr("Tools"));
  bar->setObjectName("tool_bar");
  bar->setMovable(false);
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->addAction(page_->scenes_action());
  bar->addAction(files_->open_action());
  bar->addSeparator();
  actions_->add_to(*bar);
  bar->addSeparator();
  bar->addAction(study);
  addToolBar(bar);
}

void MainWindow::fill_open_menu(QMenu& menu) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    const QString name = QString::fromStdString(scene.name);
    menu.addAction(tr("%1 – %2").arg(name, QString::fromStdString(scene.summary)), this,
                   [this, name] { open_afresh(name); });
  }
}

void MainWindow::connect_runner() {
  connect(&runner_, &SolveRunner::state_changed, this, &MainWindow::show_state);
  connect(&runner_, &SolveRunner::scene_loaded, this, &MainWindow::show_loaded);
  connect(&runner_, &SolveRunner::snapshot_ready, this, &MainWindow::show_snapshot);
  connect(&runner_, &SolveRunner::load_progressed, progress_, &ProgressLine::show_loading);
  connect(&runner_, &SolveRunner::failed, this, [this](const QString& message, bool bad_input) {
    show_failure(message);
    emit failed(message, bad_input);
  });
  connect(inspection_, &InspectionPanels::light_changed, this, &MainWindow::show_snapshot);
  connect(inspection_, &InspectionPanels::failed, this, &MainWindow::show_failure);
  connect(&focus_feed_, &FocusFeed::failed, this, &MainWindow::show_failure);
  connect(&visibility_, &PerDirectionVisibility::failed, this, &MainWindow::show_failure);

  connect(actions_, &SolveActions::run, this, &MainWindow::run);
  connect(actions_, &SolveActions::pause, &runner_, &SolveRunner::pause);
  connect(actions_, &SolveActions::one_direction, &runner_, &SolveRunner::advance_one_direction);
  connect(actions_, &SolveActions::one_iteration, &runner_, &SolveRunner::advance_one_iteration);
  connect(actions_, &SolveActions::stop, &runner_, &SolveRunner::stop);
}

void MainWindow::restore_layout() {
  QSize size(1600, 1000);
  // A picture for a script has its size whatever the screen's is.
  if (remember_) {
    size = size.boundedTo(screen()->availableSize());
  }
  resize(size);
  docks_.arrange(Layout::inspect);
  if (!remember_) {
    return;
  }
  QSettings settings;
  breakpoints_.load(settings);
  appearance_.load(settings);
  files_->load(settings);
  restoreGeometry(settings.value("window/geometry").toByteArray());
  // After an update of Qt or of the docks the old state may not fit any more.
  const int layout = settings.value("window/layout", -1).toInt();
  if (!docks_.restore(layout, settings.value("window/state").toByteArray(), layout_version)) {
    docks_.arrange(Layout::inspect);
  }
}

void MainWindow::set_options(const SolveOptions& solve, const SceneOptions& scene) {
  settings_->set_options(solve, scene);
}

void MainWindow::open_afresh(const QString& spec, Goal then) {
  stage_->leave();
  open(spec, then);
}

void MainWindow::open(const QString& spec, Goal then) {
  page_->banner()->dismiss();
  asked_spec_ = spec.toStdString();
  asked_scene_options_ = settings_->scene_options();
  runner_.open({asked_spec_, asked_scene_options_, settings_->solve_options(), then});
}

RunOptions MainWindow::options() const {
  return {settings_->solve_options(), settings_->scene_options()};
}

bool MainWindow::shows(const std::string& spec, const SceneOptions& options) const {
  return loaded_ && spec == spec_ &&
         (loaded_->stored || RunOptions{{}, options} == RunOptions{{}, scene_options_});
}

bool MainWindow::outlined_at_first() const {
  // Few large patches of like brightness run into one another without outlines.
  return loaded_ && loaded_->scene->patch_count() <= few_patches;
}

void MainWindow::choose_lesson() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Open a lesson"), {},
                                                    tr("Lessons (*.json);;All files (*)"));
  if (!path.isEmpty()) {
    open_lesson(path);
  }
}

void MainWindow::open_lesson(const QString& path) {
  try {
    begin_lesson(path.toStdString(), 1);
  } catch (const InputError& error) {
    show_failure(QString::fromStdString(error.what()));
  }
}

void MainWindow::begin_lesson(const std::string& which, int page) {
  bool number = false;
  int lesson = QString::fromStdString(which).toInt(&number) - 1;
  if (!number) {
    Lesson read = read_lesson(which);
    check_panels(read, which, docks_.panels());
    lesson_panel_->add(std::move(read));
    lesson = 0;
  }
  const auto& lessons = lesson_panel_->lessons();
  if (lesson < 0 || lesson >= static_cast<int>(lessons.size())) {
    throw InputError(fmt("there are lessons 1 to %1", lessons.size()));
  }
  const std::size_t pages = at(lessons, lesson).pages.size();
  if (page < 1 || page > static_cast<int>(pages)) {
    throw InputError(fmt("the lesson has pages 1 to %1", pages));
  }
  page_->banner()->dismiss();
  lesson_panel_->show_page(lesson, page - 1);
}

void MainWindow::show_session(const Session& session) {
  page_->banner()->dismiss();
  stage_->show(session.state);
  if (session.state.layout && !session.docks.isEmpty()) {
    docks_.restore(static_cast<int>(*session.state.layout), session.docks, layout_version);
  }
  breakpoints_.set_list(session.breakpoints);
  page_->bookmarks().set(session.kept_views);
  inspection_->edits().undo_stack().clear();
  notes_->setPlainText(QString::fromStdString(session.notes));
}

Session MainWindow::current_session() const {
  return {stage_->state(), breakpoints_.list(), page_->bookmarks().all(),
          notes_->toPlainText().toStdString(), saveState(layout_version)};
}

void MainWindow::keep_notes() { notes_->document()->setModified(false); }

bool MainWindow::notes_may_go() {
  if (!notes_->document()->isModified() || notes_->document()->isEmpty()) {
    return true;
  }
  const auto answer = QMessageBox::question(
      this, tr("Notes"), tr("The notes are in no session's file yet. Save the session?"),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
  if (answer == QMessageBox::Save) {
    files_->choose_session();
  }
  return answer == QMessageBox::Discard || !notes_->document()->isModified();
}

bool MainWindow::at_start() const {
  return !snapshot_ || (snapshot_->progress.iteration == 0 && snapshot_->progress.direction == 0);
}

void MainWindow::run() {
  // Before the first direction, the panel's settings still count.
  if (at_start() && settings_->differ_from_effect()) {
    solve_anew();
  } else {
    runner_.run();
  }
}

void MainWindow::solve_anew() {
  if (!loaded_) {
    return;
  }
  page_->banner()->dismiss();
  const SceneOptions scene = settings_->scene_options();
  if (shows(spec_, scene)) {
    runner_.restart(settings_->solve_options(), {Goal::Kind::finished});
  } else {
    open(QString::fromStdString(spec_));
  }
}

void MainWindow::solve_with_replicas() {
  constexpr int enough = 8;
  SolveOptions solve = settings_->solve_options();
  solve.directions = std::max(solve.directions, enough);
  solve.replicas = enough;
  set_options(solve, settings_->scene_options());
  solve_anew();
}

void MainWindow::show_loaded(std::shared_ptr<const LoadedScene> loaded) {
  loaded_ = std::move(loaded);
  snapshot_ = nullptr;
  spec_ = asked_spec_;
  scene_options_ = loaded_->stored ? loaded_->scene->options() : asked_scene_options_;
  settings_->set_scene_fixed(loaded_->stored != nullptr);
  if (loaded_->stored) {
    settings_->set_options(settings_->solve_options(), scene_options_);
  }
  selection_.select(no_patch);
  focus_feed_.clear();
  inspection_->show_scene(*loaded_);
  map_view_->clear();
  direction_view_->clear();
  received_view_->clear();
  compare_view_->clear();
  page_->show_scene();
  scene_view_->show_scene(loaded_);
  page_->color_controls()->set_outlines(outlined_at_first());
  progress_->show_scene(*loaded_);
  study_->show_scene(loaded_);
  const std::string& file = loaded_->stored ? loaded_->file : loaded_->scene->name();
  const QString name = QFileInfo(QString::fromStdString(file)).fileName();
  setWindowTitle(tr("%1 – transillum").arg(name));

  QStringList warnings;
  for (const std::string& warning : loaded_->scene->report().warnings) {
    warnings << QString::fromStdString(warning);
  }
  if (warnings.isEmpty()) {
    page_->banner()->dismiss();
  } else {
    page_->banner()->say(
        Banner::Kind::warning,
        warnings.size() == 1
            ? warnings.front()
            : tr("%1 (and %2 more)").arg(warnings.front()).arg(warnings.size() - 1),
        warnings.join('\n'));
  }
  emit scene_shown();
}

void MainWindow::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  if (snapshot->loaded != loaded_) {
    return;
  }
  QElapsedTimer timer;
  timer.start();
  snapshot_ = inspection_->lit(std::move(snapshot));
  settings_->set_in_effect(snapshot_->options, scene_options_);
  study_->set_solve(snapshot_->options);
  colors_.fit(snapshot_);
  scene_view_->show_snapshot(snapshot_);
  map_view_->show_snapshot(snapshot_);
  convergence_view_->show_snapshot(*snapshot_);
  direction_view_->show_snapshot(snapshot_);
  received_view_->show_snapshot(snapshot_);
  compare_view_->show_snapshot(snapshot_);
  inspector_->show_snapshot(snapshot_);
  inspection_->show_snapshot(snapshot_);
  algorithm_->show_snapshot(snapshot_);
  summary_->show_snapshot(*snapshot_);
  progress_->show_snapshot(snapshot_);
  actions_->show_state(runner_.state(), at_start());
  timeline_->show_snapshot(*snapshot_);
  focus_feed_.show_snapshot(snapshot_);
  // A large scene is refreshed less often, so that the window has time for its user.
  runner_.set_refresh_interval(std::clamp(static_cast<int>(4 * timer.elapsed()), 66, 1500));
  emit snapshot_shown();
}

void MainWindow::show_state(RunState state) {
  progress_->show_state(state);
  actions_->show_state(state, at_start());
  scene_view_->set_smooth(state != RunState::running);
  settings_->set_restart_enabled(loaded_ && state != RunState::loading);
}

bool MainWindow::settled() const {
  const bool resting =
      runner_.state() == RunState::paused || runner_.state() == RunState::finished;
  return resting && snapshot_ && stage_->arrived() && inspection_->up_to_date() &&
         (map_dock_->isHidden() || map_view_->up_to_date()) && direction_view_->up_to_date();
}

QString MainWindow::banner_text() const { return page_->banner()->text(); }

void MainWindow::say_written(const QString& path) {
  constexpr int ms = 5000;
  statusBar()->showMessage(tr("Written: %1").arg(path), ms);
}

void MainWindow::show_failure(const QString& message) {
  page_->banner()->say(Banner::Kind::error, message);
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
  files_->try_open(file);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (remember_ && !notes_may_go()) {
    event->ignore();
    return;
  }
  full_screen_.show_all();
  if (remember_) {
    QSettings settings;
    settings.setValue("window/geometry", saveGeometry());
    settings.setValue("window/state", saveState(layout_version));
    breakpoints_.save(settings);
    appearance_.save(settings);
    files_->save(settings);
    settings.setValue("window/layout", static_cast<int>(docks_.current()));
  }
  QMainWindow::closeEvent(event);
}

}  // namespace transillum::viewer
