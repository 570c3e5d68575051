// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Opening and exporting result files (.vtp) in the viewer's window.
#include <QAction>
#include <QCheckBox>
#include <QLabel>
#include <QTemporaryDir>

#include "solved_window.h"
#include "test_files.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "window/files/export_actions.h"
#include "window/files/file_actions.h"

namespace transillum::viewer::result_test {

using namespace test;

namespace {

bool settles(TestWindow& window) {
  return wait_for([&] { return window.settled(); });
}

}  // namespace

class ResultTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    path_ = folder_.filePath("r.vtp");
    written_ =
        solve(load_scene("boards", {.two_sided = true}), {.directions = 16, .first_shot = {}});
    write_result(path_.toStdString(), written_);
  }

  void a_result_file_is_shown_without_solving() {
    const auto window = make_window();
    window->files().open(path_);
    QVERIFY(settles(*window));
    const auto snapshot = window->snapshot();
    QVERIFY(snapshot->of_file);
    QVERIFY(snapshot->radiosity == written_.radiosity);
    QVERIFY(snapshot->irradiance == written_.irradiance);
    QCOMPARE(snapshot->progress.iteration, 0);
    QCOMPARE(snapshot->progress.direction, 0);
    QCOMPARE(snapshot->statistics.iteration_records.size(),
             written_.statistics.iteration_records.size());
    QVERIFY(text(*window, "color_note").contains("Values from the file r.vtp"));
    QVERIFY(text(*window, "phase").contains("From the file"));
    QVERIFY(window->windowTitle().startsWith("r.vtp"));
    window->colors.set_quantity(Quantity::irradiance);
    QVERIFY(window->colors.values() == written_.irradiance);
    save_picture(*window, "result");
  }

  void run_solves_its_patches_and_start_over_shows_the_file_again() {
    const auto window = make_window(16);
    window->files().open(path_);
    QVERIFY(settles(*window));
    QVERIFY(window->findChild<QCheckBox*>("two_sided")->isHidden());
    QVERIFY(window->views().settings.options().scene.two_sided);
    window->findChild<QAction*>("run")->trigger();
    QVERIFY(wait_for([&] { return window->runner.state() == RunState::finished; }));
    QVERIFY(settles(*window));
    QVERIFY(!window->snapshot()->of_file);
    // The new run has the same patches, options and sums.
    QVERIFY(window->snapshot()->radiosity == written_.radiosity);
    QVERIFY(!window->findChild<QLabel*>("color_note")->isVisible());

    window->findChild<QAction*>("stop")->trigger();
    QVERIFY(wait_for([&] { return window->snapshot()->of_file; }));
  }

  void an_exported_result_opens_with_the_same_values() {
    const QString path = folder_.filePath("exported.vtp");
    std::vector<Rgb> radiosity;
    {
      SolvedWindow solved("cornell-box");
      QVERIFY(solved.ready);
      radiosity = solved.window->snapshot()->radiosity;
      solved.window->findChild<ExportActions*>()->write_result(path);
      QVERIFY(wait_for([&] { return !solved.window->findChild<ExportActions*>()->writing(); }));
      QVERIFY(solved.window->banner_text().isEmpty());
      QVERIFY_EXCEPTION_THROWN(solved.window->findChild<ExportActions*>()->write_result("a.txt"),
                               InputError);
    }
    QVERIFY(!read_result(path.toStdString()).complete);
    const auto window = make_window();
    window->files().open(path);
    QVERIFY(settles(*window));
    QVERIFY(window->snapshot()->radiosity == radiosity);
    QVERIFY(text(*window, "color_note").contains("stopped early"));
  }

  void an_error_names_the_unreadable_file() {
    const QString bad = folder_.filePath("bad.vtp");
    write_file(bad, "<VTKFile type=\"PolyData\">");
    const auto window = make_window();
    window->files().try_open(bad);
    QVERIFY(wait_for([&] { return !window->banner_text().isEmpty(); }));
    QVERIFY(window->banner_text().startsWith(bad + ":1: "));
  }

  void a_session_reopens_the_result_file() {
    const QString session = folder_.filePath("s.json");
    {
      const auto window = make_window();
      window->files().open(path_);
      QVERIFY(settles(*window));
      window->files().save_session(session);
    }
    const auto window = make_window();
    window->files().open(session);
    QVERIFY(settles(*window));
    QVERIFY(window->snapshot()->of_file);
    QVERIFY(window->snapshot()->radiosity == written_.radiosity);
  }

 private:
  static QString text(TestWindow& window, const char* label) {
    return window.findChild<QLabel*>(label)->text();
  }

  QTemporaryDir folder_;
  QString path_;
  Solution written_;
};

const test::Registered registered("result", test::run_as_viewer<ResultTest>);

}  // namespace transillum::viewer::result_test

#include "result_test.moc"
