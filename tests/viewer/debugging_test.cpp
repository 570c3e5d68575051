// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// What helps to find an error in a map: breakpoints with several conditions, the filter of events,
// both phases of a step, details of a polygon, watched values.
#include <QComboBox>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableView>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "colors/pointer_label.h"
#include "map/phase_pair.h"
#include "map/polygon_text.h"
#include "solved_window.h"
#include "state/step_events.h"
#include "stepping/timeline_lanes.h"
#include "stepping/watch_chart.h"
#include "transillum/at.h"

namespace transillum::viewer::debugging_test {

using namespace test;

namespace {

using Kind = Condition::Kind;

struct Debugging : SolvedWindow {
  Focus& focus;

  explicit Debugging(const QString& scene) : SolvedWindow(scene), focus(window->focus) {
    trigger("layout_debug");
  }
  bool settles() const {
    return wait_for([this] { return window->settled(); });
  }
  bool go_to(int direction, std::int32_t step) const {
    focus.go_to({0, direction, step});
    return settles();
  }
  const MapHistory& history() const { return focus.map()->history; }
  template <class Widget>
  Widget* find(const char* name) const {
    return window->findChild<Widget*>(QString::fromLatin1(name));
  }
  void click(const char* button) const { find<QToolButton>(button)->click(); }
  void type(const char* field, const QString& text) const {
    auto* edit = find<QLineEdit>(field);
    edit->selectAll();
    QTest::keyClick(edit, Qt::Key_Delete);
    QTest::keyClicks(edit, text);
    QTest::keyClick(edit, Qt::Key_Return);
  }
};

/// A window with three watched values, before the first step of a direction.
struct Watching : Debugging {
  WatchChart* chart;

  Watching() : Debugging("cornell-box"), chart(window->findChild<WatchChart*>()) {
    ready = ready && go_to(3, -1);
    window->selection.select(0);
    // A value that is watched already is not added again.
    for (const char* watch : {"watch_area", "watch_defect", "watch_size", "watch_size"}) {
      trigger(watch);
    }
    ready = ready && window->watches.list().size() == 3 && wait_for([this] {
              return chart->isVisible() && button(2)->isVisible() && button(2)->y() >= 0 &&
                     button(2)->geometry().bottom() < chart->plot().top();
            });
  }
  QToolButton* button(int k) const {
    return window->findChild<QToolButton*>(QString("watch_%1").arg(k));
  }
};

std::vector<std::int32_t> steps_that_pass(const MapHistory& history, const EventFilter& filter) {
  std::vector<std::int32_t> steps;
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    const auto events = events_of_step(history, k);
    if (std::any_of(events.begin(), events.end(),
                    [&](const StepEvent& event) { return filter.passes(event); })) {
      steps.push_back(k);
    }
  }
  return steps;
}

/// Exchanges over at least 0.001 m² of a patch that has several of them, and other events.
EventFilter filter_for(const MapHistory& history) {
  EventFilter filter;
  filter.least_area = 0.001;
  filter.kinds.fill(false);
  filter.kinds[static_cast<std::size_t>(StepEvent::Kind::exchange)] = true;
  for (filter.patch = 0; !history.steps_of(filter.patch).empty(); ++filter.patch) {
    const std::size_t passing = steps_that_pass(history, filter).size();
    if (passing >= 2 && passing < history.steps_of(filter.patch).size()) {
      return filter;
    }
  }
  filter.patch = no_patch;
  return filter;
}

void enter(const Debugging& s, const EventFilter& filter) {
  s.type("filter_patch", QString::number(filter.patch));
  s.type("filter_least_area", QString::number(filter.least_area));
  for (QAction* kind : s.find<QToolButton>("filter_kinds")->menu()->actions()) {
    if (kind->text() != text_of(StepEvent::Kind::exchange)) {
      kind->trigger();
    }
  }
}

}  // namespace

class DebuggingTest : public QObject {
  Q_OBJECT

 private slots:
  void conditions_are_joined_by_buttons() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready);
    auto* list = s.find<QListWidget>("breakpoint_list");
    QVERIFY(!s.find<QSpinBox>("breakpoint_stop_at")->isEnabled());
    QVERIFY(!s.find<QToolButton>("and_condition")->isEnabled());
    s.window->selection.select(9);
    s.click("add_breakpoint");
    s.window->selection.select(3);
    s.click("and_condition");
    s.find<QComboBox>("breakpoint_kind")->setCurrentIndex(1);
    s.click("or_condition");
    const Breakpoint expected{
        {Kind::patch, 9}, true, {{false, {Kind::patch, 3}}, {true, {Kind::cut, 3}}}, 1};
    QVERIFY(s.window->breakpoints.list() == std::vector<Breakpoint>{expected});
    QVERIFY(list->item(0)->text().startsWith(
        "Patch 9 takes part and patch 3 takes part, or patch 3 is cut"));
    s.find<QSpinBox>("breakpoint_stop_at")->setValue(5);
    QCOMPARE(s.window->breakpoints.list()[0].stop_at, 5);
    save_picture(*s.window, "breakpoints");
    emit list->customContextMenuRequested(list->visualItemRect(list->item(0)).center());
    auto* menu = s.find<QMenu>("breakpoint_menu");
    menu->actions()[2]->trigger();
    menu->close();
    QCOMPARE(s.window->breakpoints.list()[0].further.size(), std::size_t{1});
    s.trigger("undo");
    QCOMPARE(s.window->breakpoints.list()[0].further.size(), std::size_t{2});
  }

  void a_run_stops_at_the_given_hit_and_tells_the_hits() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready && s.go_to(0, -1));
    const Breakpoint breakpoint{{Kind::patch, 9}, true, {{false, {Kind::patch, 3}}}, 5};
    s.window->breakpoints.add(breakpoint);
    const auto* list = s.find<QListWidget>("breakpoint_list");
    auto* stop_at = s.find<QSpinBox>("breakpoint_stop_at");
    s.find<QListWidget>("breakpoint_list")->setCurrentRow(0);
    QCOMPARE(stop_at->value(), 5);
    s.trigger("run_on");
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    const RunPosition stop = s.focus.position();
    QVERIFY2(list->item(0)->text().contains(": 5 hits"), qPrintable(list->item(0)->text()));
    // The fifth stop of a breakpoint that stops at each hit.
    stop_at->setValue(1);
    QVERIFY(s.go_to(0, -1));
    for (int k = 0; k < 5; ++k) {
      s.trigger("run_on");
      QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    }
    QVERIFY(s.focus.position() == stop);
    // If the hit is never reached, all directions have been counted.
    stop_at->setValue(1000000);
    QVERIFY(s.go_to(0, -1));
    const QSignalSpy ended(&s.focus, &Focus::seek_ended);
    s.trigger("run_on");
    QVERIFY(wait_for([&] { return ended.count() == 1; }));
    QVERIFY(!ended[0][0].toBool());
    int all = 0;
    for (int direction = 0; direction < s.focus.passes(); ++direction) {
      QVERIFY(s.go_to(direction, -1));
      for (std::int32_t k = 0; k < s.history().step_count(); ++k) {
        all += holds(breakpoint, s.history(), k);
      }
    }
    QVERIFY2(list->item(0)->text().contains(QString(": %1 hits").arg(count_text(all))),
             qPrintable(list->item(0)->text()));
  }

  void stepping_skips_what_is_filtered() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready && s.go_to(2, -1));
    const auto* shown = s.find<QToolButton>("filter_shown");
    QVERIFY(!shown->isVisible() && !s.find<QAction>("clear_filter")->isEnabled());
    const EventFilter filter = filter_for(s.history());
    QVERIFY(filter.patch != no_patch);
    enter(s, filter);
    QVERIFY(s.focus.filter() == filter);
    QVERIFY(shown->isVisible());
    QCOMPARE(shown->text(),
             QString("Only “receives from”, at least 0.001 m², patch %1").arg(filter.patch));
    save_picture(*s.window, "filtered");
    const auto expected = steps_that_pass(s.history(), filter);
    for (const std::int32_t step : expected) {
      s.trigger("step_on");
      QCOMPARE(s.focus.position().direction, 2);
      QCOMPARE(s.focus.position().step, step);
    }
    for (std::size_t k = expected.size() - 1; k-- > 0;) {
      s.trigger("step_back");
      QCOMPARE(s.focus.position().step, expected[k]);
    }
    // Stepping continues over the end of the direction.
    s.focus.go_to_step(expected.back());
    s.trigger("step_on");
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    QVERIFY(s.focus.position().direction > 2);
    QCOMPARE(s.focus.position().step, steps_that_pass(s.history(), filter).front());
  }

  void lists_and_timeline_show_what_passes_the_filter() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready && s.go_to(2, -1));
    const EventFilter filter = filter_for(s.history());
    QVERIFY(filter.patch != no_patch);
    enter(s, filter);
    const auto expected = steps_that_pass(s.history(), filter);
    s.focus.go_to_step(expected.front());
    const auto* lanes = s.window->findChild<TimelineLanes*>();
    const auto has_bar = [&](std::int32_t step) {
      const QRectF lane = lanes->rect_of(TimelineLanes::Lane::steps);
      const double x = TimelineLanes::position(lane, step + 1, s.history().step_count() + 1);
      const QImage image = s.window->findChild<TimelineLanes*>()->grab().toImage();
      const QPointF place(x, lane.bottom() - 6);
      return image.pixelColor((place * image.devicePixelRatio()).toPoint()) != theme::hover;
    };
    std::int32_t filtered = s.history().step_count() - 1;
    while (std::find(expected.begin(), expected.end(), filtered) != expected.end() ||
           s.history().step(filtered).cut == 0) {
      --filtered;
    }
    QVERIFY(filtered > expected.front() + 1);  // not below the mark of the position
    QVERIFY(!has_bar(filtered));
    s.window->selection.select(filter.patch);
    s.find<QTabWidget>("event_tabs")->setCurrentIndex(1);
    const auto* list = s.find<QTableView>("patch_events");
    const auto events = events_of_patch(s.history(), filter.patch);
    QCOMPARE(
        list->model()->rowCount(),
        static_cast<int>(std::count_if(events.begin(), events.end(), [&](const StepEvent& event) {
          return filter.passes(event);
        })));
    // One click shows all.
    QTest::mouseClick(s.find<QToolButton>("filter_shown"), Qt::LeftButton);
    QVERIFY(!s.find<QToolButton>("filter_shown")->isVisible() && !s.focus.filter().on());
    QVERIFY(has_bar(filtered));
    QCOMPARE(list->model()->rowCount(), static_cast<int>(events.size()));
    QVERIFY(s.find<QLineEdit>("filter_patch")->text().isEmpty());
    s.trigger("step_on");
    QCOMPARE(s.focus.position().step, expected.front() + 1);
  }

  void a_filter_ends_with_its_scene_and_changes_no_phase_in_vain() {
    const Debugging s("boards");
    QVERIFY(s.ready);
    s.focus.go_to({0, 0, 2});
    QVERIFY(s.settles());
    EventFilter none;
    none.kinds.fill(false);
    s.focus.set_filter(none);
    s.focus.set_phase(Phase::after);
    s.trigger("phase_on");
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    QVERIFY(s.focus.phase() == Phase::after && (s.focus.position() == RunPosition{0, 0, 2}));
    s.trigger("play");
    QVERIFY(wait_for([&] { return !s.window->findChild<QAction*>("play")->isChecked(); }));
    s.window->files().open_scene("furnace");
    QVERIFY(wait_for([&] { return s.window->windowTitle().startsWith("furnace"); }));
    QVERIFY(!s.focus.filter().on());
  }

  void before_and_after_are_shown_side_by_side() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready);
    s.focus.go_to({0, 3, 0});
    QVERIFY(s.settles());
    const MapHistory& history = s.focus.map()->history;
    std::int32_t step = 0;
    while (history.step(step).cut < 2) {
      ++step;
    }
    s.focus.go_to_step(step);
    const auto* after = s.window->findChild<MapCanvas*>("map_canvas");
    auto* before = s.window->findChild<MapCanvas*>("map_canvas_before");
    const auto* pair = s.map_view->pair();
    QVERIFY(!before->isVisible() && !pair->button()->isChecked());
    s.trigger("next_pair");
    QVERIFY(pair->choice() == PhasePair::Choice::side_by_side && pair->button()->isChecked());
    QVERIFY(s.settles());
    QVERIFY(before->isVisible() && after->isVisible());
    QCOMPARE(before->polygon_count(), history.record().map_after(step - 1).size());
    QCOMPARE(after->polygon_count(), history.record().map_after(step).size());
    QVERIFY(before->polygon_count() != after->polygon_count());
    // Both maps move together.
    s.window->findChild<QToolButton*>("map_near")->click();
    QVERIFY(before->view() == after->view() && before->view().zoom != 1);
    // A click in either map marks the point in both.
    QVERIFY(s.settles());
    QTest::mouseClick(before, Qt::LeftButton, {}, before->rect().center());
    QVERIFY(s.focus.probe().has_value());
    QVERIFY(s.settles());
    save_picture(*s.window, "side-by-side");
    // Before the first step there is nothing to compare.
    s.focus.go_to_step(-1);
    QVERIFY(!before->isVisible());
    s.focus.go_to_step(step);
    QVERIFY(before->isVisible());
    s.map_view->pair()->choose(PhasePair::Choice::off);
    QVERIFY(!before->isVisible());
  }

  void before_and_after_take_turns_while_the_window_is_active() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready);
    s.focus.go_to({0, 3, 4});
    QVERIFY(s.settles());
    const MapHistory& history = s.focus.map()->history;
    const std::size_t sizes[] = {history.record().map_after(3).size(),
                                 history.record().map_after(4).size()};
    QVERIFY(sizes[0] != sizes[1]);
    const auto* canvas = s.window->findChild<MapCanvas*>("map_canvas");
    PhasePair& pair = *s.map_view->pair();
    QApplication::setActiveWindow(s.window.get());
    QVERIFY(wait_for([&] { return s.window->isActiveWindow(); }));
    pair.button()->menu()->actions()[2]->trigger();
    QVERIFY(pair.choice() == PhasePair::Choice::blink && pair.blinks());
    const QSignalSpy turns(&pair, &PhasePair::changed);
    QElapsedTimer time;
    time.start();
    for (const std::size_t size : sizes) {
      QVERIFY(wait_for([&] { return canvas->polygon_count() == size; }));
    }
    // A whole turn takes a second: never more than three flashes in one.
    QVERIFY(time.elapsed() > PhasePair::blink_ms);
    QVERIFY(turns.count() >= 2);
    QVERIFY(wait_for([&] { return pair.before(); }));
    QWidget other;
    other.show();
    QApplication::setActiveWindow(&other);
    QVERIFY(!pair.blinks() && !pair.before());
    QVERIFY(wait_for([&] { return canvas->polygon_count() == sizes[1]; }));
    QApplication::setActiveWindow(s.window.get());
    QVERIFY(wait_for([&] { return pair.blinks(); }));
    s.trigger("next_pair");
    QVERIFY(!pair.blinks() && pair.choice() == PhasePair::Choice::off);
  }

  void resting_on_a_polygon_tells_corners_edges_and_cut() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready);
    s.focus.go_to({0, 3, 0});
    QVERIFY(s.settles());
    const auto map = s.focus.map();
    s.focus.go_to_step(map->record().fullest_step());
    QVERIFY(s.settles());
    auto* canvas = s.window->findChild<MapCanvas*>("map_canvas");
    auto* label = canvas->findChild<PointerLabel*>();
    // A polygon that was cut: one of its edges belongs to another patch.
    std::int32_t row = MapRecord::no_row;
    QPoint place;
    for (int y = 5; y < canvas->height() && row == MapRecord::no_row; y += 7) {
      for (int x = 5; x < canvas->width() && row == MapRecord::no_row; x += 7) {
        const std::int32_t r = canvas->row_at(QPoint(x, y));
        if (r == MapRecord::no_row || map->row(r).parent == MapRecord::no_row) {
          continue;
        }
        for (const std::int32_t origin : map->history.edge_origins(r)) {
          if (map->row(origin).patch != map->row(r).patch) {
            row = r;
            place = {x, y};
          }
        }
      }
    }
    QVERIFY(row != MapRecord::no_row);
    const QImage before = canvas->grab().toImage();
    QTest::mouseMove(canvas, place);
    QVERIFY(wait_for([&] { return label->text().contains('\n' + row_text(*map, row)); }));
    QVERIFY(label->text().startsWith(QString("Patch %1\n").arg(map->row(row).patch)));
    const auto outline = map->record().outline(map->row(row));
    const auto origins = map->history.edge_origins(row);
    QVERIFY(label->text().contains(QString("Cut by step %1 (patch %2)")
                                       .arg(count_text(map->row(row).made + 1))
                                       .arg(map->history.step(map->row(row).made).patch)));
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const MapRecord::Row& origin = map->row(origins[k]);
      const QString line = QString("\n%1:  %2, %3;  patch %4, step %5")
                               .arg(k + 1)
                               .arg(number_text(outline[k].x), number_text(outline[k].y))
                               .arg(origin.patch)
                               .arg(count_text(origin.made + 1));
      QVERIFY2(label->text().contains(line), qPrintable(line));
    }
    save_picture(*s.window, "polygon-details");
    QVERIFY(canvas->grab().toImage() != before);
    QTest::mouseMove(canvas, place + QPoint(1, 0));
    QVERIFY(wait_for([&] { return !label->text().contains("Cut by step"); }));
  }

  void watched_values_are_those_of_the_steps() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready && s.go_to(3, -1));
    // The known values at each step come from the rows of V and from the step itself.
    const MapHistory& history = s.history();
    const auto areas = values_of({Watch::Kind::patch_area, 0}, history);
    const auto defects = values_of({Watch::Kind::closure_defect}, history);
    const auto sizes = values_of({Watch::Kind::map_size}, history);
    double largest = 0;
    for (std::int32_t k = -1; k < history.step_count(); ++k) {
      const auto rows = history.record().map_after(k);
      double area = 0;
      for (const std::int32_t r : rows) {
        area += history.row(r).patch == 0 ? history.record().area(history.row(r)) : 0;
      }
      largest = std::max(largest, area);
      QVERIFY(std::abs(at(areas, k + 1) - area) < 1e-14);
      QCOMPARE(at(sizes, k + 1), static_cast<double>(rows.size()));
      const bool receives = k >= 0 && history.step(k).front_facing;
      QCOMPARE(std::isnan(at(defects, k + 1)), !receives);
    }
    QVERIFY(largest > 0);
  }

  // The arrow showed the last direction of the run there.
  void the_direction_before_the_first_step_is_that_of_the_map() {
    const Debugging s("flatland");
    QVERIFY(s.ready);
    Callout omega;
    omega.anchor = Callout::Anchor::direction;
    for (const int direction : {0, 3, 20}) {
      QVERIFY(s.go_to(direction, 0));
      const std::optional<Vec3> on_a_step = s.scene_view->anchor_of(omega);
      QVERIFY(s.go_to(direction, -1));
      const std::optional<Vec3> before = s.scene_view->anchor_of(omega);
      QVERIFY(on_a_step && before);
      const Vec3 moved = *before - *on_a_step;
      QVERIFY2(norm(cross(moved, s.history().record().frame.omega)) < 1e-6 * (1 + norm(moved)),
               qPrintable(QString("direction %1").arg(direction)));
    }
  }

  void watched_values_of_the_selection_need_one() {
    const Debugging s("cornell-box");
    QVERIFY(s.ready && s.go_to(3, -1));
    QVERIFY(!s.window->findChild<WatchChart*>()->isVisible());
    QVERIFY(!s.window->findChild<QAction*>("watch_area")->isEnabled());
    s.window->selection.select(0);
    QVERIFY(s.window->findChild<QAction*>("watch_area")->isEnabled());
  }

  void watched_values_are_beside_the_chart_on_a_small_screen() {
    const Watching s;
    QVERIFY(s.ready);
    // A window that is high enough gives the chart more than its least height.
    QVERIFY(wait_for([&] { return s.chart->height() > s.chart->minimumSizeHint().height(); }));
    const QSize usual = s.window->size();
    s.window->resize(1280 - 16, 720 - 48);
    s.window->resizeDocks({s.window->findChild<QDockWidget*>("timeline_dock")}, {1}, Qt::Vertical);
    QVERIFY(wait_for([&] { return s.button(2)->x() > s.chart->plot().right(); }));
    QCOMPARE(s.window->size(), QSize(1280 - 16, 720 - 48));
    for (int k = 0; k < 3; ++k) {
      const QToolButton* button = s.button(k);
      QVERIFY2(s.chart->rect().contains(button->geometry()), qPrintable(button->text()));
      QVERIFY(button->toolTip().contains("at most"));
      // A truncated number could be read as another number.
      QVERIFY(button->width() >= button->sizeHint().width());
    }
    QVERIFY(s.chart->plot().height() >= 26);
    save_picture(*s.window, "watched-small");
    s.window->resize(usual);
    s.trigger("layout_reset");
    QVERIFY(wait_for([&] { return s.button(2)->x() < s.chart->plot().right(); }));
  }

  // The lines pass through the values, and the buttons show them.
  void watched_values_are_drawn_over_the_steps() {
    const Watching s;
    QVERIFY(s.ready);
    const MapHistory& history = s.history();
    const auto sizes = values_of({Watch::Kind::map_size}, history);
    const std::int32_t step = history.step_count() * 2 / 3;
    const auto x_of_step = [&] {
      return TimelineLanes::position(s.chart->plot(), step + 1, history.step_count() + 1);
    };
    QTest::mouseClick(s.chart, Qt::LeftButton, {},
                      QPointF(x_of_step(), s.chart->plot().center().y()).toPoint());
    QCOMPARE(s.focus.position().step, step);
    QCOMPARE(s.button(2)->text(),
             QString("Polygons of V: %1, at most %2")
                 .arg(number_text(at(sizes, step + 1)),
                      number_text(*std::max_element(sizes.begin(), sizes.end()))));
    s.focus.go_to_step(-1);
    const QImage image = s.chart->grab().toImage();
    const QPointF place(x_of_step(), s.chart->height_of(2, at(sizes, step + 1)));
    const QColor color = image.pixelColor((place * image.devicePixelRatio()).toPoint());
    QVERIFY2(std::abs(color.hue() - WatchChart::color_of(2).hue()) < 20, qPrintable(color.name()));
    save_picture(*s.window, "watched");
  }

  void watched_values_are_removed_at_a_click_and_with_their_scene() {
    const Watching s;
    QVERIFY(s.ready);
    QTest::mouseClick(s.button(1), Qt::LeftButton);
    QVERIFY(wait_for([&] { return s.window->watches.list().size() == 2; }));
    s.trigger("undo");
    QVERIFY((s.window->watches.list()[1] == Watch{Watch::Kind::closure_defect}));
    s.window->files().open_scene("furnace");
    QVERIFY(wait_for([&] { return s.window->windowTitle().startsWith("furnace"); }));
    QVERIFY(s.window->watches.list().empty() && !s.chart->isVisible());
  }
};

const test::Registered registered("debugging", test::run_as_viewer<DebuggingTest>);

}  // namespace transillum::viewer::debugging_test

#include "debugging_test.moc"
