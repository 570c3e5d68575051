// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Session files in the viewer's window: saving, opening and errors; recent files; exports.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QImageReader>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QSlider>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <QUrl>
#include <algorithm>
#include <cmath>

#include "lessons/session_file.h"
#include "scene/scene_page.h"
#include "scene/show_menu.h"
#include "solved_window.h"
#include "stepping/algorithm_view.h"
#include "stepping/play_control.h"
#include "widgets/banner.h"
#include "window/export_actions.h"
#include "window/file_actions.h"
#include "window/frame_recorder.h"
#include "window/inspection_panels.h"
#include "window/recovery.h"
#include "window/view_state_applier.h"
#include "window/window_session.h"
#include "window/work_guard.h"

namespace transillum::viewer::session_file_test {

using namespace test;

namespace {

const char* const triangle_room =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

void write(const QString& path, const QByteArray& text) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(text);
}

QByteArray contents(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

bool settles(TestWindow& window) {
  return wait_for([&] { return window.settled(); });
}

}  // namespace

class SessionFileTest : public QObject {
  Q_OBJECT

  // Colors, materials and overlays that differ from the defaults.
  static void change_appearance(TestWindow& window) {
    window.colors.set_mode(ColorMode::luminance);
    window.colors.set_range(0.25, 4);
    window.colors.set_gamma(1.8);
    MaterialEdits& edits = window.relighting.edits();
    const std::string wall = "material:" + window.snapshot()->loaded->scene->material(0).name;
    edits.set_exitance(wall, {2, 3, 4});
    edits.set_reflectance(wall, {0.1, 0.25, 0.625});
    edits.set_exitance("face:1", {5, 6, 7});
    window.colors.set_exposure(-2);
    ShowMenu& show = *window.findChild<ShowMenu*>();
    show.overlay(Overlay::normals)->setChecked(true);
    show.overlay(Overlay::wireframe)->setChecked(true);
  }
  static std::vector<Breakpoint> breakpoints() {
    using Kind = Condition::Kind;
    return {{{Kind::pair, 3, 4}, false},
            {{Kind::cut, 7},
             true,
             {{false, {Kind::small_fragment, 0, 0, 0.25}}, {true, {Kind::patch, 2}}},
             9}};
  }
  static void check_appearance(TestWindow& window) {
    QVERIFY(window.colors.scale().mode == ColorMode::luminance);
    QVERIFY(window.colors.range_rule() == RangeRule::fixed);
    QCOMPARE(window.colors.scale().low, 0.25);
    QCOMPARE(window.colors.scale().high, 4.0);
    QCOMPARE(window.colors.scale().gamma, 1.8);
    QCOMPARE(window.colors.scale().exposure, -2.0);
    QVERIFY(!window.colors.exposure_is_automatic());
    const std::vector<MaterialChange> materials = window.relighting.edits().changes();
    QCOMPARE(materials.size(), std::size_t{2});
    QCOMPARE(materials[0].target, "material:" + window.snapshot()->loaded->scene->material(0).name);
    QVERIFY((materials[0].exitance == Rgb{2, 3, 4}));
    QVERIFY((materials[0].reflectance == Rgb{0.1, 0.25, 0.625}));
    QCOMPARE(materials[1].target, std::string("face:1"));
    QVERIFY((materials[1].exitance == Rgb{5, 6, 7}) && !materials[1].reflectance);
    const ShowMenu& show = *window.findChild<ShowMenu*>();
    for (const Overlay overlay : all_overlays) {
      QCOMPARE(show.overlay(overlay)->isChecked(),
               overlay == Overlay::normals || overlay == Overlay::wireframe);
    }
  }

 private slots:
  void a_saved_session_is_restored() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("mine.json");
    ViewPoint camera;
    {
      SolvedWindow solved("furnace");
      QVERIFY(solved.ready);
      TestWindow& window = *solved.window;
      window.selection.select(7);
      window.focus.go_to({0, 5, 3});
      QVERIFY(settles(window));
      window.focus.set_phase(Phase::split);
      window.breakpoints.set_list(breakpoints());
      window.watches.add({Watch::Kind::closure_defect});
      window.watches.add({Watch::Kind::patch_area, 7});
      window.findChild<QPlainTextEdit*>("notes")->setPlainText("mind the \"gap\"\nω");
      change_appearance(window);
      window.parts().algorithm.set_kind(MapKind::global);
      camera = solved.scene_view->view_point();
      window.parts().page.bookmarks().add(camera, "the \"first\" one");
      camera.eye.x += 1;
      solved.scene_view->set_view_point(camera);
      window.files().save_session(path);
    }
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QCOMPARE(window->scene.spec(), std::string("furnace"));
    QCOMPARE(window->snapshot()->options.directions, 32);
    QCOMPARE(window->selection.patch(), PatchId{7});
    const RunPosition there{0, 5, 3};
    QVERIFY(window->focus.position() == there);
    QVERIFY(window->focus.phase() == Phase::split);
    QVERIFY(window->breakpoints.list() == breakpoints());
    const std::vector<Watch> watches{{Watch::Kind::closure_defect}, {Watch::Kind::patch_area, 7}};
    QVERIFY(window->watches.list() == watches);
    QCOMPARE(window->findChild<QPlainTextEdit*>("notes")->toPlainText(),
             QString("mind the \"gap\"\nω"));
    QCOMPARE(window->findChild<SceneView*>()->view_point().eye.x, camera.eye.x);
    check_appearance(*window);
    QVERIFY(window->parts().algorithm.kind() == MapKind::global);
    const auto& views = window->parts().page.bookmarks().all();
    QCOMPARE(views.size(), std::size_t{1});
    QCOMPARE(views[0].name, QString("the \"first\" one"));
    QCOMPARE(views[0].view.eye.x, camera.eye.x - 1);
    QVERIFY(!window->findChild<QAction*>("undo")->isEnabled());
  }

  void a_session_keeps_selected_and_hidden_patches_and_the_clipping_plane() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("cut.json");
    const std::vector<PatchId> selected{3, 4, 5, 7}, hidden{0, 1, 2, 5, 9};
    const ClipPlane clip{ClipPlane::Axis::y, 0.25, true};
    {
      SolvedWindow solved("furnace");
      QVERIFY(solved.ready);
      solved.window->selection.select(7);
      solved.window->selection.select_all(selected);
      solved.window->parts().page.hidden().hide(hidden);
      solved.window->findChild<QComboBox*>("clip_axis")->setCurrentIndex(2);
      solved.window->findChild<QSlider*>("clip_place")->setValue(50);
      solved.window->findChild<QCheckBox*>("clip_other_side")->setChecked(true);
      solved.window->files().save_session(path);
      QVERIFY(contents(path).contains("hidden"));
    }
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QCOMPARE(window->selection.patch(), PatchId{7});
    QVERIFY(window->selection.patches() == selected);
    const HiddenPatches& left_out = window->parts().page.hidden();
    for (PatchId i = 0; i < window->scene.loaded()->scene->patch_count(); ++i) {
      QCOMPARE(left_out.hidden(i), std::count(hidden.begin(), hidden.end(), i) > 0);
    }
    QVERIFY(window->applier().state().clip == clip);
    // A session without these keys shows everything.
    write(path, R"({"show": {"scene": "furnace", "options": {"directions": 32}}})");
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY(!left_out.any() && !window->applier().state().clip);
    QVERIFY(window->selection.patches().empty());
  }

  void patches_that_the_scene_lacks_are_reported() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("many.json");
    write(path, R"({"show": {"scene": "cornell-box", "options": {"directions": 16}, "select": 1,
                             "also-selected": [3, [5, 7]], "hidden": [2, [4, 1073741824]]}})");
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY2(window->banner_text().startsWith("hidden: there is no patch 1073741824; the scene"),
             qPrintable(window->banner_text()));
    const std::vector<PatchId> selected{1, 3, 5, 6, 7};
    QVERIFY(window->selection.patches() == selected);
    QVERIFY(!window->parts().page.hidden().hidden(3));
    QVERIFY(window->parts().page.hidden().hidden(4));
  }

  void a_locked_range_keeps_its_ends() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("locked.json");
    {
      SolvedWindow solved("furnace");
      QVERIFY(solved.ready);
      solved.window->colors.set_mode(ColorMode::luminance);
      solved.window->colors.widen_from(-3, 70);
      solved.window->files().save_session(path);
    }
    const auto window = make_window(16);
    window->open("boards");
    QVERIFY(settles(*window));
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY(window->colors.range_rule() == RangeRule::widening);
    QCOMPARE(window->colors.scale().low, -3.0);
    QCOMPARE(window->colors.scale().high, 70.0);
  }

  void a_session_of_an_older_version_opens() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("old.json");
    write(path, R"({"show": {"scene": "furnace", "options": {"directions": 16},
                             "colors": {"show": "luminance", "range": [1, 2]}}})");
    const auto window = make_window(16);
    window->parts().page.bookmarks().add({});
    window->files().open(path);
    QVERIFY(settles(*window));
    QCOMPARE(window->colors.scale().low, 1.0);
    QVERIFY(window->parts().page.bookmarks().all().empty());
    QVERIFY(window->colors.exposure_is_automatic());
  }

  void a_damaged_layout_is_not_restored() {
    const auto window = make_window(16);
    DockLayouts& docks = window->parts().docks;
    const int layout = static_cast<int>(docks.current());
    const QByteArray saved = docks.state();
    QVERIFY(docks.restore(layout, saved));
    for (int k = 0; k < saved.size(); ++k) {
      QByteArray damaged = saved;
      damaged[k] = static_cast<char>(damaged[k] ^ 1);
      QVERIFY2(!docks.restore(layout, damaged), qPrintable(QString::number(k)));
      QVERIFY(!docks.restore(layout, saved.left(k)));
    }
    QVERIFY(!docks.restore(layout, window->saveState()));
    QVERIFY(docks.restore(layout, saved));
  }

  void a_session_with_a_damaged_layout_opens_with_a_warning() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("damaged.json");
    write(path, R"({"show": {"scene": "furnace", "options": {"directions": 16}, "layout": "debug"},
                    "docks": "AAAA/wAAAAf9AAAAAwAAAAAAAAFe"})");
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY2(window->banner_text().startsWith("docks: damaged"), qPrintable(window->banner_text()));
    QVERIFY(window->parts().docks.current() == Layout::debug);
    QVERIFY(window->findChild<QDockWidget*>("algorithm_dock")->isVisible());
  }

  void a_position_that_cannot_be_reached_is_reported_data() {
    QTest::addColumn<QByteArray>("show");
    QTest::addColumn<QString>("expected");
    QTest::newRow("iteration, paused")
        << QByteArray(R"("scene": "furnace", "options": {"directions": 16}, "solve": 3,
                         "focus": {"iteration": 15})")
        << "focus: there is no iteration 15; the run has 1 to 1";
    QTest::newRow("iteration, nothing solved")
        << QByteArray(R"("scene": "furnace", "options": {"directions": 16}, "solve": 0,
                         "focus": {"iteration": 2})")
        << "focus: there is no iteration 2; the run has 1 to 1";
    QTest::newRow("iteration, finished")
        << QByteArray(R"("scene": "furnace", "options": {"directions": 16, "iterations": 2},
                         "focus": {"iteration": 3})")
        << "focus: there is no iteration 3; the run has 1 to 2";
    QTest::newRow("direction")
        << QByteArray(R"("scene": "furnace", "options": {"directions": 16}, "solve": 20,
                         "focus": {"iteration": 2, "direction": 17})")
        << "focus: there is no direction 17; the run has 1 to 16";
    QTest::newRow("selected patch")
        << QByteArray(R"("scene": "furnace", "options": {"directions": 16}, "select": 12)")
        << "select: there is no patch 12; the scene has 0 to 11";
    QTest::newRow("no scene") << QByteArray(R"("focus": {"iteration": 3})")
                              << "scene: is missing, and no scene is open";
  }
  void a_position_that_cannot_be_reached_is_reported() {
    QFETCH(const QByteArray, show);
    QFETCH(const QString, expected);
    const QTemporaryDir folder;
    const QString path = folder.filePath("far.json");
    write(path, R"({"show": {)" + show + "}}");
    const auto window = make_window(16);
    const auto& applier = *window->findChild<ViewStateApplier*>();
    QStringList messages;
    connect(&applier, &ViewStateApplier::unreachable, this,
            [&](const QString& message) { messages << message; });
    window->files().open(path);
    QVERIFY(wait_for([&] { return !messages.isEmpty() && applier.arrived(); }));
    QCOMPARE(messages, QStringList{expected});
    QCOMPARE(window->banner_text(), expected);
  }

  // Until the iteration begins, each snapshot would undo what the user does.
  void waiting_for_an_iteration_leaves_the_view_alone() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("long.json");
    write(path, R"({"show": {"scene": "furnace", "options": {"directions": 1000000},
                             "focus": {"iteration": 2}, "select": 1}})");
    const auto window = make_window(16);
    int snapshots = 0;
    connect(&window->scene, &OpenScene::snapshot_shown, this, [&] { ++snapshots; });
    window->files().open(path);
    QVERIFY(wait_for([&] { return window->selection.patch() == 1; }));
    window->selection.select(3);
    const int before = snapshots;
    QVERIFY(wait_for([&] { return snapshots >= before + 3; }));
    QVERIFY(!window->findChild<ViewStateApplier*>()->arrived());
    QCOMPARE(window->selection.patch(), PatchId{3});
  }

  void a_scene_without_a_snapshot_is_saved_and_reloaded_by_its_name() {
    const auto window = make_window(24);
    auto& applier = *window->findChild<ViewStateApplier*>();
    int scenes = 0;
    ViewState state;
    connect(&window->scene, &OpenScene::scene_shown, this, [&] {
      QVERIFY(!window->snapshot());
      if (++scenes == 1) {
        state = applier.state();
        window->findChild<QAction*>("reload")->trigger();
      }
    });
    window->open("furnace");
    QVERIFY(wait_for([&] { return scenes == 2; }));
    QVERIFY(settles(*window));
    QCOMPARE(state.scene, std::string("furnace"));
    QCOMPARE(state.options.solve.directions, 24);
    QCOMPARE(window->scene.spec(), std::string("furnace"));
    QCOMPARE(window->snapshot()->options.directions, 24);
  }

  void notes_survive_a_signal() {
    const QTemporaryDir folder;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder.path());
    QCoreApplication::setOrganizationName("transillum");
    QString path;
    {
      SharedState state;
      MainWindow window(state, true);
      window.show();
      auto* notes = window.findChild<QPlainTextEdit*>("notes");
      QTest::keyClicks(notes, "to be kept");
      path = window.close_without_questions();
      QVERIFY(!window.isVisible());
    }
    QVERIFY2(QFile::exists(path), qPrintable(path));
    const Session session = session_from_text(contents(path).toStdString(), "s.json", "");
    QCOMPARE(session.notes, std::string("to be kept"));
    QVERIFY(QSettings().contains("window/state"));
    QVERIFY(QFile::remove(path));
  }

  // The panels of the first scene made the window of a small screen larger than the screen.
  void a_window_larger_than_the_screen_fits_it_once_a_scene_is_open() {
    const QTemporaryDir folder;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder.path());
    QCoreApplication::setOrganizationName("transillum");
    SharedState state;
    MainWindow window(state, true);
    window.show();
    const QSize screen = window.screen()->availableSize();
    window.resize(screen + QSize(0, 60));
    QCoreApplication::processEvents();
    QCOMPARE(window.height(), screen.height() + 60);
    state.scene.open("furnace", RunOptions{}, {Goal::Kind::iteration});
    QVERIFY(wait_for([&] { return state.scene.snapshot() != nullptr; }));
    QVERIFY(wait_for([&] { return window.height() <= screen.height(); }, 5000));
    QFile::remove(window.close_without_questions());
  }

  void goes_on_where_a_killed_program_was_data() {
    QTest::addColumn<int>("passes");
    QTest::newRow("finished") << 0;
    QTest::newRow("paused") << 21;
  }
  void goes_on_where_a_killed_program_was() {
    QFETCH(int, passes);
    const QTemporaryDir folder;
    const QString kept = folder.filePath("killed.json");
    std::vector<Rgb> radiosity;
    {
      const auto window = make_window(16);
      WindowSession session(window->frame(), window->parts().docks, window->parts().notes,
                            window->applier());
      Recovery recovery(window->frame(), session, folder.path());
      recovery.keep();
      QVERIFY(QDir(folder.path()).entryList({"*.json"}).isEmpty());
      window->open("cornell-box",
                   passes > 0 ? Goal{Goal::Kind::passes, passes} : Goal{Goal::Kind::finished});
      QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
      window->selection.select(5);
      recovery.keep();
      const QStringList files = QDir(folder.path()).entryList({"*.json"});
      QCOMPARE(files.size(), 1);
      // A program that is killed leaves its file, and a lock that nothing holds.
      QVERIFY(QFile::copy(folder.filePath(files[0]), kept));
      radiosity = window->snapshot()->radiosity;
    }
    QCOMPARE(QDir(folder.path()).entryList({"*.json"}), QStringList("killed.json"));

    const auto window = make_window(8);
    WindowSession session(window->frame(), window->parts().docks, window->parts().notes,
                          window->applier());
    Recovery recovery(window->frame(), session, folder.path());
    auto* bar = window->findChild<Banner*>("recovery_bar");
    QVERIFY(bar->isHidden());
    recovery.offer();
    QVERIFY(!bar->isHidden());
    window->findChild<QPushButton*>("restore_session")->click();
    QVERIFY(bar->isHidden());
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    QVERIFY(window->snapshot()->radiosity == radiosity);
    QCOMPARE(window->selection.patch(), 5);
    QVERIFY(!QFile::exists(kept));
  }

  void every_kept_session_is_offered_until_it_is_discarded() {
    const QTemporaryDir folder;
    for (const char* name : {"one.json", "two.json"}) {
      write(folder.filePath(name), "{}");
    }
    const auto window = make_window(8);
    WindowSession session(window->frame(), window->parts().docks, window->parts().notes,
                          window->applier());
    Recovery recovery(window->frame(), session, folder.path());
    recovery.offer();
    auto* bar = window->findChild<Banner*>("recovery_bar");
    for (const int left : {2, 1}) {
      QCOMPARE(QDir(folder.path()).entryList({"*.json"}).size(), left);
      QVERIFY(!bar->isHidden());
      window->findChild<QPushButton*>("discard_session")->click();
    }
    QVERIFY(bar->isHidden());
    QVERIFY(QDir(folder.path()).entryList({"*.json"}).isEmpty());
  }

  void the_session_of_a_running_program_is_not_offered() {
    const QTemporaryDir folder;
    const auto window = make_window(8), other = make_window(8);
    WindowSession session(window->frame(), window->parts().docks, window->parts().notes,
                          window->applier());
    Recovery recovery(window->frame(), session, folder.path());
    window->open("cornell-box");
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    recovery.keep();
    WindowSession other_session(other->frame(), other->parts().docks, other->parts().notes,
                                other->applier());
    Recovery other_recovery(other->frame(), other_session, folder.path());
    other_recovery.offer();
    QVERIFY(other->findChild<Banner*>("recovery_bar")->isHidden());
    QCOMPARE(QDir(folder.path()).entryList({"*.json"}).size(), 1);
  }

  void asks_before_long_work_is_lost() {
    const auto window = make_window(8);
    window->open("cornell-box");
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    window->work_guard().set_long_seconds(0);
    QString answer = "Cancel";
    int asked = 0;
    QTimer answers;
    connect(&answers, &QTimer::timeout, window.get(), [&] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        ++asked;
        for (QAbstractButton* button : box->buttons()) {
          if (button->text().remove('&') == answer) {
            button->click();
            return;
          }
        }
      }
    });
    answers.start(20);
    window->findChild<QAction*>("stop")->trigger();
    QCOMPARE(asked, 1);
    QVERIFY(window->snapshot()->progress.iteration > 0);
    answer = "Start over";
    window->findChild<QAction*>("stop")->trigger();
    QVERIFY(wait_for([&] { return window->snapshot()->progress.iteration == 0; }));
    // Nothing is lost now.
    window->findChild<QAction*>("stop")->trigger();
    QCOMPARE(asked, 2);
  }

  void asks_before_another_scene_replaces_long_work_data() {
    QTest::addColumn<QString>("way");
    QTest::addColumn<QString>("button");
    QTest::newRow("solve again") << "restart"
                                 << "Solve again";
    QTest::newRow("reload") << "reload"
                            << "Reload";
    QTest::newRow("a built-in scene") << "built-in"
                                      << "Open";
    QTest::newRow("a dropped scene") << "room.obj"
                                     << "Open";
    QTest::newRow("a dropped session") << "session.json"
                                       << "Open";
    QTest::newRow("a lesson") << "lesson_next"
                              << "Begin the lesson";
    QTest::newRow("a kept session") << "restore_session"
                                    << "Continue";
  }

  // Each way to lose a long solve asks once; Cancel keeps the solve, the button loses it.
  void asks_before_another_scene_replaces_long_work() {
    QFETCH(QString, way);
    QFETCH(QString, button);
    const QTemporaryDir folder, kept_sessions;
    write(folder.filePath("room.obj"), triangle_room);
    write(folder.filePath("session.json"), R"({"show": {"scene": "furnace"}})");
    write(kept_sessions.filePath("killed.json"), R"({"show": {"scene": "furnace"}})");
    const auto window = make_window(8);
    WindowSession session(window->frame(), window->parts().docks, window->parts().notes,
                          window->applier());
    Recovery recovery(window->frame(), session, kept_sessions.path());
    recovery.offer();
    window->open("cornell-box");
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    // Each run has its own list.
    const auto run = window->snapshot()->kept_directions.front();
    window->work_guard().set_long_seconds(0);
    const auto go = [&] {
      if (auto* action = window->findChild<QAction*>(way)) {
        action->trigger();
      } else if (auto* clicked = window->findChild<QPushButton*>(way)) {
        clicked->click();
      } else if (way == "built-in") {
        const auto actions = window->menuBar()->findChildren<QAction*>();
        const auto scene = std::find_if(actions.begin(), actions.end(), [](const QAction* one) {
          return one->text().startsWith("furnace");
        });
        QVERIFY(scene != actions.end());
        (*scene)->trigger();
      } else {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(folder.filePath(way))});
        QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(window.get(), &enter);
        QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(window.get(), &drop);
      }
    };
    QString answer = "Cancel";
    int asked = 0;
    QTimer answers;
    connect(&answers, &QTimer::timeout, window.get(), [&] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (!box || box->objectName() != "long_work") {
        return;
      }
      for (QAbstractButton* choice : box->buttons()) {
        if (choice->text().remove('&') == answer) {
          ++asked;
          choice->click();
          return;
        }
      }
    });
    answers.start(20);
    go();
    QVERIFY(wait_for([&] { return asked == 1; }));
    QCoreApplication::processEvents();
    QVERIFY(!window->scene.is_opening());
    QVERIFY(window->snapshot()->kept_directions.front() == run);
    answer = button;
    go();
    QVERIFY(wait_for([&] { return asked == 2; }));
    QVERIFY(wait_for(
        [&] { return window->snapshot() && window->snapshot()->kept_directions.front() != run; }));
  }

  void a_session_and_its_scene_move_together() {
    const QTemporaryDir folder;
    write(folder.filePath("room.obj"), triangle_room);
    Session session;
    session.state.scene = folder.filePath("room.obj").toStdString();
    const std::string text = to_text(session, folder.path().toStdString());
    QVERIFY(text.find(folder.path().toStdString()) == std::string::npos);
    const QTemporaryDir other;
    write(other.filePath("room.obj"), triangle_room);
    const Session read = session_from_text(text, "s.json", other.path().toStdString());
    QCOMPARE(QString::fromStdString(read.state.scene), other.filePath("room.obj"));
  }

  void errors_name_file_and_key_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("expected");
    QTest::newRow("no JSON") << "{"
                             << "bad.json, line 1";
    QTest::newRow("neither") << "{}"
                             << "neither a session";
    QTest::newRow("a list") << "[1]"
                            << "neither a session";
    QTest::newRow("scene") << R"({"show": {"scene": 1}})"
                           << "bad.json, show, scene";
    QTest::newRow("material") << R"({"show": {"materials": [{"name": "x", "exitance": [1, 1, 1],
                                     "reflectance": [0, 0.5, 1]}]}})"
                              << "material 1, reflectance";
    QTest::newRow("kind") << R"({"show": {}, "breakpoints": [{"kind": "x"}]})"
                          << "breakpoint 1, kind";
    QTest::newRow("patch") << R"({"show": {}, "breakpoints": [{"kind": "cut", "patch": -1}]})"
                           << "breakpoint 1, patch";
    QTest::newRow("hit") << R"({"show": {}, "breakpoints": [{"kind": "cut", "stop-at": 0}]})"
                         << "breakpoint 1, stop-at";
    QTest::newRow("join")
        << R"({"show": {}, "breakpoints": [{"kind": "cut", "further": [{"kind": "cut"}]}]})"
        << "breakpoint 1, condition 1, join: must be \"and\" or \"or\"";
    QTest::newRow("watch") << R"({"show": {}, "watches": [{"kind": "map-size", "patch": 1}]})"
                           << "watch 1: unknown key";
    QTest::newRow("watches") << R"({"show": {}, "watches": [)" +
                                    QString(R"({"kind": "map-size"},)").repeated(6) +
                                    R"({"kind": "map-size"}]})"
                             << "watches: must be a list of at most 6";
    QTest::newRow("view") << R"({"show": {}, "kept-views": [{"name": "x"}]})"
                          << "saved view 1, camera";
    QTest::newRow("notes") << R"({"show": {}, "notes": []})"
                           << "bad.json, notes";
    QTest::newRow("key") << R"({"show": {}, "note": ""})"
                         << "\"note\"";
    QTest::newRow("number") << R"({"show": {"scene": "cornell-box"}, "notes": 1e999})"
                            << "line 1, column 50: the number `1e999` is out of range";
    QTest::newRow("twice") << R"({"show": {}, "notes": "a", "notes": "b"})"
                           << "the key `notes` occurs twice";
    QTest::newRow("deep") << R"({"show": {}, "notes": )" + QString(2'000'000, '[')
                          << "more than 64 lists and objects";
    QTest::newRow("hidden") << R"({"show": {"hidden": 3}})"
                            << "bad.json, show, hidden: must be a list of patches";
    QTest::newRow("hidden twice") << R"({"show": {"hidden": [[3, 5], 5]}})"
                                  << "show, hidden, item 2: patches must ascend";
    QTest::newRow("hidden pair") << R"({"show": {"hidden": [7, [9, 8]]}})"
                                 << "show, hidden, item 2: patches must ascend";
    QTest::newRow("hidden patch") << R"({"show": {"hidden": [[3, 1e10]]}})"
                                  << "show, hidden, item 1: must be a patch, or a pair";
    QTest::newRow("hidden list") << R"({"show": {"hidden": [0)" + QString(",0").repeated(100'000) +
                                        "]}}"
                                 << "show, hidden: must be a list of at most 100000";
    QTest::newRow("alone") << R"({"show": {"also-selected": [1]}})"
                           << "also-selected: requires \"select\"";
    QTest::newRow("axis") << R"({"show": {"clip": {"axis": "w"}}})"
                          << "show, clip, axis: must be one of \"x\", \"y\", \"z\"";
    QTest::newRow("no axis") << R"({"show": {"clip": {}}})"
                             << "show, clip, axis: is missing";
    QTest::newRow("place") << R"({"show": {"clip": {"axis": "x", "place": 1.1}}})"
                           << "show, clip, place: must be from 0 to 1";
    QTest::newRow("many") << R"({"show": {}, "breakpoints": [0)" + QString(",0").repeated(1000) +
                                 "]}"
                          << "breakpoints: must be a list of at most 1000";
  }
  void errors_name_file_and_key() {
    QFETCH(QString, text);
    QFETCH(QString, expected);
    const QTemporaryDir folder;
    const QString path = folder.filePath("bad.json");
    write(path, text.toUtf8());
    const auto window = make_window();
    window->files().try_open(path);
    QVERIFY2(window->banner_text().contains(expected), qPrintable(window->banner_text()));
    QVERIFY(!window->snapshot());
  }

  void what_is_no_text_file_is_refused() {
    const QTemporaryDir folder;
    QVERIFY(QDir(folder.path()).mkdir("folder.json"));
    QVERIFY(QFile::link("/dev/zero", folder.filePath("endless.json")));
    write(folder.filePath("zero.json"), QByteArray("{\0}", 3));
    write(folder.filePath("utf16.json"), QByteArray("\xff\xfe{\0}\0", 6));
    const auto window = make_window();
    for (const char* name : {"folder.json", "endless.json", "zero.json", "utf16.json"}) {
      window->files().try_open(folder.filePath(name));
      QVERIFY2(window->banner_text().contains(name), qPrintable(window->banner_text()));
      QVERIFY(!window->snapshot());
    }
    QVERIFY(window->banner_text().contains("UTF-16"));
  }

  void a_byte_order_mark_is_accepted() {
    const Session session =
        session_from_text("\xef\xbb\xbf{\"show\": {}, \"notes\": \"ω\"}", "s.json", "");
    QCOMPARE(session.notes, std::string("ω"));
  }

  void recent_files_are_listed() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("room.obj");
    write(path, triangle_room);
    const auto window = make_window(4);
    window->files().open(path);
    QVERIFY(wait_for([&] { return window->snapshot() != nullptr; }));
    QCOMPARE(window->files().recent(), QStringList{path});
    window->files().open("furnace");
    QVERIFY(wait_for([&] { return window->scene.spec() == "furnace"; }));
    QCOMPARE(window->files().recent(), QStringList{path});  // built-in scenes are not listed
  }

  void a_file_that_changes_is_read_again() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("room.obj");
    write(path, triangle_room);
    const auto window = make_window(4);
    window->files().open(path);
    QVERIFY(settles(*window) && window->snapshot()->radiosity.size() == 4);
    window->selection.select(2);
    window->findChild<QAction*>("watch")->setChecked(true);
    // Replaces the file like programs that write a new file and rename it.
    write(path + ".new", QByteArray(triangle_room) + "f 1 2 3\n");
    QVERIFY(QFile::remove(path) && QFile::rename(path + ".new", path));
    QVERIFY(wait_for([&] { return window->snapshot()->radiosity.size() == 5; }, 10000));
    QVERIFY(settles(*window));
    QCOMPARE(window->selection.patch(), PatchId{2});
  }

  void exports_pictures_charts_and_figures() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const ExportActions& exports = *solved.window->findChild<ExportActions*>();
    const QTemporaryDir folder;
    exports.write_scene(folder.filePath("scene.png"), 2);
    const QImage picture(folder.filePath("scene.png"));
    const QSize canvas =
        solved.scene_view->canvas()->size() * solved.scene_view->canvas()->devicePixelRatioF();
    QCOMPARE(picture.size(), 2 * canvas);
    QVERIFY(color_count(picture) > 5);

    exports.write_map_picture(folder.filePath("map.svg"));
    QVERIFY(contents(folder.filePath("map.svg")).count("<path") > 3);
    exports.write_charts(folder.filePath("charts.svg"));
    const QByteArray charts = contents(folder.filePath("charts.svg"));
    QVERIFY(charts.contains("<polyline") || charts.contains("<path"));
    QVERIFY(!charts.contains("<image"));  // vector graphics
    exports.write_chart_figures(folder.filePath("figures.csv"));
    const QByteArray figures = contents(folder.filePath("figures.csv"));
    QVERIFY(figures.startsWith("chart,x,change,quadrature_error\niteration,1,"));
    QCOMPARE(figures.count("direction,"), 32);
    QVERIFY_EXCEPTION_THROWN(exports.write_scene(folder.filePath("no/such.png"), 1),
                             std::runtime_error);
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 4);
  }

  void records_a_frame_per_change() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    const auto passes = [&] { return solved.window->snapshot()->passes_done; };
    // Each command makes an iteration, whose passes are kept.
    std::int64_t before = passes();
    recorder.begin_frames(folder.path());
    solved.trigger("one_direction");
    QVERIFY(wait_for(
        [&] { return recorder.frames() >= 2 && passes() > before && solved.window->settled(); }));
    recorder.end();
    const int frames = recorder.frames();
    before = passes();
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return passes() > before && solved.window->settled(); }));
    handle_posted();
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), frames);
    // Steps are recorded too, after the frames of the earlier recording.
    const QByteArray first = contents(folder.filePath("frame_00001.png"));
    recorder.begin_frames(folder.path());
    solved.window->focus.go_to({0, 0, 2});
    QVERIFY(wait_for([&] { return recorder.frames() >= frames + 2; }));
    recorder.end();
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), recorder.frames());
    QVERIFY(contents(folder.filePath("frame_00001.png")) == first);
    QVERIFY(color_count(QImage(folder.filePath("frame_00001.png"))) > 5);
  }

  void records_what_is_played_as_an_animation() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    const QString path = folder.filePath("played.gif");
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    auto* play = solved.window->findChild<PlayControl*>();
    play->set_speed(25);
    play->set_by(PlayControl::By::polygons);
    solved.window->findChild<QAction*>("play_turns")->setChecked(true);
    solved.window->focus.go_to({0, 0, -1});
    QVERIFY(settles(*solved.window));
    recorder.begin_animation(path);
    QVERIFY(solved.window->findChild<QAction*>("export_animation")->isChecked());
    QVERIFY(solved.window->findChild<QWidget*>("recording")->isVisible());
    const QImage first = solved.scene_view->picture(1).copy();
    constexpr int steps = 12;
    play->action()->trigger();
    QVERIFY(wait_for([&] { return recorder.frames() > steps; }));
    play->action()->trigger();
    QVERIFY(!QFile::exists(path));
    QTest::mouseClick(solved.window->findChild<QToolButton*>("finish_recording"), Qt::LeftButton);
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY(!solved.window->findChild<QWidget*>("recording")->isVisible());

    QImageReader reader(path);
    QCOMPARE(reader.imageCount(), recorder.frames());
    QCOMPARE(reader.loopCount(), -1);  // without end
    const QImage read = reader.read().convertToFormat(QImage::Format_RGB32);
    QCOMPARE(read.size(), first.size());
    // 256 colors are enough for this scene.
    double sum = 0;
    for (int y = 0; y < first.height(); ++y) {
      for (int x = 0; x < first.width(); ++x) {
        sum += std::abs(qGray(first.pixel(x, y)) - qGray(read.pixel(x, y)));
      }
    }
    QVERIFY2(sum < 2.0 * first.width() * first.height(), qPrintable(QString::number(sum)));
    QImage before = read;
    int others = 0;
    for (int frame = 1; frame < recorder.frames(); ++frame) {
      QCOMPARE(reader.nextImageDelay(), 40);
      const QImage now = reader.read().convertToFormat(QImage::Format_RGB32);
      QVERIFY(!now.isNull());
      others += now != before;
      before = now;
    }
    QVERIFY2(others >= steps / 2, qPrintable(QString::number(others)));
  }

  void a_canceled_animation_leaves_no_file() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    recorder.begin_animation(folder.filePath("thrown-away.gif"));
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return recorder.frames() >= 2; }));
    QTest::mouseClick(solved.window->findChild<QToolButton*>("cancel_recording"), Qt::LeftButton);
    QVERIFY(!recorder.writing());
    QVERIFY(!solved.window->findChild<QAction*>("export_animation")->isChecked());
    const QDir files(folder.path());
    QVERIFY(wait_for([&] { return files.entryList(QDir::Files | QDir::Hidden).isEmpty(); }));
    // Where nothing can be written, the recording ends with one message.
    recorder.begin_animation(folder.filePath("no/such/folder.gif"));
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY2(solved.window->banner_text().contains("folder.gif"),
             qPrintable(solved.window->banner_text()));
  }
};

const test::Registered registered("session_file", test::run_as_viewer<SessionFileTest>);

}  // namespace transillum::viewer::session_file_test

#include "session_file_test.moc"
