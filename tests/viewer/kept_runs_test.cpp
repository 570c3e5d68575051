// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Kept runs: shown while a key is held, named, compared and removed.
#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QTableWidget>
#include <QToolButton>

#include "inspected_window.h"
#include "model/run_comparison.h"

namespace transillum::viewer::kept_runs_test {

using namespace test;

namespace {

/// Two kept runs, of one and two iterations; the second is the current one.
struct KeptRuns : Inspected {
  QTableWidget* table;
  QComboBox* first;

  KeptRuns()
      : Inspected("cornell-box"),
        table(part<QTableWidget>("run_table")),
        first(part<QComboBox>("run_a")) {
    ready = ready && raise("runs_dock");
    trigger("keep_run");
    window->runner.advance_one_iteration();
    ready = ready && wait_for([this] {
              return window->snapshot()->progress.iteration == 2 && window->settled();
            });
    trigger("keep_run");
  }
  bool rename_first() const {
    table->setFocus();
    table->setCurrentCell(0, 0);
    QTest::keyClick(table, Qt::Key_F2);
    auto* editor = table->findChild<QLineEdit*>();
    QTest::keyClicks(editor, "one bounce");
    QTest::keyClick(editor, Qt::Key_Return);
    return wait_for([this] { return first->itemText(0) == "one bounce"; });
  }
};

}  // namespace

class KeptRunsTest : public QObject {
  Q_OBJECT

 private slots:
  void holding_a_key_shows_the_kept_run() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    shown.trigger("keep_run");
    shown.window->colors.set_automatic_exposure(false);
    shown.window->runner.advance_one_iteration();
    QVERIFY(wait_for([&] {
      return shown.window->snapshot()->progress.iteration == 2 && shown.window->settled();
    }));
    const auto second = shown.window->colors.patch_colors();
    const QWidget& canvas = *shown.scene_view->canvas();
    const auto place = [&canvas] { return QRect(canvas.mapToGlobal(QPoint()), canvas.size()); };
    const QRect before = place();
    QTest::keyPress(shown.window.get(), Qt::Key_A);
    QVERIFY(shown.window->colors.shows_kept_run());
    QVERIFY(shown.window->colors.patch_colors() != second);
    // For a blink comparison nothing may move: only colors change.
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(shown.part<QLabel>("kept_run_label")->isVisible());
    QCOMPARE(place(), before);
    QTest::keyRelease(shown.window.get(), Qt::Key_A);
    QVERIFY(shown.window->colors.patch_colors() == second);
    QVERIFY(!shown.part<QLabel>("kept_run_label")->isVisible());
    shown.trigger("show_difference");
    QVERIFY(shown.window->colors.quantity() == Quantity::difference);
    QVERIFY(shown.window->colors.missing().isEmpty());
  }

  void kept_runs_are_listed_and_named() {
    const KeptRuns shown;
    QVERIFY(shown.ready);
    QCOMPARE(shown.table->rowCount(), 2);
    QCOMPARE(shown.table->item(0, 1)->text(), QString("32"));
    QCOMPARE(shown.table->item(0, 2)->text(), QString("Antipodal"));
    QVERIFY(shown.table->item(0, 0)->toolTip().contains("--directions 32"));
    QVERIFY(shown.rename_first());
    QCOMPARE(shown.table->item(0, 0)->text(), QString("one bounce"));
  }

  void kept_runs_are_compared() {
    const KeptRuns shown;
    QVERIFY(shown.ready && shown.rename_first());
    // The current run is the second one; A becomes the first.
    QVERIFY(shown.text("run_difference").contains("No difference"));
    QCOMPARE(shown.first->currentText(), QString("Run 2"));
    QTest::keyClick(shown.first, Qt::Key_Up);
    QCOMPARE(shown.first->currentText(), QString("one bounce"));
    const auto with_current = shown.text("run_difference");
    // The worst surface first, the RMS over everything last.
    const std::string worst_name =
        compare_runs(*shown.window->colors.run_a(), *shown.window->colors.run_b())
            .surfaces.front()
            .name;
    QVERIFY2(with_current.startsWith(QString::fromStdString(worst_name) + ": RMS "),
             qPrintable(with_current));
    QVERIFY(with_current.indexOf("RMS over all surfaces") > with_current.indexOf("largest"));
    QVERIFY(shown.part<QLabel>("run_difference")->toolTip().contains("by surface"));
    auto* second = shown.part<QComboBox>("run_b");
    QTest::keyClick(second, Qt::Key_End);
    QCOMPARE(second->currentText(), QString("Run 2"));
    QCOMPARE(shown.text("run_difference"), with_current);
    shown.trigger("show_difference");
    QVERIFY(shown.window->colors.missing().isEmpty());
    save_picture(*shown.window, "kept-runs");

    const ViewPoint before = shown.scene_view->view_point();
    QTest::mouseClick(shown.part<QToolButton>("go_to_difference"), Qt::LeftButton);
    const PatchId worst = shown.window->selection.patch();
    QVERIFY(with_current.contains(QString("patch %1").arg(worst)));
    QVERIFY(distance_of(before, shown.scene_view->view_point()) > 0);
  }

  void a_kept_run_is_removed_with_undo() {
    const KeptRuns shown;
    QVERIFY(shown.ready && shown.rename_first());
    QTest::keyClick(shown.first, Qt::Key_Up);
    const auto with_first = shown.text("run_difference");
    shown.window->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(shown.window.get()));
    shown.table->setFocus();
    shown.table->setCurrentCell(0, 0);
    QTest::keyClick(shown.table, Qt::Key_Delete);
    QCOMPARE(shown.table->rowCount(), 1);
    QVERIFY(shown.text("run_difference").contains("No difference"));
    shown.trigger("undo");
    QCOMPARE(shown.table->item(0, 0)->text(), QString("one bounce"));
    QCOMPARE(shown.text("run_difference"), with_first);
  }

  void kept_runs_of_another_scene_stay_and_say_why_they_are_not_compared() {
    const KeptRuns shown;
    QVERIFY(shown.ready);
    shown.window->open("furnace", {Goal::Kind::iteration});
    QVERIFY(wait_for([&] { return shown.window->snapshot() && shown.first->currentIndex() < 0; }));
    QVERIFY(!shown.first->isEnabled() && !shown.window->colors.run_a());
    QVERIFY(!shown.part<QAction>("show_kept_run")->isEnabled());
    shown.table->setCurrentCell(1, 0);
    QVERIFY(shown.text("run_hint").contains("cornell-box"));
    QVERIFY(shown.part<QLabel>("run_hint")->isVisible());
  }
};

const test::Registered registered("kept_runs", test::run_as_viewer<KeptRunsTest>);

}  // namespace transillum::viewer::kept_runs_test

#include "kept_runs_test.moc"
