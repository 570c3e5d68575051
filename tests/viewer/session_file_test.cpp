// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Session files in the viewer's window: saving, opening and errors; recent files; exports.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTemporaryDir>
#include <algorithm>

#include "lessons/session_file.h"
#include "scene/scene_page.h"
#include "scene/show_menu.h"
#include "solved_window.h"
#include "stepping/algorithm_view.h"
#include "stepping/play_control.h"
#include "test_files.h"
#include "window/base/open_scene.h"
#include "window/base/view_state_applier.h"
#include "window/files/export_actions.h"
#include "window/files/file_actions.h"
#include "window/files/frame_recorder.h"
#include "window/files/recovery.h"
#include "window/files/window_session.h"
#include "window/inspection_panels.h"

namespace transillum::viewer::session_file_test {

using namespace test;

namespace {

const char* const triangle_room =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

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
      window.views().algorithm.set_kind(MapKind::global);
      camera = solved.scene_view->view_point();
      window.views().page.bookmarks().add(camera, "the \"first\" one");
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
    QVERIFY(window->views().algorithm.kind() == MapKind::global);
    const auto& views = window->views().page.bookmarks().all();
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
      solved.window->views().page.hidden().hide(hidden);
      solved.window->findChild<QComboBox*>("clip_axis")->setCurrentIndex(2);
      solved.window->findChild<QSlider*>("clip_place")->setValue(50);
      solved.window->findChild<QCheckBox*>("clip_other_side")->setChecked(true);
      solved.window->files().save_session(path);
      QVERIFY(contents_of(path).contains("hidden"));
    }
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QCOMPARE(window->selection.patch(), PatchId{7});
    QVERIFY(window->selection.patches() == selected);
    const HiddenPatches& left_out = window->views().page.hidden();
    for (PatchId i = 0; i < window->scene.loaded()->scene->patch_count(); ++i) {
      QCOMPARE(left_out.hidden(i), std::count(hidden.begin(), hidden.end(), i) > 0);
    }
    QVERIFY(window->applier().state().clip == clip);
    // A session without these keys shows everything.
    write_file(path, R"({"show": {"scene": "furnace", "options": {"directions": 32}}})");
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY(!left_out.any() && !window->applier().state().clip);
    QVERIFY(window->selection.patches().empty());
  }

  void patches_that_the_scene_lacks_are_reported() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("many.json");
    write_file(path,
               R"({"show": {"scene": "cornell-box", "options": {"directions": 16}, "select": 1,
                             "also-selected": [3, [5, 7]], "hidden": [2, [4, 1073741824]]}})");
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY2(window->banner_text().startsWith("hidden: there is no patch 1073741824; the scene"),
             qPrintable(window->banner_text()));
    const std::vector<PatchId> selected{1, 3, 5, 6, 7};
    QVERIFY(window->selection.patches() == selected);
    QVERIFY(!window->views().page.hidden().hidden(3));
    QVERIFY(window->views().page.hidden().hidden(4));
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
    write_file(path, R"({"show": {"scene": "furnace", "options": {"directions": 16},
                             "colors": {"show": "luminance", "range": [1, 2]}}})");
    const auto window = make_window(16);
    window->views().page.bookmarks().add({});
    window->files().open(path);
    QVERIFY(settles(*window));
    QCOMPARE(window->colors.scale().low, 1.0);
    QVERIFY(window->views().page.bookmarks().all().empty());
    QVERIFY(window->colors.exposure_is_automatic());
  }

  void a_damaged_layout_is_not_restored() {
    const auto window = make_window(16);
    DockLayouts& docks = window->views().docks;
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
    write_file(path,
               R"({"show": {"scene": "furnace", "options": {"directions": 16}, "layout": "debug"},
                    "docks": "AAAA/wAAAAf9AAAAAwAAAAAAAAFe"})");
    const auto window = make_window(16);
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY2(window->banner_text().startsWith("docks: damaged"), qPrintable(window->banner_text()));
    QVERIFY(window->views().docks.current() == Layout::debug);
    QVERIFY(window->findChild<QDockWidget*>("algorithm_dock")->isVisible());
  }

  void a_position_that_cannot_be_reached_is_reported_data() {
    QTest::addColumn<QByteArray>("show");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const char* show, const char* expected) {
      QTest::newRow(name) << QByteArray(show) << QString(expected);
    };
    row("iteration, paused", R"("scene": "furnace", "options": {"directions": 16}, "solve": 3,
        "focus": {"iteration": 15})",
        "focus: there is no iteration 15; the run has 1 to 1");
    row("iteration, nothing solved",
        R"("scene": "furnace", "options": {"directions": 16}, "solve": 0,
        "focus": {"iteration": 2})",
        "focus: there is no iteration 2; the run has 1 to 1");
    row("iteration, finished",
        R"("scene": "furnace", "options": {"directions": 16, "iterations": 2},
        "focus": {"iteration": 3})",
        "focus: there is no iteration 3; the run has 1 to 2");
    row("direction", R"("scene": "furnace", "options": {"directions": 16}, "solve": 20,
        "focus": {"iteration": 2, "direction": 17})",
        "focus: there is no direction 17; the run has 1 to 16");
    row("selected patch", R"("scene": "furnace", "options": {"directions": 16}, "select": 12)",
        "select: there is no patch 12; the scene has 0 to 11");
    row("no scene", R"("focus": {"iteration": 3})", "scene: is missing, and no scene is open");
  }
  void a_position_that_cannot_be_reached_is_reported() {
    QFETCH(const QByteArray, show);
    QFETCH(const QString, expected);
    const QTemporaryDir folder;
    const QString path = folder.filePath("far.json");
    write_file(path, R"({"show": {)" + show + "}}");
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
    write_file(path, R"({"show": {"scene": "furnace", "options": {"directions": 1000000},
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

  void a_session_and_its_scene_move_together() {
    const QTemporaryDir folder;
    write_file(folder.filePath("room.obj"), triangle_room);
    Session session;
    session.state.scene = folder.filePath("room.obj").toStdString();
    const std::string text = to_text(session, folder.path().toStdString());
    QVERIFY(text.find(folder.path().toStdString()) == std::string::npos);
    const QTemporaryDir other;
    write_file(other.filePath("room.obj"), triangle_room);
    const Session read = session_from_text(text, "s.json", other.path().toStdString());
    QCOMPARE(QString::fromStdString(read.state.scene), other.filePath("room.obj"));
  }

  void errors_name_file_and_key_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const QString& text, const char* expected) {
      QTest::newRow(name) << text << QString(expected);
    };
    row("no JSON", "{", "bad.json, line 1");
    row("neither", "{}", "neither a session");
    row("a list", "[1]", "neither a session");
    row("scene", R"({"show": {"scene": 1}})", "bad.json, show, scene");
    row("material", R"({"show": {"materials": [{"name": "x", "exitance": [1, 1, 1],
        "reflectance": [0, 0.5, 1]}]}})",
        "material 1, reflectance");
    row("kind", R"({"show": {}, "breakpoints": [{"kind": "x"}]})", "breakpoint 1, kind");
    row("patch", R"({"show": {}, "breakpoints": [{"kind": "cut", "patch": -1}]})",
        "breakpoint 1, patch");
    row("hit", R"({"show": {}, "breakpoints": [{"kind": "cut", "stop-at": 0}]})",
        "breakpoint 1, stop-at");
    row("join", R"({"show": {}, "breakpoints": [{"kind": "cut", "further": [{"kind": "cut"}]}]})",
        "breakpoint 1, condition 1, join: must be \"and\" or \"or\"");
    row("watch", R"({"show": {}, "watches": [{"kind": "map-size", "patch": 1}]})",
        "watch 1: unknown key");
    row("watches",
        R"({"show": {}, "watches": [)" + QString(R"({"kind": "map-size"},)").repeated(6) +
            R"({"kind": "map-size"}]})",
        "watches: must be a list of at most 6");
    row("view", R"({"show": {}, "kept-views": [{"name": "x"}]})", "saved view 1, camera");
    row("notes", R"({"show": {}, "notes": []})", "bad.json, notes");
    row("key", R"({"show": {}, "note": ""})", "\"note\"");
    row("number", R"({"show": {"scene": "cornell-box"}, "notes": 1e999})",
        "line 1, column 50: the number `1e999` is out of range");
    row("twice", R"({"show": {}, "notes": "a", "notes": "b"})", "the key `notes` occurs twice");
    row("deep", R"({"show": {}, "notes": )" + QString(2'000'000, '['),
        "more than 64 lists and objects");
    row("hidden", R"({"show": {"hidden": 3}})",
        "bad.json, show, hidden: must be a list of patches");
    row("hidden twice", R"({"show": {"hidden": [[3, 5], 5]}})",
        "show, hidden, item 2: patches must ascend");
    row("hidden pair", R"({"show": {"hidden": [7, [9, 8]]}})",
        "show, hidden, item 2: patches must ascend");
    row("hidden patch", R"({"show": {"hidden": [[3, 1e10]]}})",
        "show, hidden, item 1: must be a patch, or a pair");
    row("hidden list", R"({"show": {"hidden": [0)" + QString(",0").repeated(100'000) + "]}}",
        "show, hidden: must be a list of at most 100000");
    row("alone", R"({"show": {"also-selected": [1]}})", "also-selected: requires \"select\"");
    row("axis", R"({"show": {"clip": {"axis": "w"}}})",
        "show, clip, axis: must be one of \"x\", \"y\", \"z\"");
    row("no axis", R"({"show": {"clip": {}}})", "show, clip, axis: is missing");
    row("place", R"({"show": {"clip": {"axis": "x", "place": 1.1}}})",
        "show, clip, place: must be from 0 to 1");
    row("many", R"({"show": {}, "breakpoints": [0)" + QString(",0").repeated(1000) + "]}",
        "breakpoints: must be a list of at most 1000");
  }
  void errors_name_file_and_key() {
    QFETCH(QString, text);
    QFETCH(QString, expected);
    const QTemporaryDir folder;
    const QString path = folder.filePath("bad.json");
    write_file(path, text.toUtf8());
    const auto window = make_window();
    window->files().try_open(path);
    QVERIFY2(window->banner_text().contains(expected), qPrintable(window->banner_text()));
    QVERIFY(!window->snapshot());
  }

  void what_is_no_text_file_is_refused() {
    const QTemporaryDir folder;
    QVERIFY(QDir(folder.path()).mkdir("folder.json"));
    QVERIFY(QFile::link("/dev/zero", folder.filePath("endless.json")));
    write_file(folder.filePath("zero.json"), QByteArray("{\0}", 3));
    write_file(folder.filePath("utf16.json"), QByteArray("\xff\xfe{\0}\0", 6));
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
    write_file(path, triangle_room);
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
    write_file(path, triangle_room);
    const auto window = make_window(4);
    window->files().open(path);
    QVERIFY(settles(*window) && window->snapshot()->radiosity.size() == 4);
    window->selection.select(2);
    window->findChild<QAction*>("watch")->setChecked(true);
    // Replaces the file like programs that write a new file and rename it.
    write_file(path + ".new", QByteArray(triangle_room) + "f 1 2 3\n");
    QVERIFY(QFile::remove(path) && QFile::rename(path + ".new", path));
    QVERIFY(wait_for([&] { return window->snapshot()->radiosity.size() == 5; }, 10000));
    QVERIFY(settles(*window));
    QCOMPARE(window->selection.patch(), PatchId{2});
  }
};

const test::Registered registered("session_file", test::run_as_viewer<SessionFileTest>);

}  // namespace transillum::viewer::session_file_test

#include "session_file_test.moc"
