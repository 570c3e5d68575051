// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sessions that outlive a killed program, and questions before long work is lost.
#include <QAction>
#include <QDir>
#include <QMenuBar>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>

#include "lessons/session_file.h"
#include "open_scene.h"
#include "scene/scene_page.h"
#include "scene/show_menu.h"
#include "solved_window.h"
#include "stepping/play_control.h"
#include "test_files.h"
#include "widgets/banner.h"
#include "window/base/open_scene.h"
#include "window/base/view_state_applier.h"
#include "window/editing/scene_edits.h"
#include "window/files/export_actions.h"
#include "window/files/file_actions.h"
#include "window/files/frame_recorder.h"
#include "window/files/kept_faces.h"
#include "window/files/recovery.h"
#include "window/files/window_session.h"
#include "window/inspection_panels.h"

namespace transillum::viewer::recovery_test {

using namespace test;

namespace {

const char* const triangle_room =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

/// A window whose session is kept in a folder.
struct RecoveringWindow {
  std::unique_ptr<TestWindow> window = make_window(8);
  WindowSession session{window->frame(), window->views().docks, window->views().notes,
                        window->applier()};
  Recovery recovery;

  explicit RecoveringWindow(const QTemporaryDir& folder)
      : recovery(window->frame(), session, folder.path()) {}

  /// Whether an edit is done, and solved.
  bool edited() const {
    return wait_for([this] {
      return !window->findChild<SceneEdits*>()->busy() && window->scene.has_unsaved_faces() &&
             window->snapshot()->progress.finished && window->settled();
    });
  }
  bool open_and_add(const QString& scene, AddedSolid solid) const {
    window->open(scene);
    if (!wait_for([this] { return window->snapshot() && window->settled(); })) {
      return false;
    }
    window->findChild<SceneEdits*>()->add(solid);
    return edited();
  }
};

const QStringList faces_files{"*.obj", "*.mtl"};

/// Copies session, solve and faces.
void copy_all(const QString& from, const QString& to) {
  for (const QFileInfo& file :
       QDir(from).entryInfoList({"*.json", "*.tck", "*.obj", "*.mtl"}, QDir::Files)) {
    QVERIFY(QFile::copy(file.filePath(), to + '/' + file.fileName()));
  }
}

/// Answers each question about long work with a button.
struct Answers {
  QString button = "Cancel";
  int given = 0;
  QTimer timer;

  Answers() {
    QObject::connect(&timer, &QTimer::timeout, &timer, [this] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (!box || box->objectName() != "long_work") {
        return;
      }
      for (QAbstractButton* choice : box->buttons()) {
        if (choice->text().remove('&') == button) {
          ++given;
          choice->click();
          return;
        }
      }
    });
    timer.start(20);
  }
};

}  // namespace

class RecoveryTest : public QObject {
  Q_OBJECT

 private slots:
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
    const Session session = session_from_text(contents_of(path).toStdString(), "s.json", "");
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
      RecoveringWindow w(folder);
      const auto& window = w.window;
      w.recovery.keep();
      QVERIFY(QDir(folder.path()).entryList({"*.json"}).isEmpty());
      window->open("cornell-box",
                   passes > 0 ? Goal{Goal::Kind::passes, passes} : Goal{Goal::Kind::finished});
      QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
      window->selection.select(5);
      w.recovery.keep();
      const QStringList files = QDir(folder.path()).entryList({"*.json"});
      QCOMPARE(files.size(), 1);
      // A program that is killed leaves its file, and a lock that nothing holds.
      QVERIFY(QFile::copy(folder.filePath(files[0]), kept));
      radiosity = window->snapshot()->radiosity;
    }
    QCOMPARE(QDir(folder.path()).entryList({"*.json"}), QStringList("killed.json"));

    RecoveringWindow w(folder);
    const auto& window = w.window;
    auto* bar = window->findChild<Banner*>("recovery_bar");
    QVERIFY(bar->isHidden());
    w.recovery.offer();
    QVERIFY(!bar->isHidden());
    window->findChild<QPushButton*>("restore_session")->click();
    QVERIFY(bar->isHidden());
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    QVERIFY(window->snapshot()->radiosity == radiosity);
    QCOMPARE(window->selection.patch(), 5);
    QVERIFY(!QFile::exists(kept));
  }

  void edited_faces_survive_a_killed_program_data() {
    QTest::addColumn<bool>("open_again");
    QTest::newRow("at the start") << false;
    QTest::newRow("over other edits of the scene") << true;
  }
  // A session named faces that no file had, so it could not be opened.
  void edited_faces_survive_a_killed_program() {
    QFETCH(bool, open_again);
    const QTemporaryDir folder, killed, scenes;
    const QString scene = write_open_scene(scenes.path());
    std::vector<Rgb> radiosity;
    SceneDescription before;
    {
      RecoveringWindow w(folder);
      QVERIFY(w.open_and_add(scene, AddedSolid::box));
      auto* edits = w.window->findChild<SceneEdits*>();
      edits->choose(0, SceneEdits::Reach::face);
      edits->remove();
      QVERIFY(w.edited());
      edits->add(AddedSolid::board);
      QVERIFY(w.edited());
      w.recovery.keep();
      copy_all(folder.path(), killed.path());
      QCOMPARE(QDir(killed.path()).entryList(faces_files).size(), 2);
      radiosity = w.window->snapshot()->radiosity;
      before = *w.window->scene.faces().edited;
      // The faces are in the user's file now.
      w.window->findChild<ExportActions*>()->write_scene_file(scenes.filePath("saved.obj"));
      w.recovery.keep();
      QVERIFY(QDir(folder.path()).entryList(faces_files).isEmpty());
    }
    copy_all(killed.path(), folder.path());
    RecoveringWindow w(folder);
    const auto& window = w.window;
    if (open_again) {
      QVERIFY(w.open_and_add(scene, AddedSolid::room));
    }
    w.recovery.offer();
    Answers answers;
    answers.button = "Continue";
    window->findChild<QPushButton*>("restore_session")->click();
    QCOMPARE(answers.given, open_again ? 1 : 0);
    QVERIFY(wait_for([&] {
      return !window->scene.is_opening() && window->snapshot() &&
             window->snapshot()->progress.finished && window->settled();
    }));
    QVERIFY(window->snapshot()->radiosity == radiosity);
    QVERIFY(window->scene.has_unsaved_faces());
    QCOMPARE(window->scene.spec(), scene.toStdString() + " (edited)");
    const SceneDescription& faces = *window->scene.faces().edited;
    QCOMPARE(faces.name, before.name);
    QVERIFY(!faces.files.empty() && faces.files == before.files);
    QVERIFY(faces.face_number == before.face_number && faces.face_number.front() > 0);
    QVERIFY(window->findChild<SceneEdits*>()->why_unavailable().isEmpty());
    for (const QString& name : QDir(killed.path()).entryList({"*.json", "*.obj", "*.mtl"})) {
      QVERIFY2(!QFile::exists(folder.filePath(name)), qPrintable(name));
    }
    QCOMPARE(QDir(folder.path()).entryList(faces_files).size(), 2);  // kept again
  }

  void kept_faces_lose_neither_numbers_nor_sides() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("kept.obj").toStdString();
    SceneDescription faces = describe_scene("boards");
    const std::size_t count = faces.face_count();
    faces.name = "a room";
    faces.files = {"room.obj", "room.mtl"};
    for (std::size_t f = 0; f < count; ++f) {
      faces.face_number.push_back(static_cast<std::int32_t>(3 * f + 1));
      faces.face_two_sided.push_back(f % 2);
    }
    faces.joined_to = {-1, 1, 1};
    faces.coordinate_rounding = 0.1 / 3;
    write_kept_faces(file, faces);
    nlohmann::json lists = nlohmann::json::parse(kept_lists(faces).dump());
    const SceneDescription read = read_kept_faces(file, lists, "faces");
    QVERIFY(read.points == faces.points && read.corners == faces.corners);
    QVERIFY(read.face_begin == faces.face_begin && read.face_material == faces.face_material);
    QVERIFY(read.face_number == faces.face_number && read.joined_to == faces.joined_to);
    QVERIFY(read.face_two_sided == faces.face_two_sided);
    QCOMPARE(read.coordinate_rounding, 0.1 / 3);
    QCOMPARE(read.name, faces.name);
    QVERIFY(read.files == faces.files);
    lists["two-sided"].push_back(0);
    QVERIFY_EXCEPTION_THROWN(read_kept_faces(file, lists, "faces"), InputError);
    lists.erase("two-sided");
    QVERIFY_EXCEPTION_THROWN(read_kept_faces(file, lists, "faces"), InputError);
  }

  void faces_outlive_a_signal() {
    const QTemporaryDir folder;
    {
      RecoveringWindow w(folder);
      QVERIFY(w.open_and_add("cornell-box", AddedSolid::board));
      w.recovery.leave_faces();
    }
    QCOMPARE(QDir(folder.path()).entryList({"*.json", "*.obj", "*.mtl"}).size(), 3);
    const QTemporaryDir other;
    {
      RecoveringWindow w(other);
      w.window->open("cornell-box");
      QVERIFY(wait_for([&] { return w.window->snapshot() && w.window->settled(); }));
      w.recovery.leave_faces();
    }
    QVERIFY(QDir(other.path()).entryList({"*.json"}).isEmpty());
  }

  void a_session_is_kept_though_its_faces_cannot_be_written() {
    const QTemporaryDir folder;
    RecoveringWindow w(folder);
    const QString name = QDir(folder.path()).entryList({"*.lock"}).value(0).chopped(5);
    QVERIFY(QDir(folder.path()).mkpath(name + ".1.obj/full"));
    QVERIFY(w.open_and_add("cornell-box", AddedSolid::board));
    w.recovery.keep();
    const QString text = contents_of(folder.filePath(name + ".json"));
    QVERIFY(text.contains("cornell-box (edited)"));
    QVERIFY(!text.contains("\"faces\":"));
  }

  void a_session_that_is_not_opened_stays_data() {
    QTest::addColumn<QString>("scene");
    QTest::newRow("fails") << "missing.obj";
    QTest::newRow("is canceled") << "sphere-flake:levels=4";
  }
  void a_session_that_is_not_opened_stays() {
    QFETCH(QString, scene);
    const QTemporaryDir folder;
    const QStringList files{"killed.1.mtl", "killed.1.obj", "killed.json", "killed.tck"};
    for (const QString& file : files) {
      const QByteArray session = "{\"show\": {\"scene\": \"" + scene.toUtf8() + "\"}}";
      write_file(folder.filePath(file), file.endsWith("json") ? session : QByteArray());
    }
    RecoveringWindow w(folder);
    w.recovery.offer();
    auto* bar = w.window->findChild<Banner*>("recovery_bar");
    auto* loading = w.window->findChild<Banner*>("loading_bar");
    w.window->findChild<QPushButton*>("restore_session")->click();
    if (scene.startsWith("sphere")) {
      QVERIFY(bar->isHidden());
      QVERIFY(wait_for([&] { return !loading->isHidden(); }));
      w.window->findChild<QPushButton*>("cancel_loading")->click();
    }
    QVERIFY(wait_for([&] { return !bar->isHidden(); }));
    QCOMPARE(QDir(folder.path()).entryList({"killed.*"}, QDir::Files, QDir::Name), files);
  }

  void every_kept_session_is_offered_until_it_is_discarded() {
    const QTemporaryDir folder;
    for (const char* name : {"one.json", "two.json"}) {
      write_file(folder.filePath(name), "{}");
    }
    RecoveringWindow w(folder);
    w.recovery.offer();
    auto* bar = w.window->findChild<Banner*>("recovery_bar");
    for (const int left : {2, 1}) {
      QCOMPARE(QDir(folder.path()).entryList({"*.json"}).size(), left);
      QVERIFY(!bar->isHidden());
      w.window->findChild<QPushButton*>("discard_session")->click();
    }
    QVERIFY(bar->isHidden());
    QVERIFY(QDir(folder.path()).entryList({"*.json"}).isEmpty());
  }

  void the_session_of_a_running_program_is_not_offered() {
    const QTemporaryDir folder;
    RecoveringWindow w(folder), other(folder);
    w.window->open("cornell-box");
    QVERIFY(wait_for([&] { return w.window->snapshot() && w.window->settled(); }));
    w.recovery.keep();
    other.recovery.offer();
    QVERIFY(other.window->findChild<Banner*>("recovery_bar")->isHidden());
    QCOMPARE(QDir(folder.path()).entryList({"*.json"}).size(), 1);
  }

  void asks_before_long_work_is_lost() {
    const auto window = make_window(8);
    window->open("cornell-box");
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    window->work_guard().set_long_seconds(0);
    Answers answers;
    window->findChild<QAction*>("stop")->trigger();
    QCOMPARE(answers.given, 1);
    QVERIFY(window->snapshot()->progress.iteration > 0);
    answers.button = "Start over";
    window->findChild<QAction*>("stop")->trigger();
    QVERIFY(wait_for([&] { return window->snapshot()->progress.iteration == 0; }));
    // Nothing is lost now.
    window->findChild<QAction*>("stop")->trigger();
    QCOMPARE(answers.given, 2);
  }

  void asks_before_another_scene_replaces_long_work_data() {
    QTest::addColumn<QString>("way");
    QTest::addColumn<QString>("button");
    const auto row = [](const char* name, const char* way, const char* button) {
      QTest::newRow(name) << QString(way) << QString(button);
    };
    row("solve again", "restart", "Solve again");
    row("reload", "reload", "Reload");
    row("a built-in scene", "built-in", "Open");
    row("a dropped scene", "room.obj", "Open");
    row("a dropped session", "session.json", "Open");
    row("a lesson", "lesson_next", "Begin the lesson");
    row("a kept session", "restore_session", "Continue");
  }
  // Each way to lose a long solve asks once; Cancel keeps the solve, the button loses it.
  void asks_before_another_scene_replaces_long_work() {
    QFETCH(QString, way);
    QFETCH(QString, button);
    const QTemporaryDir folder, kept_sessions;
    write_file(folder.filePath("room.obj"), triangle_room);
    write_file(folder.filePath("session.json"), R"({"show": {"scene": "furnace"}})");
    write_file(kept_sessions.filePath("killed.json"), R"({"show": {"scene": "furnace"}})");
    RecoveringWindow w(kept_sessions);
    const auto& window = w.window;
    w.recovery.offer();
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
        drop_file(*window, folder.filePath(way));
      }
    };
    Answers answers;
    go();
    QVERIFY(wait_for([&] { return answers.given == 1; }));
    QCoreApplication::processEvents();
    QVERIFY(!window->scene.is_opening());
    QVERIFY(window->snapshot()->kept_directions.front() == run);
    answers.button = button;
    go();
    QVERIFY(wait_for([&] { return answers.given == 2; }));
    QVERIFY(wait_for(
        [&] { return window->snapshot() && window->snapshot()->kept_directions.front() != run; }));
  }
};

const test::Registered registered("recovery", test::run_as_viewer<RecoveryTest>);

}  // namespace transillum::viewer::recovery_test

#include "recovery_test.moc"
