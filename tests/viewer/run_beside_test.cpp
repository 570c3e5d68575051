// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A kept run of another scene beside the open one. Oracle: the transfers of the local map engine.
#include "colors/run_beside.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QTableWidget>
#include <QToolButton>
#include <array>
#include <cmath>
#include <set>

#include "geometry/luminance.h"
#include "inspected_window.h"
#include "transillum/at.h"

namespace transillum::viewer::run_beside_test {

using namespace test;

namespace {

/// The open scene, beside a kept run of another.
struct Beside : Inspected {
  MapCanvas* second = part<MapCanvas>("map_canvas_before");
  QTableWidget* table = part<QTableWidget>("beside_table");

  Beside(const QString& kept, const QString& open) : Inspected(kept) {
    ready = ready && raise("runs_dock");
    trigger("keep_run");
    window->open(open, {Goal::Kind::iteration});
    ready = ready && wait_for([this] {
              return window->snapshot() && window->snapshot()->progress.iteration == 1;
            }) &&
            comes_to_rest(*window);
    part<QTableWidget>("run_table")->setCurrentCell(0, 0);
    part<QToolButton>("run_beside")->click();
    ready = ready && wait_for([this] { return table->rowCount() > 0; });
  }
  void go_to(const RunPosition& position) const {
    window->focus.go_to(position);
    QVERIFY(wait_for([this] { return window->focus.arrived() && window->settled(); }));
    QVERIFY(wait_for([this] { return table->rowCount() > 0; }));
  }
};

double number_in(const QTableWidgetItem& cell) {
  return cell.text().replace(QChar(0x2212), QLatin1Char('-')).toDouble();
}

/// The area over which each patch exchanges light, by the engine's own transfers.
std::vector<double> areas_of(const Scene& scene, const BspTree& tree, const Vec3& omega) {
  std::vector<double> areas(static_cast<std::size_t>(scene.patch_count()));
  for (const Transfer& t : record_local_map(scene, tree, omega).transfers.exchanges) {
    at(areas, t.receiver) += t.area;
    at(areas, t.source) += t.area;
  }
  return areas;
}

}  // namespace

class RunBesideTest : public QObject {
  Q_OBJECT

 private slots:
  void areas_are_those_of_the_transfers_data() {
    QTest::addColumn<QString>("kept");
    QTest::addColumn<QString>("open");
    QTest::newRow("the same scene") << "boards:n=5"
                                    << "boards:n=5";
    QTest::newRow("another version") << "boards:n=4"
                                     << "boards:n=5";
    QTest::newRow("another scene") << "cornell-box"
                                   << "furnace";
  }
  void areas_are_those_of_the_transfers() {
    QFETCH(QString, kept);
    QFETCH(QString, open);
    const Beside s(kept, open);
    QVERIFY(s.ready);
    s.go_to({0, 4, 2});
    const auto scene = load_scene(kept.toStdString());
    const LoadedScene& shown = *s.window->focus.map()->loaded;
    const Vec3 omega = s.window->focus.map()->record().frame.omega;
    const auto there = areas_of(*scene, BspTree(*scene), omega);
    const auto here = areas_of(*shown.scene, *shown.tree, omega);
    QCOMPARE(s.second->isVisible(), true);
    QVERIFY(s.second->map_shown()->record().frame.omega == omega);
    QCOMPARE(s.second->map_shown()->loaded->scene->name(), scene->name());
    double changed = 0;
    for (int row = 0; row < s.table->rowCount(); ++row) {
      const PatchId patch = s.table->item(row, 0)->text().toInt();
      QCOMPARE(s.table->item(row, 1)->text(), number_text(at(there, patch)));
      QCOMPARE(s.table->item(row, 2)->text(), number_text(at(here, patch)));
      const double exact = at(here, patch) - at(there, patch);
      const double change = std::abs(exact) > 1e-12 ? exact : 0;  // areas of a meter, rounded
      QCOMPARE(s.table->item(row, 3)->text(), number_text(change));
      changed = std::max(changed, std::abs(change));
    }
    s.part<QComboBox>("beside_quantity")->setCurrentIndex(2);
    double before = HUGE_VAL;
    for (int row = 0; row < s.table->rowCount(); ++row) {
      const PatchId patch = s.table->item(row, 0)->text().toInt();
      QCOMPARE(s.table->item(row, 2)->text(),
               number_text(luminance(at(s.window->snapshot()->radiosity, patch))));
      const double size = std::abs(number_in(*s.table->item(row, 3)));
      QVERIFY(size <= before);
      before = size;
    }
    QCOMPARE(changed > 0, kept != open);
    save_picture(*s.window, "beside-" + kept.section(':', 0, 0));
  }

  /// A run beside itself has the colors of the open scene, whatever they show.
  void colors_are_of_the_same_quantity() {
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    ColorChoice& colors = solved.window->colors;
    RunBeside beside(solved.window->focus, colors, solved.window->selection);
    beside.show(solved.window->snapshot(), "itself");
    std::set<std::vector<Color8>> different;
    for (const Quantity quantity :
         {Quantity::radiosity, Quantity::reflectance, Quantity::exitance, Quantity::irradiance,
          Quantity::form_factor_sum, Quantity::sky_fraction, Quantity::difference}) {
      colors.set_quantity(quantity);
      QVERIFY(beside.patch_colors() == colors.patch_colors());
      different.insert(beside.patch_colors());
    }
    QVERIFY(different.size() >= 5);
  }

  // Oracle: the form factors of a solve of each scene, with the same directions.
  void form_factors_are_compared_pair_by_pair() {
    const Beside s("boards:n=4", "boards:n=5");
    QVERIFY(s.ready);
    s.part<QComboBox>("beside_quantity")->setCurrentIndex(3);
    QCOMPARE(s.table->rowCount(), 0);
    constexpr PatchId receiver = 2;
    s.window->selection.select(receiver);
    QVERIFY(wait_for([&] { return s.table->rowCount() > 0; }));
    const SolveOptions& options = s.window->snapshot()->options;
    std::array<std::vector<double>, 2> expected;
    for (const auto& [name, row] :
         {std::pair{"boards:n=4", &expected[0]}, {"boards:n=5", &expected[1]}}) {
      const auto scene = load_scene(name);
      RadiositySolver solver(scene, options);
      solver.keep_form_factors();
      solver.advance(RadiositySolver::Until::finished);
      row->resize(static_cast<std::size_t>(scene->patch_count()));
      const ReceiverRow of_solve = row_of(solver.form_factors(), receiver);
      for (std::size_t k = 0; k < of_solve.source.size(); ++k) {
        at(*row, of_solve.source[k]) = of_solve.value[k];
      }
    }
    double changed = 0;
    for (int row = 0; row < s.table->rowCount(); ++row) {
      const PatchId j = s.table->item(row, 0)->text().toInt();
      for (int side = 0; side < 2; ++side) {
        QCOMPARE(s.table->item(row, 1 + side)->text(),
                 number_text(at(expected[static_cast<std::size_t>(side)], j)));
      }
      changed = std::max(changed, std::abs(number_in(*s.table->item(row, 3))));
    }
    QVERIFY(changed > 1e-3);
    s.table->setCurrentCell(0, 0);  // the receiver stays
    QCOMPARE(s.window->selection.patch(), receiver);
    QCOMPARE(s.window->selection.patches().size(), std::size_t{2});
    s.part<QToolButton>("copy_beside")->click();
    QVERIFY(QApplication::clipboard()->text().contains("F(2,j) there"));
    save_picture(*s.window, "beside-factors");
  }

  // The other map shows the step of the patch with the same number.
  void steps_are_linked_by_patch() {
    const Beside s("boards:n=4", "boards:n=5");
    QVERIFY(s.ready);
    s.go_to({0, 4, 2});
    for (int k = 0; k < 3; ++k) {
      s.trigger("step_on");
      QVERIFY(wait_for([&] { return s.window->settled(); }));
      const auto& focus = s.window->focus;
      const PatchId patch = focus.map()->history.step(focus.position().step).patch;
      const auto other = s.second->map_shown();
      const auto steps = other->history.steps_of(patch);
      const auto first = std::find_if(steps.begin(), steps.end(), [&](std::int32_t step) {
        return other->history.step(step).patch == patch;
      });
      const std::size_t polygons =
          first == steps.end() ? 0 : other->record().map_after(*first).size();
      QCOMPARE(s.second->polygon_count(), polygons);
    }
  }

  void the_summary_can_be_copied_and_rows_select() {
    const Beside s("boards:n=4", "boards:n=5");
    QVERIFY(s.ready);
    s.part<QToolButton>("copy_beside")->click();
    const QString text = QApplication::clipboard()->text();
    QVERIFY(text.startsWith("Run 1 beside the open scene, along ω = ("));
    QCOMPARE(text.section('\n', 1, 1).count('\t'), 6);
    QVERIFY(text.count('\n') > 3);
    s.table->setCurrentCell(1, 0);
    QCOMPARE(s.window->selection.patch(), s.table->item(1, 0)->text().toInt());
    s.part<QToolButton>("run_beside")->click();
    QVERIFY(wait_for([&] { return s.window->settled(); }));
    QVERIFY(!s.part<QWidget>("beside_view")->isVisible());
  }
};

const test::Registered registered("run_beside", test::run_as_viewer<RunBesideTest>);

}  // namespace transillum::viewer::run_beside_test

#include "run_beside_test.moc"
