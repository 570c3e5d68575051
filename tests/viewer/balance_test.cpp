// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// "Why this number?": the terms of B of a patch, and the links of their numbers.
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QTableView>
#include <algorithm>
#include <cmath>

#include "inspected_window.h"
#include "model/light_balance.h"
#include "model/snapshot_values.h"
#include "patches/balance_view.h"
#include "state/breakpoints.h"
#include "transillum/at.h"
#include "widgets/fold.h"

namespace transillum::viewer::balance_test {

using namespace test;

namespace {

Rgb sum_of(const LightBalance& balance) {
  Rgb sum = balance.exitance + balance.others + balance.shot + balance.sky + balance.sun +
            balance.remainder;
  for (const LightBalance::Term& term : balance.terms) {
    sum += term.contribution;
  }
  return sum;
}

/// The balance by a row that is computed again.
LightBalance balance_of(const SolverSnapshot& snapshot, PatchId i) {
  RowRequest request = *row_request(snapshot, i);
  request.form_factors = nullptr;
  return light_balance(snapshot, i, compute_row(request, {}, [](double) {}).row);
}

/// The contributions of the sources, as the text shows them.
std::vector<double> shown_terms(const QString& text) {
  static const QRegularExpression link("<a href='(step:\\d+)'[^>]*>([^<]*)<");
  std::vector<double> terms;
  QString before;
  for (auto match = link.globalMatch(text); match.hasNext();) {
    const auto one = match.next();
    if (before != one.captured(1)) {  // not the fraction, which has the same link
      terms.push_back(one.captured(2).toDouble());
    }
    before = one.captured(1);
  }
  return terms;
}

}  // namespace

class BalanceTest : public QObject {
  Q_OBJECT

 private slots:
  void terms_add_up_to_b_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<bool>("linear");
    QTest::addColumn<bool>("shot");
    QTest::addColumn<double>("area");
    QTest::newRow("constant") << "cornell-box" << false << false << 0.0;
    QTest::newRow("linear, divided") << "cornell-box" << true << false << 0.05;
    QTest::newRow("first shot, divided") << "cornell-box" << false << true << 0.05;
    QTest::newRow("sky") << "cornell-box:open=1" << false << false << 0.0;
    QTest::newRow("sky and sun, linear") << "cornell-box:open=1,sun" << true << false << 0.0;
  }
  void terms_add_up_to_b() {
    QFETCH(QString, scene);
    QFETCH(bool, linear);
    QFETCH(bool, shot);
    QFETCH(double, area);
    SolveOptions options{.directions = 32};
    options.tolerance = 1e-14;
    const bool sunny = scene.endsWith(",sun");
    scene.remove(",sun");
    if (!shot) {
      options.first_shot = {};
    }
    if (scene.contains("open")) {
      options.sky.exitance = {1, 2, 3};
    }
    if (sunny) {
      options.sky.sun = {{1000, 900, 800}, normalized(Vec3{0.3, 0.2, -0.9})};
    }
    if (linear) {
      options.basis = Basis::linear;
    }
    const auto window = make_window(options);
    RunOptions all{.solve = options};
    if (area > 0) {
      all.scene.max_patch_area = area;
    }
    window->scene.open(scene.toStdString(), all, {Goal::Kind::finished});
    QVERIFY(wait_for([&] {
      return window->snapshot() && window->snapshot()->progress.finished && window->settled();
    }));
    const auto snapshot = window->snapshot();
    QVERIFY(!snapshot->form_factors);
    double largest = 0, lit = 0;
    for (const Rgb& b : snapshot->radiosity) {
      largest = std::max({largest, b.r, b.g, b.b});
    }
    for (PatchId i = 0; i < snapshot->loaded->scene->patch_count(); ++i) {
      const LightBalance balance = balance_of(*snapshot, i);
      lit += balance.sun.r;
      QVERIFY(balance.terms.size() <= 10);
      const Rgb& b = at(snapshot->radiosity, i);
      const Rgb difference = sum_of(balance) - b;
      // Some hundred additions of numbers of at most the largest B.
      QVERIFY(std::abs(difference.r) + std::abs(difference.g) + std::abs(difference.b) <
              1e-13 * largest);
      // The solve has converged to rounding.
      const Rgb& rest = balance.remainder;
      QVERIFY2(std::abs(rest.r) + std::abs(rest.g) + std::abs(rest.b) < 1e-12 * largest,
               qPrintable(QString("patch %1: %2 of %3").arg(i).arg(rest.r).arg(b.r)));
    }
    QCOMPARE(lit > 0, sunny);
  }

  /// A lamp of many tiles is one term.
  void tiles_of_a_face_are_one_term() {
    const auto window = make_window(SolveOptions{.directions = 32, .first_shot = {}});
    RunOptions all{.solve = {.directions = 32, .first_shot = {}}};
    all.scene.max_patch_area = 0.002;
    window->scene.open("cornell-box", all, {Goal::Kind::finished});
    QVERIFY(wait_for([&] {
      return window->snapshot() && window->snapshot()->progress.finished && window->settled();
    }));
    window->runner.include_form_factors();
    QVERIFY(wait_for([&] { return window->snapshot()->form_factors != nullptr; }));
    const auto snapshot = window->snapshot();
    const Scene& scene = *snapshot->loaded->scene;
    const auto is_lamp = [&](const LightBalance::Term& term) {
      return max_abs(material_of(*snapshot, term.largest).exitance) > 0 && term.patches.size() > 1;
    };
    LightBalance balance;
    PatchId receiver = -1;
    do {
      balance = balance_of(*snapshot, ++receiver);
    } while (balance.terms.empty() || !is_lamp(balance.terms.front()));
    const LightBalance::Term& lamp = balance.terms.front();
    double factor = 0;
    for (const PatchId j : lamp.patches) {
      QCOMPARE(scene.patch(j).face, scene.patch(lamp.largest).face);
      factor += form_factor(*snapshot->form_factors, receiver, j);
    }
    QVERIFY(std::abs(factor - lamp.form_factor) < 1e-12);
  }

  void links_lead_to_source_directions_and_step() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready && shown.raise("inspector_dock"));
    auto* balance = shown.part<BalanceView>("balance");
    shown.window->selection.select(16);
    QVERIFY(!balance->isVisible());
    shown.part<FoldHeader>("why_section")->click();
    QVERIFY(wait_for([&] { return balance->text().contains("href='step:0'"); }));
    QVERIFY(comes_to_rest(*shown.window));
    save_picture(*shown.window, "balance");
    const LightBalance::Term term = balance_of(*shown.window->snapshot(), 16).terms.front();
    const PatchId lamp = term.largest;
    emit balance->linkActivated("step:0");
    QVERIFY(wait_for([&] { return shown.window->focus.arrived() && shown.window->settled(); }));
    const Focus& focus = shown.window->focus;
    QVERIFY(focus.at_step() && focus.reason() == StepReason::found);
    QVERIFY(holds(Breakpoint{Breakpoint::Kind::pair, 16, lamp}, focus.map()->history,
                  focus.position().step));
    emit balance->linkActivated("seen:0");
    auto* directions = shown.part<QTableView>("received_light");
    QVERIFY(wait_for([&] { return directions->isVisible(); }));
    const auto chosen = [&] { return directions->selectionModel()->selectedRows(5); };
    QVERIFY(wait_for([&] { return !chosen().isEmpty(); }));
    for (const QModelIndex& brightest : chosen()) {
      const PatchId patch = brightest.data().toInt();
      QVERIFY(std::find(term.patches.begin(), term.patches.end(), patch) != term.patches.end());
    }
    QVERIFY(chosen().size() < directions->model()->rowCount());
    QVERIFY(shown.part<QLabel>("received_words")->text().contains("Selected: directions"));
    emit balance->linkActivated("channel:2");
    QVERIFY(balance->text().contains("<b>blue</b>"));
    const std::vector<double> terms = shown_terms(balance->text());
    QVERIFY(terms.size() > 5 && std::is_sorted(terms.rbegin(), terms.rend()));
    emit balance->linkActivated("source:0");
    QCOMPARE(shown.window->selection.patch(), lamp);
    save_picture(*shown.window, "balance-of-a-lamp");
  }

  // Every number leads to what it is made of.
  void every_number_is_a_link() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready && shown.raise("inspector_dock"));
    auto* balance = shown.part<BalanceView>("balance");
    shown.window->selection.select(16);
    shown.part<FoldHeader>("why_section")->click();
    QVERIFY(wait_for([&] { return balance->text().contains("href='step:0'"); }));
    QString rest = balance->text();
    rest.remove(QRegularExpression("<a [^>]*>.*?</a>|<sub>.*?</sub>"));
    rest.remove(QRegularExpression("<[^>]*>|W/m²|\\d+ others"));
    QVERIFY2(!rest.contains(QRegularExpression("\\d")), qPrintable(rest));
    static const QRegularExpression panel("href='panel:([a-z]*)'");
    QStringList panels;
    for (auto match = panel.globalMatch(balance->text()); match.hasNext();) {
      panels << match.next().captured(1);
    }
    panels.removeDuplicates();
    QVERIFY(panels.contains("table") && panels.contains("material") && panels.contains("received"));
    for (const QString& name : panels) {
      auto* dock = shown.part<QDockWidget>(qPrintable(name + "_dock"));
      QVERIFY2(dock, qPrintable(name));
      dock->hide();
      emit balance->linkActivated("panel:" + name);
      QTRY_VERIFY2(dock->widget()->isVisible(), qPrintable(name));
    }
  }

  void links_choose_the_part_of_the_table() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready && shown.raise("inspector_dock"));
    auto* balance = shown.part<BalanceView>("balance");
    shown.window->selection.select(16);
    shown.part<FoldHeader>("why_section")->click();
    QVERIFY(wait_for([&] { return balance->text().contains("href='step:0'"); }));
    const auto* all = shown.part<QTableView>("patch_table");
    const auto* partners = shown.part<QTableView>("partner_table");
    shown.part<QLineEdit>("patch_search")->setText("26");
    emit balance->linkActivated("panel:table-partners");
    QVERIFY(wait_for([&] { return partners->isVisible() && partners->model()->rowCount() > 10; }));
    emit balance->linkActivated("panel:table");
    QVERIFY(wait_for([&] { return all->isVisible(); }));
    const QModelIndexList rows = all->selectionModel()->selectedRows();
    QCOMPARE(rows.size(), 1);
    QCOMPARE(rows.front().data().toInt(), 16);
  }

  void a_canceled_row_is_computed_on_demand() {
    const Inspected shown("sphere-flake");
    QVERIFY(shown.ready && shown.raise("inspector_dock"));
    auto* balance = shown.part<BalanceView>("balance");
    shown.window->selection.select(16);
    shown.part<FoldHeader>("why_section")->click();
    QVERIFY(wait_for([&] { return balance->text().contains("href='cancel'"); }));
    emit balance->linkActivated("cancel");
    QVERIFY(balance->text().contains("href='compute'"));
    emit balance->linkActivated("compute");
    QVERIFY(balance->text().contains("href='cancel'"));
    QVERIFY(wait_for([&] { return balance->text().contains("href='step:0'"); }));
  }
};

const test::Registered registered("balance", test::run_as_viewer<BalanceTest>);

}  // namespace transillum::viewer::balance_test

#include "balance_test.moc"
