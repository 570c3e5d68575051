// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The tab "Errors" of the panel "Surfaces": errors of surfaces by cause, measured on request, the
// step that makes them smaller, and the errors of patches in color.
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/results/error_report_files.h"
#include "patches/error_page.h"
#include "patches/patch_table.h"
#include "session/divisions.h"
#include "session/measure_errors.h"
#include "session/next_steps.h"
#include "session/total_plan.h"
#include "solved_window.h"
#include "transillum/errors.h"
#include "window/base/dock_layouts.h"
#include "window/files/export_actions.h"

namespace transillum::viewer::errors_test {

using namespace test;

namespace {

const SolveOptions few{.directions = 48, .first_shot = {}, .replicas = 4};

/// The report of a solve by the library.
ErrorReport report_of(const std::shared_ptr<const Scene>& scene, const SolveOptions& options) {
  SolveSession session({.scene = scene, .options = options});
  session.advance(SolveSession::Until::finished);
  return measure_errors(measured_solve(session));
}

/// The corners of all patches: x, y and z of each.
std::vector<std::array<double, 3>> outlines_of(const Scene& scene) {
  std::vector<std::array<double, 3>> corners;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      const Vec3& point = scene.point(p);
      corners.push_back({point.x, point.y, point.z});
    }
  }
  return corners;
}

/// An open scene with the tab in front.
struct Shown : SolvedWindow {
  ErrorPage* page;
  QPushButton* measure;

  explicit Shown(const QString& scene = "cornell-box", const SolveOptions& options = few)
      : SolvedWindow(scene, options),
        page(window->findChild<ErrorPage*>()),
        measure(window->findChild<QPushButton*>("measure_surfaces")) {
    window->views().docks.bring_to_front("parts");
    window->findChild<QTabWidget*>("surface_tabs")->setCurrentWidget(page->widget());
  }
  std::shared_ptr<const MeasuredErrors> errors() const {
    const auto errors = window->colors.errors();
    return errors && window->snapshot() && errors->are_of(*window->snapshot()) ? errors : nullptr;
  }
  bool measures() const {
    measure->click();
    return wait_for([&] { return errors() && !page->busy(); });
  }
  PatchTable& table() const {
    return *qobject_cast<PatchTable*>(window->findChild<QTableView*>("error_table")->model());
  }
  QString caption() const { return text("error_table_caption"); }
  bool finishes() const {
    return wait_for([&] {
      return window->runner.state() == RunState::finished && window->snapshot() &&
             window->snapshot()->progress.finished;
    });
  }
  void set_dark(bool dark) const {
    if (window->findChild<QAction*>("dark")->isChecked() != dark) {
      trigger("dark");
    }
  }
};

/// The step of a kind.
const NextStep* step_of(const ErrorReport& report, NextStep::Kind kind) {
  const auto found = std::find_if(report.steps.begin(), report.steps.end(),
                                  [&](const NextStep& step) { return step.kind == kind; });
  return found == report.steps.end() ? nullptr : &*found;
}

}  // namespace

class ErrorsTest : public QObject {
  Q_OBJECT

 private slots:
  void before_a_measurement_it_says_what_one_gets() {
    const Shown shown;
    QVERIFY(shown.ready);
    QVERIFY2(shown.caption().startsWith("How wrong is it?"), qPrintable(shown.caption()));
    QCOMPARE(shown.table().rowCount(), 0);
    QVERIFY(shown.measure->isEnabled());
    QVERIFY(!shown.window->findChild<QPushButton*>("save_errors")->isEnabled());
    QVERIFY(!shown.window->findChild<QToolButton*>("error_step")->isVisible());
    QVERIFY(!shown.window->findChild<QLabel*>("error_total")->isVisible());
    QVERIFY(!shown.window->findChild<QWidget*>("hide_surface_button")->isVisible());
    save_picture(*shown.window, "errors-empty");
    shown.window->colors.set_quantity(Quantity::measured_error);
    QVERIFY(shown.window->colors.missing().contains("Measure"));
  }

  // The solve has made one iteration: it is finished first.
  void the_numbers_are_those_of_the_library() {
    const Shown shown;
    QVERIFY(shown.ready);
    QVERIFY(!shown.window->snapshot()->progress.finished);
    QVERIFY(shown.measures());
    const ErrorReport expected = report_of(shown.window->snapshot()->loaded->scene, few);
    const ErrorReport& report = shown.errors()->report;
    QCOMPARE(report.surfaces.size(), expected.surfaces.size());
    QCOMPARE(report.worst, expected.worst);
    for (std::size_t s = 0; s < report.surfaces.size(); ++s) {
      const CauseErrors &a = report.surfaces[s].errors, &b = expected.surfaces[s].errors;
      QCOMPARE(a.directions, b.directions);
      QCOMPARE(a.patches, b.patches);
      QCOMPARE(a.iterations, b.iterations);
      QCOMPARE(a.method, b.method);
    }
    QVERIFY(report.relative_errors == expected.relative_errors);

    // The table has them, in percent, the worst first.
    std::ostringstream csv;
    shown.table().write_csv(csv);
    const QStringList lines = QString::fromStdString(csv.str()).split('\n', Qt::SkipEmptyParts);
    QCOMPARE(lines.size(), int(expected.surfaces.size()) + 1);
    const SurfaceCauses& worst = expected.surfaces.at(std::size_t(expected.worst));
    const QStringList cells = lines[1].split(',');
    QCOMPARE(cells[0], QString::fromStdString(worst.name));
    QCOMPARE(cells[1].toDouble(), 100 * worst.errors.total());
    QCOMPARE(cells[3].toDouble(), 100 * worst.errors.patches);
    for (int k = 2; k < lines.size(); ++k) {
      QVERIFY(lines[k].split(',')[1].toDouble() <= lines[k - 1].split(',')[1].toDouble());
    }
    QVERIFY(shown.text("error_total").contains(QString::fromStdString(worst.name)));
    save_picture(*shown.window, "errors");
  }

  void patches_are_colored_by_their_error() {
    const Shown shown;
    QVERIFY(shown.measures());
    shown.window->colors.set_quantity(Quantity::measured_error);
    const std::vector<double>& errors = shown.errors()->report.relative_errors;
    const std::vector<Rgb>& values = shown.window->colors.values();
    QCOMPARE(values.size(), errors.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      QCOMPARE(values[i].r, 100 * errors[i]);
    }
    QVERIFY(comes_to_rest(*shown.window));
    shown.set_dark(true);
    shown.window->resize(1280, 720);
    QVERIFY(comes_to_rest(*shown.window));
    save_picture(*shown.window, "errors-dark");
    shown.set_dark(false);
  }

  void the_button_carries_out_the_first_step() {
    const Shown shown;
    QVERIFY(shown.measures());
    const auto before = shown.errors();
    auto* button = shown.window->findChild<QToolButton*>("error_step");
    QVERIFY(button->isVisible());
    // Few directions are the largest error.
    const NextStep step = before->report.steps.front();
    QVERIFY(step.kind == NextStep::Kind::directions);
    QVERIFY2(button->text().startsWith("More directions: " + QString::number(step.passes)),
             qPrintable(button->text()));
    button->click();
    QVERIFY(wait_for([&] {
      return shown.window->snapshot() && shown.window->snapshot()->statistics.passes == step.passes;
    }));
    QVERIFY(shown.finishes());
    QVERIFY(shown.window->snapshot()->loaded == before->loaded);
    QVERIFY(!shown.errors());
  }

  void a_step_divides_a_surface() {
    const Shown shown("cornell-box", {.directions = 1024, .first_shot = {}, .replicas = 4});
    QVERIFY(shown.measures());
    const auto before = shown.errors();
    auto* button = shown.window->findChild<QToolButton*>("error_step");
    const NextStep* step = step_of(before->report, NextStep::Kind::divide_surface);
    QVERIFY(step != nullptr);
    const std::vector<PatchId> divided = divided_patches(*step, before->solve);
    QVERIFY(!divided.empty());
    button->menu()->actions().at(int(step - before->report.steps.data()))->trigger();
    QVERIFY(wait_for([&] {
      return shown.window->snapshot() && shown.window->snapshot()->loaded != before->loaded;
    }));
    QVERIFY(shown.finishes());
    const SolverSnapshot& snapshot = *shown.window->snapshot();
    QCOMPARE(std::int64_t(snapshot.loaded->scene->patch_count()), step->patches);
    QCOMPARE(whole_of(snapshot.loaded), whole_of(before->loaded));
    QCOMPARE(snapshot.statistics.passes, step->passes);
    // The copied command and the session divide the same patches.
    shown.trigger("copy_solve");
    const QString command = QApplication::clipboard()->text();
    QVERIFY2(command.contains("--divide " + QString::fromStdString(step->surface)),
             qPrintable(command));
    QVERIFY(outlines_of(*divided_scene(load_scene("cornell-box"), {step->surface})) ==
            outlines_of(*snapshot.loaded->scene));
    QVERIFY_EXCEPTION_THROWN(divided_scene(load_scene("cornell-box"), {"roof"}), InputError);
    const QTemporaryDir folder;
    const QString session = folder.filePath("s.json");
    shown.window->files().save_session(session);
    const auto other = make_window(16);
    other->files().open(session);
    QVERIFY(wait_for([&] { return other->snapshot() && other->settled(); }));
    QVERIFY(outlines_of(*other->snapshot()->loaded->scene) == outlines_of(*snapshot.loaded->scene));
    QVERIFY(!shown.window->views().settings.differ_from_effect());
    // The errors belonged to the solve before.
    QCOMPARE(shown.table().rowCount(), 0);
    QVERIFY(shown.measures());
    const auto after = shown.errors();
    const auto total = [&](const MeasuredErrors& errors) {
      for (const SurfaceCauses& surface : errors.report.surfaces) {
        if (surface.name == step->surface) {
          return surface.errors.total();
        }
      }
      return 0.0;
    };
    QVERIFY2(total(*after) < total(*before),
             qPrintable(QString("%1 to %2").arg(total(*before)).arg(total(*after))));
  }

  void steps_about_passes_keep_divided_patches() {
    const Shown shown;
    QVERIFY(shown.measures());
    const auto first = shown.errors();
    emit shown.page->step_chosen(*step_of(first->report, NextStep::Kind::divide_all));
    QVERIFY(wait_for([&] {
      return shown.window->snapshot() && shown.window->snapshot()->loaded != first->loaded;
    }));
    QVERIFY(shown.finishes());
    QVERIFY(shown.measures());
    const auto divided = shown.errors();
    QVERIFY(divided->loaded->divided == std::vector<std::string>{"all"});
    NextStep more = divided->report.steps.front();
    more.kind = NextStep::Kind::directions;
    more.passes = 2 * divided->solve.options.directions;
    emit shown.page->step_chosen(more);
    QVERIFY(wait_for([&] {
      return shown.window->snapshot() &&
             shown.window->snapshot()->options.directions == more.passes;
    }));
    QVERIFY(shown.finishes());
    QVERIFY(shown.window->snapshot()->loaded == divided->loaded);
    // The settings solve the scene as it was read.
    shown.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] {
      return shown.window->snapshot() && shown.window->snapshot()->loaded == first->loaded;
    }));
  }

  void the_settings_lead_to_the_errors() {
    const Shown shown;
    shown.window->runner.set_goal({Goal::Kind::finished});
    QVERIFY(shown.finishes());
    shown.window->findChild<QTabWidget*>("surface_tabs")->setCurrentIndex(0);
    shown.window->views().docks.bring_to_front("paths");
    shown.window->views().docks.bring_to_front("settings");
    auto* how_wrong = shown.window->findChild<QPushButton*>("how_wrong");
    QTRY_VERIFY(how_wrong->isVisible());
    how_wrong->click();
    QTRY_VERIFY(shown.measure->isVisible());
  }

  void changed_materials_are_solved_first() {
    const Shown shown;
    shown.window->relighting.edits().set_reflectance("material:white", {0.3, 0.3, 0.3});
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(shown.measures());
    const Scene& scene = *shown.errors()->loaded->scene;
    bool changed = false;
    for (const Material& material : scene.materials()) {
      changed = changed || (material.name == "white" && material.reflectance == Rgb{0.3, 0.3, 0.3});
    }
    QVERIFY(changed);
  }

  void a_measurement_is_canceled() {
    const Shown shown("sphere-flake", {.directions = 128, .first_shot = {}, .replicas = 4});
    QVERIFY(shown.ready);
    shown.measure->click();
    QVERIFY(wait_for([&] { return shown.page->busy(); }));
    QCOMPARE(shown.measure->text(), QString("Cancel"));
    const auto* bar = shown.window->findChild<QProgressBar*>("error_progress");
    QVERIFY(wait_for([&] { return bar->isVisible() && bar->value() > 0; }));
    save_picture(*shown.window, "errors-busy");
    shown.measure->click();
    QVERIFY(!shown.page->busy());
    QCOMPARE(shown.measure->text(), QString("Measure"));
    QVERIFY(shown.caption().startsWith("How wrong is it?"));
    QVERIFY(!bar->isVisible());
    QVERIFY(!shown.window->colors.errors());
    QVERIFY(shown.window->banner_text().isEmpty());
  }

  void a_scheme_without_a_report_says_so() {
    SolveOptions options = few;
    options.scheme = Scheme::semi_iterative;
    const Shown shown("cornell-box", options);
    QVERIFY(shown.ready);
    QVERIFY(!shown.measure->isEnabled());
    QVERIFY2(shown.caption().contains("semi-iterative"), qPrintable(shown.caption()));
  }

  void an_accuracy_in_all_is_solved_as_by_the_library() {
    const Shown shown;
    shown.window->findChild<QLineEdit*>("accuracy")->setText("40");
    auto* of = shown.window->findChild<QComboBox*>("accuracy_of");
    of->setCurrentText("all errors together");
    shown.window->findChild<QSpinBox*>("refine_patches")->setValue(5000);
    const RunOptions options = shown.window->views().settings.options();
    QVERIFY(options.total);
    QVERIFY(shown.window->findChild<QComboBox*>("refine_by")->parentWidget()->isHidden());
    const auto scene = shown.window->snapshot()->loaded->scene;
    TotalPlan plan({.scene = scene, .options = options.solve}, {.total = 0.4, .patches = 5000});
    while (!plan.finished()) {
      SolveSession session(plan.stage());
      session.advance(SolveSession::Until::finished);
      plan.assess(session);
    }
    const TotalSolve& expected = plan.outcome();
    QVERIFY(expected.stages.size() > 1);

    // A pause, perhaps while errors are measured, changes no bit.
    shown.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] {
      const auto snapshot = shown.window->snapshot();
      return snapshot && snapshot->total && !snapshot->total->stages.empty();
    }));
    shown.window->runner.pause();
    QVERIFY(wait_for([&] { return shown.window->runner.state() != RunState::running; }));
    shown.window->runner.run();
    QVERIFY(wait_for([&] {
      const auto snapshot = shown.window->snapshot();
      return shown.window->runner.state() == RunState::finished && snapshot && snapshot->total &&
             snapshot->total->end;
    }));
    const SolverSnapshot& snapshot = *shown.window->snapshot();
    QVERIFY(snapshot.total->end == TotalEnd::reached);
    QCOMPARE(snapshot.total->stages.size(), expected.stages.size());
    QVERIFY(snapshot.radiosity == expected.solve.solution.radiosity);
    QVERIFY(!shown.window->views().settings.differ_from_effect());
    // The tab has the errors of the last stage, which need no further measurement.
    QVERIFY(shown.errors());
    QCOMPARE(shown.errors()->report.total(), expected.report.total());
    QVERIFY(shown.table().rowCount() > 0);
    QVERIFY2(shown.text("phase").contains("limit 40 %: reached"), qPrintable(shown.text("phase")));
    save_picture(*shown.window, "errors-in-all");
    // To start over returns to the scene as it was read.
    shown.window->runner.stop();
    QVERIFY(wait_for([&] {
      return shown.window->snapshot() && shown.window->snapshot()->loaded->scene == scene;
    }));
  }

  void reports_are_written() {
    const QTemporaryDir folder;
    const Shown shown;
    QVERIFY(shown.measures());
    auto* exports = shown.window->findChild<ExportActions*>();
    const QString json = folder.filePath("errors.json"), page = folder.filePath("errors.html");
    exports->write_errors(json);
    QVERIFY(wait_for([&] { return !exports->writing(); }));
    exports->write_errors(page);
    QVERIFY(wait_for([&] { return !exports->writing(); }));
    std::ifstream file(json.toStdString());
    const auto surfaces = nlohmann::json::parse(file).at("surfaces");
    QCOMPARE(surfaces.size(), shown.errors()->report.surfaces.size());
    QVERIFY(QFile(page).size() > 0);
    QVERIFY_EXCEPTION_THROWN(exports->write_errors(folder.filePath("errors.txt")), InputError);
  }
};

const test::Registered registered("errors", test::run_as_viewer<ErrorsTest>);

}  // namespace transillum::viewer::errors_test

#include "errors_test.moc"
