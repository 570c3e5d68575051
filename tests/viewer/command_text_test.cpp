// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Commands copied from the window: the program transillum, run with them, finds the same bits.
#include "model/command_text.h"

#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QPushButton>
#include <QTemporaryDir>

#include "options/option_table.h"
#include "patches/error_page.h"
#include "scene/color_controls.h"
#include "session/next_steps.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "transillum/scene.h"
#include "window/base/dock_layouts.h"

namespace transillum::viewer::command_text_test {

using namespace test;

namespace {

QString copied(const SolvedWindow& solved, const char* action) {
  solved.trigger(action);
  return QApplication::clipboard()->text();
}

/// The output of a command, run with the program beside the viewer's; empty if it failed.
QByteArray output_of(const QString& command, const QString& folder = QDir::tempPath()) {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("PATH", QFileInfo(TRANSILLUM_VIEWER).path() + ':' + environment.value("PATH"));
  process.setProcessEnvironment(environment);
  process.setWorkingDirectory(folder);
  process.start("/bin/sh", {"-c", command});
  if (!process.waitForFinished(60000) || process.exitCode() != 0) {
    qInfo() << command << process.readAllStandardError();
    return {};
  }
  return process.readAllStandardOutput();
}

}  // namespace

class CommandTextTest : public QObject {
  Q_OBJECT

 private slots:
  void defaults_are_left_out() {
    RunOptions defaults;
    set_dependent_defaults(defaults, {});
    QCOMPARE(QString::fromStdString(solve_command("cornell-box", defaults, {})),
             QString("transillum solve cornell-box"));
    QCOMPARE(QString::fromStdString(map_command("a b's.obj", {}, {}, {0, 0.5, -1})),
             QString("transillum map 'a b'\\''s.obj' --direction 0,0.5,-1 --out map.svg"));
  }

  void a_copied_solve_has_the_same_bits_data() {
    QTest::addColumn<int>("variant");
    QTest::newRow("one-way Hammersley") << 0;
    QTest::newRow("replicas, divided, two-sided") << 1;
    QTest::newRow("seeded, growing") << 2;
  }
  void a_copied_solve_has_the_same_bits() {
    QFETCH(int, variant);
    RunOptions options{.solve = {.directions = 24}};
    if (variant == 0) {
      options.solve.two_way = false;
      options.solve.sampling = Sampling::hammersley;
      options.solve.rotation = 5;
    } else if (variant == 1) {
      options.solve.replicas = 3;
      options.solve.normalize = Normalization::rows;
      options.scene = {true, 0.1};
    } else {
      options.solve.sampling = Sampling::random;
      options.solve.seed = 77;
      options.solve.scheme = Scheme::growing;
      options.solve.tolerance = 1e-4;
      options.input.changes = {{"material:light", {}, Rgb{7, 6.5, 1.0 / 3}}};
    }
    const auto window = make_window(options.solve);
    window->scene.open("cornell-box", options, {Goal::Kind::finished});
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    expect_same_bits(*window);
  }

  /// Faces are divided unasked, with linear functions: the preset of the window.
  void a_copied_first_look_has_the_same_bits() {
    const QTemporaryDir folder;
    const std::string file = folder.filePath("room.obj").toStdString();
    write_obj(file, describe_scene("cornell-box"));
    const auto window = make_window(16);
    window->files().set_divides(true);
    window->files().try_open(QString::fromStdString(file));
    QVERIFY(wait_for([&] { return window->snapshot() && window->snapshot()->progress.finished; }) &&
            comes_to_rest(*window));
    QVERIFY(window->snapshot()->options.basis == Basis::linear);
    QVERIFY(window->snapshot()->radiosity.size() > 1000);
    expect_same_bits(*window);
  }

  /// The next solve uses the materials that were changed in the window.
  void a_copied_solve_of_an_edited_scene_has_the_same_bits() {
    const auto window = make_window(8);
    window->scene.open("cornell-box", {.solve = {.directions = 8}}, {Goal::Kind::finished});
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    MaterialEdits& edits = window->relighting.edits();
    for (int k = 0; k < 20; ++k) {
      const double x = 0.01 + k / 30.0;
      const std::string face = "face:" + std::to_string(k % 12);
      if (k % 3 == 0) {
        edits.set_exitance(face, {1 + x, 2, 3 / x});
      } else if (k % 3 == 1) {
        edits.set_reflectance(k % 2 == 0 ? face : "material:white", {x, 0.5, 1 - x});
      } else {
        edits.set_exitance("material:light", {k + x, 0, 1});
        edits.set_reflectance(face, {0, x, 0.25});
      }
      const auto before = window->scene.loaded();
      window->findChild<QPushButton*>("restart")->click();
      QVERIFY(wait_for([&] { return window->scene.loaded() != before && window->settled(); }));
      QVERIFY(edits.changes().empty());
      expect_same_bits(*window);
      if (QTest::currentTestFailed()) {
        return;
      }
    }
  }

  void a_copied_division_has_the_same_bits_data() {
    QTest::addColumn<bool>("total");
    QTest::newRow("after rounds") << false;
    QTest::newRow("after a total error") << true;
  }
  /// The step that *Errors* offers, after patches were divided by the program.
  void a_copied_division_has_the_same_bits() {
    QFETCH(bool, total);
    RunOptions options{.solve = {.directions = 64, .first_shot = {}, .replicas = 4}};
    if (total) {
      options = {.total = true};
      options.solve.goal.accuracy = 0.4;
      options.refine.patches = 5000;
    } else {
      options.refine = {RefineBy::error, 100};
    }
    const auto window = make_window(options.solve);
    const auto solved = [&] {
      return window->settled() && window->runner.state() == RunState::finished &&
             window->snapshot() && window->snapshot()->progress.finished;
    };
    window->scene.open("cornell-box", options, {Goal::Kind::finished});
    QVERIFY(wait_for(solved));
    window->views().docks.bring_to_front("parts");
    if (!total) {
      window->findChild<QPushButton*>("measure_surfaces")->click();
    }
    QVERIFY(wait_for([&] { return window->colors.errors() && window->settled(); }));
    const auto errors = window->colors.errors();
    QCOMPARE(errors->loaded, window->scene.loaded());
    QVERIFY(!errors->loaded->divided.empty());
    const SurfaceCauses& worst = at(errors->report.surfaces, errors->report.worst);
    const SolveOptions& last = errors->solve.options;
    emit window->findChild<ErrorPage*>()->step_chosen({.kind = NextStep::Kind::divide_surface,
                                                       .surface = worst.name,
                                                       .patches = 1,
                                                       .passes = last.directions,
                                                       .tolerance = last.tolerance});
    QVERIFY(wait_for([&] { return window->scene.loaded() != errors->loaded && solved(); }));
    expect_same_bits(*window);
    const QTemporaryDir folder;
    const QString session = folder.filePath("s.json");
    window->files().save_session(session);
    const auto other = make_window(16);
    other->files().open(session);
    QVERIFY(wait_for([&] {
      return other->snapshot() && other->snapshot()->progress.finished && other->settled();
    }));
    QVERIFY(other->snapshot()->radiosity == window->snapshot()->radiosity);
  }

  void a_copied_step_is_v_at_that_step_data() {
    QTest::addColumn<int>("step");
    QTest::addColumn<int>("phase");
    QTest::newRow("before the first") << -1 << static_cast<int>(Phase::after);
    QTest::newRow("before") << 7 << static_cast<int>(Phase::before);
    QTest::newRow("split") << 7 << static_cast<int>(Phase::split);
    QTest::newRow("after") << 20 << static_cast<int>(Phase::after);
  }
  void a_copied_step_is_v_at_that_step() {
    QFETCH(int, step);
    QFETCH(int, phase);
    const SolvedWindow solved("boards:n=5", {.directions = 8});
    QVERIFY(solved.ready);
    Focus& focus = solved.window->focus;
    focus.go_to({0, 3, step});
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    focus.set_phase(static_cast<Phase>(phase));
    const QTemporaryDir folder;
    const QString file = folder.filePath("map.json");
    QVERIFY(
        !output_of(copied(solved, "copy_step") + " --out " + file + " && echo written").isEmpty());
    const QJsonArray polygons = QJsonDocument::fromJson(contents_of(file))["polygons"].toArray();
    const VisibilityMap shown =
        map_after(focus.map()->record(),
                  focus.position().step - (step >= 0 && phase == static_cast<int>(Phase::before)));
    QCOMPARE(polygons.size(), static_cast<int>(shown.polygons.size()));
    QVERIFY(step < 0 || !polygons.isEmpty());
    for (int k = 0; k < polygons.size(); ++k) {
      const QJsonObject polygon = polygons[k].toObject();
      const VisibilityMap::Polygon& expected = shown.polygons[static_cast<std::size_t>(k)];
      QCOMPARE(polygon["patch"].toInt(), expected.patch);
      QCOMPARE(polygon["facing"].toString(), QString(expected.front_facing ? "front" : "back"));
      QCOMPARE(polygon["area"].toDouble(), expected.area);
    }
  }

  void a_copied_picture_is_of_the_same_solve_from_the_same_eye() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    QVERIFY(solved.ready);
    solved.window->runner.run();
    QVERIFY(wait_for([&] { return solved.window->snapshot()->progress.finished; }));
    solved.scene_view->turn(10, 5);
    QVERIFY(comes_to_rest(*solved.window));
    const QString command = copied(solved, "copy_picture");
    const QSize size = solved.scene_view->canvas()->size();
    const QString all = QString("--size %1x%2 ").arg(size.width()).arg(size.height());
    QVERIFY(command.contains(all));
    const QTemporaryDir folder;
    const QSize small = QSize(120, 120 * size.height() / size.width());
    const QString smaller = QString("--size %1x%2 ").arg(small.width()).arg(small.height());
    QVERIFY(!output_of(QString(command).replace(all, smaller) + " && echo done", folder.path())
                 .isEmpty());
    const Solution result = read_result(folder.filePath("scene.vtp").toStdString());
    QVERIFY(result.radiosity == solved.window->snapshot()->radiosity);
    const QImage picture(folder.filePath("scene.png"));
    QCOMPARE(picture.size(), small);
    // Sharp in the window too: the same surfaces in the same places, and as bright.
    SharpView& sharp = *solved.window->views().page.sharp();
    solved.window->views().page.color_controls()->set_outlines(false);
    solved.window->views().page.color_controls()->set_direction(false);
    sharp.action()->setChecked(true);
    QVERIFY(wait_for([&] { return !solved.scene_view->sharp().isNull(); }));
    const auto shown = sharp.make(small, solved.window.get());
    QVERIFY(shown && shown->size() == small);
    double difference = 0;
    int surfaces = 0;  // pixels
    for (int y = 0; y < small.height(); ++y) {
      for (int x = 0; x < small.width(); ++x) {
        if (qRed(picture.pixel(x, y)) > 0) {
          difference += std::abs(qGreen(picture.pixel(x, y)) - qGreen(shown->pixel(x, y)));
          ++surfaces;
        }
      }
    }
    QVERIFY(surfaces > small.width() * small.height() / 3);
    difference /= surfaces;
    QVERIFY2(difference < 6, qPrintable(QString::number(difference)));
    solved.window->colors.set_quantity(Quantity::reflectance);
    QVERIFY(!solved.window->findChild<QAction*>("copy_picture")->isEnabled());
  }

  void a_copied_map_is_that_of_the_direction() {
    const SolvedWindow solved("boards", {.directions = 8});
    QVERIFY(solved.ready);
    solved.window->focus.go_to({0, 3, 0});
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    const QTemporaryDir folder;
    const QString file = folder.filePath("map.json");
    QVERIFY(
        !output_of(copied(solved, "copy_map") + " --out " + file + " && echo written").isEmpty());
    QVERIFY(QFileInfo(file).size() > 100);
  }

  void a_copied_map_is_that_of_the_patch_whose_map_is_shown() {
    const SolvedWindow solved("cornell-box", {.directions = 8, .first_shot = {}});
    QVERIFY(solved.ready);
    Focus& focus = solved.window->focus;
    focus.go_to({0, 3, 0});
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    focus.show_whole();
    solved.window->selection.select(2);
    solved.map_view->choose_whole(MapView::Whole::patch);
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    const QString command = copied(solved, "copy_map");
    QVERIFY(command.contains("--receiver 2 "));
    const QTemporaryDir folder;
    QVERIFY(!output_of(command + " && echo done", folder.path()).isEmpty());
    solved.map_view->choose_whole(MapView::Whole::complete);
    QVERIFY(!copied(solved, "copy_map").contains("--receiver"));
  }

  void a_copied_command_runs_as_it_is_data() {
    QTest::addColumn<QString>("action");
    QTest::addColumn<int>("step");
    QTest::newRow("solve") << "copy_solve" << 12;
    QTest::newRow("map") << "copy_map" << 12;
    QTest::newRow("step") << "copy_step" << 12;
    QTest::newRow("whole direction") << "copy_step" << 1000;
  }
  /// The name of the scene's file needs quotes, and nothing is added to the command.
  void a_copied_command_runs_as_it_is() {
    QFETCH(QString, action);
    QFETCH(int, step);
    const QTemporaryDir folder;
    const QString room = folder.filePath("a room's file.obj");
    write_obj(room.toStdString(), describe_scene("cornell-box"));
    const SolvedWindow solved(room, {.directions = 8, .first_shot = {}});
    QVERIFY(solved.ready);
    Focus& focus = solved.window->focus;
    focus.go_to({0, 3, step});
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    QVERIFY(QDir(folder.path()).mkdir("empty"));
    const QDir empty(folder.filePath("empty"));
    QVERIFY(
        !output_of(copied(solved, qPrintable(action)) + " && echo done", empty.path()).isEmpty());
    if (action == "copy_solve") {
      return;
    }
    // The picture of that step.
    const bool all = action == "copy_map";
    const MapRecord& record = focus.map()->record();
    const std::size_t polygons =
        record.map_after(all ? record.step_count() - 1 : focus.position().step).size();
    const QByteArray picture = contents_of(empty.filePath("map.svg"));
    QVERIFY(picture.contains(", " + QByteArray::number(int(polygons)) + " polygons, "));
  }

  // A sheet that does not emit is made two-sided; if it emits, only one of its sides does.
  void a_lamp_in_a_scene_with_turned_faces_is_solved_before_it_is_copied() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("room.obj");
    write_obj(path.toStdString(), describe_scene("cornell-box"));
    const auto append = [&](const char* name, const QByteArray& text) {
      write_file(folder.filePath(name), contents_of(folder.filePath(name)) + text);
    };
    append("room.obj",
           "v .1 .1 .4\nv .3 .1 .4\nv .3 .3 .4\nv .1 .3 .4\nusemtl sheet\nf -4 -3 -2 -1\n");
    append("room.mtl", "newmtl sheet\nKd .5 .5 .5\n");
    const auto window = make_window(8);
    RunOptions options;
    options.solve = {.directions = 8, .first_shot = {}};
    options.input.orient = true;
    window->scene.open(path.toStdString(), options, {Goal::Kind::finished});
    const auto solved = [&] {
      return window->snapshot() && window->snapshot()->progress.finished && window->settled();
    };
    QVERIFY(wait_for(solved));
    QCOMPARE(window->snapshot()->loaded->scene->patch_count(), 29);
    window->relighting.edits().set_exitance("material:sheet", {1, 1, 1});
    QVERIFY(wait_for([&] { return window->snapshot()->materials && window->settled(); }));
    const auto* copy = window->findChild<QAction*>("copy_solve");
    QVERIFY(!copy->isEnabled() && copy->toolTip().contains("press Solve first"));
    window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] { return solved() && !window->snapshot()->materials; }));
    QCOMPARE(window->snapshot()->loaded->scene->patch_count(), 28);
    QVERIFY(copy->isEnabled());
    expect_same_bits(*window);
  }

 private:
  /// The results of the window and of the command that is copied from it have the same bits.
  static void expect_same_bits(const TestWindow& window) {
    window.findChild<QAction*>("copy_solve")->trigger();
    const QString command = QApplication::clipboard()->text() + " --quiet --out -";
    const QList<QByteArray> rows = output_of(command).split('\n');
    const QList<QByteArray> header = rows[0].split(',');
    const int column = header.indexOf("B_r");
    QVERIFY2(column >= 0, rows[0].constData());
    const std::vector<Rgb>& radiosity = window.snapshot()->radiosity;
    QCOMPARE(rows.size(), static_cast<int>(radiosity.size()) + 2);
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
      const QList<QByteArray> fields = rows[static_cast<int>(i) + 1].split(',');
      QCOMPARE(fields[column].toDouble(), radiosity[i].r);
      QCOMPARE(fields[column + 2].toDouble(), radiosity[i].b);
    }
  }
};

const test::Registered registered("command_text", test::run_as_viewer<CommandTextTest>);

}  // namespace transillum::viewer::command_text_test

#include "command_text_test.moc"
