// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The study dialog and the values on the number of directions.
#include "solve/study_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QElapsedTimer>
#include <QFile>
#include <QImage>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>

#include "solve/convergence_view.h"
#include "solve/study_chart.h"
#include "solved_window.h"
#include "support/number_text.h"
#include "test_files.h"
#include "transillum/files.h"
#include "transillum/solve_session.h"
#include "widgets/banner.h"

namespace transillum::viewer::study_test {

using namespace test;

namespace {

/// A study of few passes, not started.
struct Shown : SolvedWindow {
  StudyDialog* dialog;

  explicit Shown(const char* scene, std::uint64_t memory = SolveOptions{}.memory)
      : SolvedWindow(scene, {.directions = 32, .first_shot = {}, .memory = memory}) {
    trigger("study");
    dialog = window->findChild<StudyDialog*>();
    for (const int m : {16, 32, 64, 128, 256, 512}) {
      choose(QString::number(m), m <= 64);
    }
    choose("hammersley", false);
  }
  void choose(const QString& name, bool on) const {
    dialog->findChild<QCheckBox*>("study_" + name)->setChecked(on);
  }
  QPushButton* run() const { return dialog->findChild<QPushButton*>("study_run"); }
  QString phase() const { return dialog->findChild<QLabel*>("study_phase")->text(); }
  QString cell(int row, int column) const {
    return dialog->findChild<QTableWidget*>("study_table")->item(row, column)->text();
  }
  void study() const {
    run()->click();
    QVERIFY(wait_for([this] { return phase() == "Done"; }));
  }
};

}  // namespace

class StudyTest : public QObject {
  Q_OBJECT

 private slots:
  void engines_are_compared_against_seconds() {
    const Shown shown("cornell-box");
    const auto* fast = shown.dialog->findChild<QCheckBox*>("study_engine_fast");
    QVERIFY(fast->isChecked());  // the engine of the solve
    shown.choose("engine_rays", true);
    shown.choose("random", false);
    shown.study();
    auto* table = shown.dialog->findChild<QTableWidget*>("study_table");
    QCOMPARE(table->rowCount(), 2);
    QVERIFY(shown.cell(0, 0).contains("fast") && shown.cell(1, 0).contains("rays"));
    auto* chart = shown.dialog->findChild<StudyChart*>();
    const QImage by_passes = chart->grab().toImage();
    auto* axis = shown.dialog->findChild<QComboBox*>("study_axis");
    axis->setCurrentIndex(1);
    QCOMPARE(table->horizontalHeaderItem(2)->text(), QString("Seconds for 1 %"));
    QVERIFY(chart->grab().toImage() != by_passes);
    save_picture(*shown.dialog, "study-by-engine");
    axis->setCurrentIndex(0);
    QCOMPARE(table->horizontalHeaderItem(2)->text(), QString("Passes for 1 %"));
    QCOMPARE(chart->grab().toImage(), by_passes);
  }

  void shows_errors_and_slopes() {
    const Shown shown("cornell-box");
    shown.choose("one_way", true);
    shown.study();
    const auto snapshot = shown.dialog->snapshot();
    QVERIFY(snapshot->study.complete);
    QCOMPARE(snapshot->study.points.size(), std::size_t{4 * 3});
    QCOMPARE(shown.cell(0, 0), QString("antipodal/two-way"));
    QVERIFY(shown.cell(0, 1).startsWith(QStringLiteral("−")));
    const QString rms_slope = shown.cell(0, 1);
    shown.dialog->findChild<QComboBox*>("study_error")->setCurrentIndex(1);
    QVERIFY(shown.cell(0, 1) != rms_slope);
    // The chart has colored lines.
    auto* chart = shown.dialog->findChild<StudyChart*>();
    QVERIFY(color_count(chart->grab().toImage()) > 8);
  }

  void saves_plots_and_values() {
    const Shown shown("furnace");
    shown.study();
    const QTemporaryDir folder;
    for (const char* name : {"s.svg", "s.pdf", "s.png", "s.csv"}) {
      shown.dialog->save(folder.filePath(name));
    }
    QCOMPARE(QImage(folder.filePath("s.png")).size(), QSize(1600, 960));
    QCOMPARE(contents_of(folder.filePath("s.csv")).count('\n'), 1 + 2 * 3);
    QVERIFY(QFile(folder.filePath("s.svg")).size() > 1000);
    QVERIFY(contents_of(folder.filePath("s.pdf")).startsWith("%PDF-"));
    shown.dialog->save(folder.filePath("s.eps"));
    QVERIFY(!QFile::exists(folder.filePath("s.eps")));
    auto* banner = shown.dialog->findChild<Banner*>();
    QVERIFY2(banner->text().contains("s.eps"), qPrintable(banner->text()));
  }

  void requires_a_scene_and_a_choice() {
    const auto window = make_window();
    const auto* dialog = window->findChild<StudyDialog*>();
    QVERIFY(!dialog->findChild<QPushButton*>("study_run")->isEnabled());
    const Shown shown("furnace");
    QVERIFY(shown.run()->isEnabled());
    shown.choose("two_way", false);
    QVERIFY(!shown.run()->isEnabled());
    QVERIFY(!shown.dialog->findChild<QPushButton*>("study_save")->isEnabled());
  }

  // Otherwise it would be a study of the materials from before the change.
  void changed_materials_are_solved_before_they_are_studied() {
    const Shown shown("furnace");
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    shown.window->relighting.edits().set_reflectance("material:" + scene.materials()[0].name,
                                                     {0.25, 0.25, 0.25});
    QTRY_VERIFY(!shown.run()->isEnabled());
    QVERIFY(shown.run()->toolTip().contains("press Solve first"));
    auto* measure = shown.window->findChild<QPushButton*>("measure_errors");
    QVERIFY(!measure->isEnabled() && measure->toolTip().contains("press Solve first"));
    shown.window->findChild<QPushButton*>("restart")->click();
    QTRY_VERIFY_WITH_TIMEOUT(shown.run()->isEnabled() && measure->isEnabled(), 60000);
    QCOMPARE(shown.window->snapshot()->loaded->scene->material(0).reflectance,
             (Rgb{0.25, 0.25, 0.25}));
    shown.study();
    QVERIFY(shown.dialog->snapshot()->loaded == shown.window->snapshot()->loaded);
  }

  // Nor is their light known where form factors exceed the memory limit.
  void materials_without_light_are_solved_before_they_are_studied() {
    const Shown shown("furnace", 1);
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    MaterialEdits& edits = shown.window->relighting.edits();
    edits.set_reflectance("material:" + scene.materials()[0].name, {0.25, 0.25, 0.25});
    QVERIFY(!shown.window->snapshot()->materials && !shown.run()->isEnabled());
    auto* measure = shown.window->findChild<QPushButton*>("measure_errors");
    QVERIFY(!measure->isEnabled() && measure->toolTip().contains("press Solve first"));
    edits.restore();
    QVERIFY(shown.run()->isEnabled() && measure->isEnabled());
  }

  void stops_while_the_reference_is_solved() {
    const Shown shown("rooms");
    shown.choose("16384", true);  // the reference takes four times as many
    shown.run()->click();
    QVERIFY(wait_for([&] { return shown.phase().startsWith("Reference"); }));
    QElapsedTimer timer;
    timer.start();
    shown.run()->click();
    QVERIFY(wait_for([&] { return shown.phase() == "Stopped"; }));
    QVERIFY2(timer.elapsed() < 2000, qPrintable(QString::number(timer.elapsed())));
    QCOMPARE(shown.run()->text(), QString("Run the study"));
  }

  /// Without a study, the numbers follow from the bounds and from the run.
  void the_summary_shows_the_directions_for_one_percent() {
    const auto window = make_window();
    window->set_options({.directions = 96, .replicas = 4}, {});
    window->open("cornell-box");
    QVERIFY(wait_for([&] { return window->snapshot() && window->snapshot()->progress.finished; }));
    const auto text = [&](const char* name) { return window->findChild<QLabel*>(name)->text(); };
    QVERIFY(wait_for([&] { return text("summary_estimate").startsWith(QStringLiteral("M ≈")); }));
    const double rho = window->snapshot()->loaded->measures.rho_max;
    const QString bound = number_text(directions_if_homogeneous(rho, 0.01));
    QVERIFY2(text("summary_bound").startsWith(QString("M = %1 (eq. 37)").arg(bound)),
             qPrintable(text("summary_bound")));
  }

  void the_summary_measures_what_faces_cost_and_colors_show_it() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    auto* time = shown.window->findChild<QLabel*>("summary_time");
    QVERIFY2(time->text().contains("Measure"), qPrintable(time->text()));
    QCOMPARE(shown.text("summary_costly"), QString("–"));
    emit time->linkActivated("measure");
    QVERIFY(wait_for([&] { return time->text().endsWith(" ms"); }));
    QVERIFY(shown.text("summary_candidates").endsWith(" per query"));
    QVERIFY(shown.text("summary_exact").startsWith("none"));
    const QStringList faces = shown.text("summary_costly").split('\n');
    QCOMPARE(faces.size(), 5);
    QVERIFY2(faces[0].startsWith("face ") && faces[0].contains(" %, "), qPrintable(faces[0]));

    ColorChoice& colors = shown.window->colors;
    colors.set_quantity(Quantity::query_time);
    QVERIFY(wait_for([&] { return !colors.values().empty(); }));
    QCOMPARE(colors.values().size(), std::size_t(shown.window->snapshot()->radiosity.size()));
    double sum = 0;
    for (const Rgb& microseconds : colors.values()) {
      QVERIFY(microseconds.r >= 0);
      sum += microseconds.r;
    }
    QCOMPARE(time->text(), number_text(1e-3 * sum) + " ms");
    colors.set_quantity(Quantity::exact_queries);
    QVERIFY(!colors.values().empty());  // by the same measurement
    shown.window->selection.select(2);
    QVERIFY2(colors.note().contains("candidates"), qPrintable(colors.note()));

    // Another solve was not measured.
    colors.set_quantity(Quantity::radiosity);
    shown.window->set_options({.directions = 16, .engine = Engine::zbuffer, .first_shot = {}}, {});
    shown.window->open("cornell-box");
    QVERIFY(wait_for([&] { return time->text().contains("Measure"); }));
    colors.set_quantity(Quantity::query_time);
    QVERIFY(wait_for([&] { return colors.missing().contains("choose fast"); }));
    QVERIFY2(time->text().contains("choose fast"), qPrintable(time->text()));
    QVERIFY(colors.values().empty());
  }

  /// The directions of a replica hardly meet the small sources. Earlier, the row showed only
  /// errors.
  void the_summary_names_errors_that_cannot_be_trusted() {
    const auto window = make_window();
    const auto* row = window->findChild<QLabel*>("summary_error");
    const auto shows = [&](const QString& scene, int directions, const QString& end) {
      window->set_options({.directions = directions, .first_shot = {}, .replicas = 4}, {});
      window->open(scene);
      return wait_for([&] {
        const auto& snapshot = window->snapshot();
        return snapshot && snapshot->progress.finished && window->settled() &&
               snapshot->options.directions == directions && row->text().endsWith(end) &&
               row->text().contains(" %; no surface above ");
      });
    };
    const Solution solution =
        solve(load_scene("stars"), {.directions = 512, .first_shot = {}, .replicas = 4});
    const QString count = count_text(std::ssize(uncertain_patches(solution)));
    QVERIFY2(shows("stars", 512, QString(" %;\ncannot be trusted on %1 patches").arg(count)),
             qPrintable(row->text()));
    QVERIFY2(shows("stars", 64, " %;\ncannot be trusted"), qPrintable(row->text()));
    QVERIFY2(shows("furnace", 128, " %"), qPrintable(row->text()));
  }

  void stopping_at_once_works() {
    const Shown shown("cornell-box");
    for (int k = 0; k < 5; ++k) {
      shown.run()->click();
      shown.run()->click();
      QVERIFY(wait_for([&] { return shown.run()->text() == "Run the study"; }));
    }
  }

  void changes_stay_below_the_prediction() {
    // For a scene of higher reflectance, eq. 21 gives no bound with 64 directions.
    const SolvedWindow shown("furnace");
    shown.window->runner.run();
    QVERIFY(wait_for([&] { return shown.window->snapshot()->progress.finished; }));
    const auto snapshot = shown.window->snapshot();
    const auto& steps = snapshot->statistics.iteration_records;
    const std::vector<double> predicted = predicted_changes(*snapshot);
    QVERIFY(predicted.size() >= steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) {
      QVERIFY(steps[k].change_of_b <= predicted[k] * (1 + 1e-12));
    }
  }

  void opening_another_scene_ends_the_study() {
    const Shown shown("cornell-box");
    shown.choose("16384", true);
    shown.run()->click();
    QVERIFY(wait_for([&] { return shown.dialog->snapshot() != nullptr; }));
    shown.window->open("furnace");
    QVERIFY(wait_for([&] { return shown.dialog->snapshot() == nullptr; }));
    QCOMPARE(shown.run()->text(), QString("Run the study"));
    // The last snapshot of the ended study comes before the first one of the next study: it is not
    // shown.
    shown.choose("16384", false);
    shown.run()->click();
    bool others = false;
    QVERIFY(wait_for([&] {
      const auto snapshot = shown.dialog->snapshot();
      others = others || (snapshot && snapshot->loaded->scene->name() != "furnace");
      return shown.phase() == "Done";
    }));
    QVERIFY(!others);
    QCOMPARE(shown.dialog->snapshot()->loaded->scene->name(), std::string("furnace"));
  }
};

const test::Registered registered("study", test::run_as_viewer<StudyTest>);

}  // namespace transillum::viewer::study_test

#include "study_test.moc"
