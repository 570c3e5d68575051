// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The line at the bottom of the window, on a solve that has ended. Snapshots come from
// solved_snapshot(), without a window.
#include "solve/progress_line.h"

#include <QLabel>
#include <QProgressBar>
#include <QTest>

#include "model/solver/session_snapshot.h"
#include "registered.h"
#include "solved_snapshot.h"
#include "support/number_text.h"
#include "widgets/elided.h"
#include "window_support.h"

namespace transillum::viewer::progress_line_test {

namespace {

/// A solve that has reached 1 %.
std::shared_ptr<SolverSnapshot> reached(const std::string& surface) {
  auto snapshot = test::solved_snapshot("cornell-box", 32);
  AccuracyReport report;
  report.goal.accuracy = 0.01;
  report.error = 0.00873;
  report.surface = surface;
  report.reached = true;
  report.passes_made = 12'345;
  snapshot->accuracy = report;
  snapshot->progress.finished = true;
  return snapshot;
}

}  // namespace

class ProgressLineTest : public QObject {
  Q_OBJECT

 private slots:
  void good_enough_names_the_worst_surface() {
    ProgressLine line;
    line.show_state(RunState::finished);
    line.show_snapshot(reached("back wall"));
    QCOMPARE(line.findChild<QLabel*>("phase")->text(),
             QString("Good enough: error by directions of the worst surface, back wall, at most "
                     "0.873 % (limit 1 %), %1 passes")
                 .arg(count_text(12'345)));
  }

  void a_long_name_is_elided_in_its_middle_and_fits_a_small_window() {
    ProgressLine line;
    line.show_scene(*reached("")->loaded);
    line.show_state(RunState::finished);
    line.show_snapshot(reached("back wall of the living room, left of the window, above the door"));
    line.resize(1280, line.sizeHint().height());
    line.show();
    QVERIFY(QTest::qWaitForWindowExposed(&line));
    const auto& phase = *line.findChild<ElidedLabel*>("phase");
    QVERIFY2(phase.text().contains(QString::fromUtf8("surface, back wall … the door,")),
             qPrintable(phase.text()));
    QCOMPARE(phase.shown_text(), phase.text());
    QVERIFY(phase.toolTip().contains("left of the window"));
    // A window that is narrower still keeps the two ends, and is not widened by the text.
    line.resize(700, line.height());
    QVERIFY(line.minimumSizeHint().width() <= 700);
    QCoreApplication::processEvents();
    QVERIFY(phase.shown_text().startsWith("Good") && phase.shown_text().endsWith("passes"));
  }

  // An accuracy that the solve has reached is no promise for other materials.
  void changed_materials_have_their_own_iterations() {
    const auto snapshot = reached("back wall");
    auto materials = std::make_shared<PatchMaterials>();
    const Scene& scene = *snapshot->loaded->scene;
    materials->materials = scene.materials();
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      materials->of_patch.push_back(scene.patch(i).material);
    }
    snapshot->materials = materials;
    snapshot->statistics.iterations = 34;
    ProgressLine line;
    line.show_state(RunState::finished);
    line.show_snapshot(snapshot);
    QCOMPARE(line.findChild<QLabel*>("phase")->text(),
             QString("Changed materials: light after 34 iterations"));
    QVERIFY(line.findChild<QLabel*>("phase")->toolTip().isEmpty());
  }

  void a_finished_solve_has_no_bar() {
    const auto snapshot = reached("back wall");
    ProgressLine line;
    const auto& bar = *line.findChild<QProgressBar*>("progress");
    line.show_state(RunState::paused);
    line.show_snapshot(snapshot);
    QVERIFY(!bar.isHidden());
    line.show_state(RunState::finished);
    QVERIFY(bar.isHidden());
    line.show_state(RunState::running);
    QVERIFY(!bar.isHidden());
  }

  // A bar that is full, or has the value of before, does not say that the solve continues.
  void between_iterations_an_empty_bar_says_that_the_next_begins() {
    const auto snapshot = test::solved_snapshot("cornell-box", 32);
    snapshot->progress.iteration = 2;
    snapshot->progress.direction = 0;
    ProgressLine line;
    const auto& phase = *line.findChild<QLabel*>("phase");
    const auto& bar = *line.findChild<QProgressBar*>("progress");
    line.show_state(RunState::running);
    line.show_snapshot(snapshot);
    QVERIFY(bar.value() < bar.minimum() && bar.text().isEmpty());
    QCOMPARE(phase.text(), QString("2 iterations done, the next begins"));
    line.show_state(RunState::paused);
    QCOMPARE(phase.text(), QString("Paused: 2 iterations done"));
    auto within = std::make_shared<SolverSnapshot>(*snapshot);
    within->progress.direction = 8;
    line.show_snapshot(within);
    QCOMPARE(bar.value(), 8);
    line.show_snapshot(snapshot);
    QVERIFY(bar.value() < bar.minimum());
  }

  // Iterations without passes have no directions to count.
  void iterations_from_kept_form_factors_have_a_progress_of_their_own() {
    const auto loaded = test::solved_snapshot("cornell-box", 32)->loaded;
    SolveOptions options{.directions = 32};
    options.first_shot.reset();
    for (const int most : {0, 5}) {
      options.iterations = most;
      SolveSession session({.scene = loaded->scene, .options = options, .tree = loaded->tree});
      session.prepare();
      ProgressLine line;
      const auto& bar = *line.findChild<QProgressBar*>("progress");
      line.show_state(RunState::running);
      double before = 0;
      while (true) {
        session.advance(SolveSession::Until::iteration);
        if (session.finished()) {
          break;
        }
        line.show_snapshot(std::make_shared<SolverSnapshot>(snapshot_of(session, loaded)));
        const QString phase = line.findChild<QLabel*>("phase")->text();
        QVERIFY2(phase.endsWith("done"), qPrintable(phase));
        const double fraction = 1.0 * bar.value() / bar.maximum();
        QVERIFY2(fraction > before && fraction < 1, qPrintable(bar.text()));
        before = fraction;
      }
      QVERIFY2(before > 0.75, qPrintable(QString::number(before)));
    }
  }

  // A bar without an end moves on by itself.
  void what_is_not_under_way_does_not_move() {
    ProgressLine line;
    const auto& bar = *line.findChild<QProgressBar*>("progress");
    for (const RunState state : {RunState::paused, RunState::empty, RunState::finished}) {
      line.show_state(RunState::loading);
      line.show_loading("Reading", -1);
      QVERIFY(!bar.isHidden() && bar.maximum() == 0);
      line.show_state(state);
      QVERIFY(bar.isHidden() && bar.maximum() > 0);
    }
  }

  // Where an iteration has ended, nothing of the bar is filled.
  void a_bar_that_has_an_end_does_not_move() {
    const auto snapshot = test::solved_snapshot("cornell-box", 32);
    snapshot->progress.finished = false;
    snapshot->progress.iteration = 1;
    snapshot->progress.direction = snapshot->progress.passes;
    snapshot->statistics.kept_form_factors = false;
    ProgressLine line;
    line.resize(1000, line.sizeHint().height());
    line.show();
    QVERIFY(QTest::qWaitForWindowExposed(&line));
    line.show_state(RunState::loading);
    line.show_loading("Reading", -1);
    QVERIFY(test::wait_for([&] { return test::changes_later(line); }));
    line.show_state(RunState::running);
    line.show_snapshot(snapshot);
    const auto& bar = *line.findChild<QProgressBar*>("progress");
    QVERIFY(bar.isVisible() && bar.maximum() > 0 && bar.value() <= 0);
    line.grab();  // the style draws it
    QVERIFY(!test::changes_later(line));
  }

  void a_surface_in_the_dark_is_said_to_be_so() {
    const auto snapshot = reached("cellar");
    snapshot->accuracy->is_dark = true;
    ProgressLine line;
    line.show_state(RunState::finished);
    line.show_snapshot(snapshot);
    QVERIFY(line.findChild<QLabel*>("phase")->toolTip().contains("in the dark"));
  }
};

const test::Registered registered("progress_line", test::run_as_viewer<ProgressLineTest>);

}  // namespace transillum::viewer::progress_line_test

#include "progress_line_test.moc"
