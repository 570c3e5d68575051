// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sphere of directions and the table of received light, against eq. 11.
#include "directions/direction_view.h"

#include <QDockWidget>
#include <QTableView>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "directions/received_light.h"
#include "solved_window.h"
#include "state/step_events.h"
#include "transillum/at.h"

namespace transillum::viewer::direction_view_test {

using namespace test;

namespace {

struct Shown : SolvedWindow {
  explicit Shown(const char* scene) : SolvedWindow(scene) {
    window->runner.run();
    (void)wait_for([this] { return window->snapshot()->progress.finished && window->settled(); });
    window->views().docks.bring_to_front("direction");
    view = window->findChild<DirectionView*>();
    (void)wait_for([this] { return view->isVisible(); });
  }
  void select(PatchId patch) {
    window->selection.select(patch);
    QVERIFY(wait_for([this] { return view->up_to_date(); }));
  }
  DirectionView* view;
};

}  // namespace

class DirectionViewTest : public QObject {
  Q_OBJECT

 private slots:
  void shows_each_direction_and_its_opposite() {
    const Shown shown("cornell-box");
    const auto points = shown.view->points();
    QCOMPARE(points.size(), std::size_t{64});
    for (std::size_t k = 0; k < points.size(); k += 2) {
      QVERIFY(norm(points[k].omega + points[k + 1].omega) < 1e-15);
      QVERIFY(points[k + 1].opposite);
    }
    QVERIFY(shown.view->received().empty());
    QVERIFY(color_count(shown.view->grab().toImage()) > 4);
  }

  /// Eq. 11: what a patch receives is the sum over directions.
  void contributions_sum_to_the_irradiance() {
    Shown shown("cornell-box");
    const Solution solution =
        solve(load_scene("cornell-box"), {.directions = 32, .first_shot = {}});
    for (const PatchId patch : {0, 3, 7}) {
      shown.select(patch);
      const auto received = shown.view->received();
      QCOMPARE(received.size(), std::size_t{64});
      const double sum = std::accumulate(received.begin(), received.end(), 0.0);
      const double irradiance = luminance(at(solution.irradiance, patch));
      // The view uses the newest B, but H comes from the previous B: they differ by the tolerance
      // at most.
      QVERIFY2(std::abs(sum - irradiance) <= 1e-4 * irradiance,
               qPrintable(QString("patch %1: %2, not %3").arg(patch).arg(sum).arg(irradiance)));
    }
  }

  void only_directions_on_the_front_side_contribute() {
    Shown shown("cornell-box");
    shown.select(0);
    const Vec3 normal = shown.window->snapshot()->loaded->scene->patch(0).normal;
    const auto points = shown.view->points();
    const auto received = shown.view->received();
    int lit = 0;
    for (std::size_t k = 0; k < received.size(); ++k) {
      if (!(received[k] > 0)) {
        continue;
      }
      ++lit;
      QVERIFY(dot(points[k].omega, normal) > 0);
    }
    QVERIFY(lit > 8);
  }

  /// Eq. 11: B(n+1) = E + rho H, with H the sum over the table.
  void the_table_sums_to_the_next_radiosity() {
    Shown shown("cornell-box");
    shown.window->views().docks.bring_to_front("received");
    auto* view = shown.window->findChild<QTableView*>("received_light");
    QVERIFY(wait_for([&] { return view->isVisible(); }));
    auto* table = qobject_cast<ReceivedTable*>(view->model());
    Focus& focus = shown.window->focus;
    const auto snapshot = shown.window->snapshot();
    const Scene& scene = *snapshot->loaded->scene;
    for (const int n : {0, 1, 3}) {
      focus.go_to({n, 5, 10});
      QVERIFY(wait_for([&] { return focus.arrived(); }));
      for (const PatchId patch : {0, 3, 7}) {
        shown.window->selection.select(patch);
        // One direction of each pair is on the front side; edge-on directions are not listed.
        QVERIFY(wait_for([&] { return table->rowCount() >= 30 && table->rowCount() <= 32; }));
        const Rgb next = at(*at(snapshot->kept_radiosity, n + 1), patch);
        QTRY_VERIFY(max_abs(scene.exitance(patch) + scene.reflectance(patch) * table->irradiance() -
                            next) <= 1e-9 * max_abs(next));
      }
    }
    // The largest contribution comes first; a double click goes to the step that receives it.
    double last = HUGE_VAL, largest = 0;
    for (int row = 0; row < table->rowCount(); ++row) {
      QVERIFY(luminance(table->light(row).irradiance) <= last);
      QVERIFY(table->light(row).cosine > 0);
      last = luminance(table->light(row).irradiance);
      largest = std::max(largest, last);
    }
    QVERIFY(largest > 0);
    const ReceivedLight most = table->light(0);
    const QPoint place = view->visualRect(table->index(0, ReceivedTable::of_share)).center();
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, place);
    QTest::mouseDClick(view->viewport(), Qt::LeftButton, {}, place);
    QVERIFY(wait_for([&] { return focus.arrived(); }));
    QCOMPARE(focus.position().iteration, 3);
    QCOMPARE(focus.position().direction, most.pass);
    const auto events = events_of_patch(focus.map()->history, shown.window->selection.patch());
    QVERIFY(std::any_of(events.begin(), events.end(), [&](const StepEvent& event) {
      return event.step == focus.position().step && event.kind == StepEvent::Kind::exchange;
    }));
    table->sort(ReceivedTable::of_direction, Qt::AscendingOrder);
    for (int row = 1; row < table->rowCount(); ++row) {
      QVERIFY(table->light(row - 1).pass < table->light(row).pass);
    }
    save_picture(*shown.window, "received");
  }

  /// In a growing run each iteration has its own number of directions.
  void the_table_sums_to_the_next_radiosity_in_a_growing_run() {
    TestWindow window;
    SolveOptions options;
    options.directions = 64;
    options.scheme = Scheme::growing;
    options.first_shot.reset();
    window.set_options(options, {});
    window.show();
    window.open("cornell-box");
    QVERIFY(wait_for([&] { return window.settled() && window.snapshot()->progress.finished; }));
    window.views().docks.bring_to_front("received");
    auto* view = window.findChild<QTableView*>("received_light");
    auto* table = qobject_cast<ReceivedTable*>(view->model());
    const auto snapshot = window.snapshot();
    QCOMPARE(snapshot->passes_of(0), 16);
    QCOMPARE(snapshot->passes_of(1), 32);
    QCOMPARE(snapshot->passes_of(2), 64);
    const Scene& scene = *snapshot->loaded->scene;
    window.selection.select(3);
    for (const int n : {2, 0, 1}) {
      window.focus.go_to({n, 5, 10});
      QVERIFY(wait_for([&] { return window.focus.arrived(); }));
      QCOMPARE(window.focus.passes_of(n), 16 << n);
      const Rgb next = (*at(snapshot->kept_radiosity, n + 1))[3];
      QTRY_VERIFY(max_abs(scene.exitance(3) + scene.reflectance(3) * table->irradiance() - next) <=
                  1e-9 * max_abs(next));
    }
  }

  void a_click_moves_the_focus_to_the_direction() {
    Shown shown("cornell-box");
    const auto directions = shown.window->snapshot()->directions;
    const QSize size = shown.view->size();
    for (int y = 60; y < size.height() - 60; y += 3) {
      for (int x = 20; x < size.width() - 20; x += 3) {
        QTest::mouseClick(shown.view, Qt::LeftButton, {}, {x, y});
        if (!shown.window->focus.following()) {
          QVERIFY(wait_for([&] { return shown.window->focus.arrived(); }));
          return;
        }
      }
    }
    QFAIL("no point was hit");
  }

  void is_cleared_with_the_scene() {
    Shown shown("cornell-box");
    shown.select(3);
    QVERIFY(!shown.view->received().empty());
    shown.window->open("furnace");
    QVERIFY(wait_for([&] { return shown.window->selection.patch() == no_patch; }));
    QVERIFY(shown.view->received().empty());
  }
};

const test::Registered registered("direction_view", test::run_as_viewer<DirectionViewTest>);

}  // namespace transillum::viewer::direction_view_test

#include "direction_view_test.moc"
