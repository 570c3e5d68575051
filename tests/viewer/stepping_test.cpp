// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Stepping through visibility maps with the mouse and the keyboard.
#include <QComboBox>
#include <QListWidget>
#include <QMenu>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableView>
#include <QToolButton>
#include <set>

#include "map/engine_drawing.h"
#include "map/hemicube_view.h"
#include "solved_window.h"
#include "stepping/play_control.h"
#include "stepping/timeline_lanes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "widgets/log_chart.h"

namespace transillum::viewer::stepping_test {

using namespace test;

namespace {

using Lane = TimelineLanes::Lane;

struct Stepping : SolvedWindow {
  Focus& focus;
  TimelineLanes* lanes;

  explicit Stepping(const QString& scene)
      : SolvedWindow(scene), focus(window->focus), lanes(window->findChild<TimelineLanes*>()) {}

  QPoint place(Lane lane, int k, int count) const {
    const QRectF rect = lanes->rect_of(lane);
    return QPointF(TimelineLanes::position(rect, k, count), rect.center().y()).toPoint();
  }
  int steps() const { return focus.map()->history.step_count(); }
  /// With the left button held, which QTest::mouseMove() does not support.
  void drag_to(const QPoint& place) const {
    QMouseEvent move(QEvent::MouseMove, place, Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(lanes, &move);
  }
  bool settles() const {
    return wait_for([this] { return window->settled(); });
  }
};

}  // namespace

class SteppingTest : public QObject {
  Q_OBJECT

 private slots:
  void positions_on_a_lane_map_to_indices() {
    const QRectF lane(80, 0, 500, 10);
    for (const int count : {1, 7, 500, 499}) {
      for (int k = 0; k < count; ++k) {
        QCOMPARE(TimelineLanes::index(lane, TimelineLanes::position(lane, k, count), count), k);
      }
    }
    QCOMPARE(TimelineLanes::index(lane, -1e9, 7), 0);
    QCOMPARE(TimelineLanes::index(lane, 1e9, 7), 6);
  }

  void scrubs_through_polygons_and_directions() {
    const Stepping s("furnace");
    QVERIFY(s.ready);
    QVERIFY(s.focus.following());
    // The tool tip has the whole text.
    const auto tells_why = [text = s.window->findChild<QLabel*>("timeline_text")] {
      return text->toolTip().contains("Newest direction, complete");
    };
    QVERIFY(tells_why());
    const int count = s.steps() + 1;
    QTest::mousePress(s.lanes, Qt::LeftButton, {}, s.place(Lane::steps, 0, count));
    QCOMPARE(s.focus.position().step, -1);
    QVERIFY(!s.focus.following() && !tells_why());
    QVERIFY(s.settles());
    QCOMPARE(s.map_view->canvas()->polygon_count(), std::size_t{0});
    for (const int k : {1, 3, count - 1, 2}) {
      s.drag_to(s.place(Lane::steps, k, count));
      QCOMPARE(s.focus.position().step, k - 1);
      QVERIFY(s.settles());
      QCOMPARE(s.map_view->canvas()->polygon_count(),
               s.focus.map()->record().map_after(k - 1).size());
    }
    QTest::mouseRelease(s.lanes, Qt::LeftButton, {}, s.place(Lane::steps, 2, count));

    QTest::mouseClick(s.lanes, Qt::LeftButton, {}, s.place(Lane::directions, 5, s.focus.passes()));
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    QVERIFY((s.focus.position() == RunPosition{0, 5, 1}));
    QVERIFY(s.focus.map()->record().frame.omega == (*s.window->snapshot()->directions)[5]);
  }

  void shows_v_in_pixels() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    s.focus.go_to({0, 3, 20});
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    QVERIFY(s.settles());
    QVERIFY(!s.map_view->canvas()->pixels());
    const auto choose = [&](const char* action) {
      s.trigger(action);
      return s.settles();
    };
    const auto wrong = [&] { return s.map_view->canvas()->pixels()->wrong; };
    QVERIFY(choose("map_zbuffer"));
    QVERIFY(s.map_view->canvas()->pixels() != nullptr);
    QCOMPARE(s.map_view->canvas()->pixels()->step, 20);
    QCOMPARE(s.map_view->canvas()->pixels()->choice.resolution, 64);
    const double of_zbuffer = wrong();
    QVERIFY(of_zbuffer > 0.001 && of_zbuffer < 0.1);
    QVERIFY(s.text("map_text").contains("differ"));
    QVERIFY(choose("map_painter"));
    QCOMPARE(wrong(), of_zbuffer);  // the same pixel centers
    QVERIFY(choose("map_newell"));
    QCOMPARE(wrong(), of_zbuffer);
    QVERIFY(choose("map_rays"));
    QVERIFY(wrong() > of_zbuffer && wrong() < 3 * of_zbuffer);
    save_picture(*s.window, "map-rays");
    QVERIFY(choose("map_corrected"));
    QVERIFY(s.map_view->canvas()->pixels()->corrected);
    QCOMPARE(wrong(), s.map_view->canvas()->pixels()->corrected->wrong_share());
    QVERIFY(color_count(s.map_view->canvas()->grab().toImage()) > 8);
    s.map_view->set_labels_shown(true);
    QVERIFY(s.settles());
    save_picture(*s.window, "map-corrected");
    s.map_view->set_labels_shown(false);
    QVERIFY(choose("map_painter"));
    QVERIFY(choose("map_difference"));
    QCOMPARE(wrong(), 0.0);
    QVERIFY(!s.text("map_text").contains("differ"));
    QVERIFY(choose("map_exact"));
    QVERIFY(!s.map_view->canvas()->pixels());
  }

  void painting_can_be_canceled() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    MapPictureRequest request;
    request.map = s.focus.map();
    request.step = request.map->record().fullest_step();
    request.patch_colors = std::make_shared<const std::vector<Color8>>(27);
    request.size = {300, 200};
    request.transform = fit_map(*request.map, request.size);
    Cancellation canceled;
    canceled.cancel();
    for (const std::optional<Engine> engine :
         {std::optional<Engine>(), std::optional(Engine::zbuffer), std::optional(Engine::painter),
          std::optional(Engine::rays), std::optional(Engine::corrected)}) {
      request.choice.engine = engine;
      QVERIFY(!paint_map(request).image.isNull());
      QVERIFY_EXCEPTION_THROWN(paint_map(request, canceled), Canceled);
    }
  }

  void shows_the_hemicube_of_the_selected_patch() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    s.trigger("map_hemicube");
    QVERIFY(s.settles());
    const auto* hemicube = s.map_view->findChild<HemicubeView*>("hemicube_view");
    QVERIFY(hemicube->isVisible() && !hemicube->comparison());
    QVERIFY(s.text("map_text").contains("Select a patch"));
    s.window->selection.select(14);
    QVERIFY(s.settles());
    QVERIFY(hemicube->comparison());
    QCOMPARE(hemicube->comparison()->request.eye, 14);
    QCOMPARE(hemicube->comparison()->image.resolution, 64);
    QCOMPARE(hemicube->comparison()->exact.size(), std::size_t{27});
    const double wrong = hemicube->comparison()->wrong_share();
    QVERIFY(wrong > 0.001 && wrong < 0.4);
    QVERIFY(s.text("map_text").contains("On patch 14"));
    const auto picture = [&] {
      return s.map_view->findChild<QWidget*>("hemicube_view")->grab().toImage();
    };
    const QImage by_difference = picture();
    QVERIFY(color_count(by_difference) > 6);
    save_picture(*s.window, "hemicube-difference");
    s.trigger("map_difference");
    QVERIFY(s.settles());
    QVERIFY(hemicube->comparison()->exact.empty());
    QVERIFY(color_count(picture()) > 6);
    QVERIFY(picture() != by_difference);
    save_picture(*s.window, "hemicube-colors");
    s.trigger("map_exact");
    QVERIFY(s.settles());
    QVERIFY(s.map_view->canvas()->isVisible());
    QVERIFY(!hemicube->comparison());
  }

  void shows_why_newells_order_fails() {
    const Stepping s("boards");
    QVERIFY(s.ready);
    s.trigger("map_newell");
    // Along some directions, an order exists.
    std::string failure;
    for (int k = 0; k < s.focus.passes() && failure.empty(); ++k) {
      s.focus.go_to({0, k, 2});
      QVERIFY(wait_for([&] { return s.focus.arrived(); }));
      QVERIFY(s.settles());
      failure = s.map_view->canvas()->pixels()->failure;
    }
    QVERIFY2(failure.find("overlap in a cycle") != std::string::npos, failure.c_str());
    QVERIFY(s.text("map_text").contains("failed"));
    const QImage picture = s.map_view->canvas()->grab().toImage();
    QVERIFY(fraction_of(picture, theme::scene_background) > 0.8);
    QVERIFY(color_count(picture) > 4);  // the message
    save_picture(*s.window, "map-newell");
  }

  void keys_step() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    QApplication::setActiveWindow(s.window.get());  // Xvfb has no window manager
    s.focus.go_to({0, 3, 10});
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    const auto press = [&](Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
      QTest::keyClick(s.window.get(), key, modifiers);
      return wait_for([&] { return s.focus.arrived(); });
    };
    QVERIFY(press(Qt::Key_Period));
    QCOMPARE(s.focus.position().step, 11);
    QVERIFY(press(Qt::Key_Comma));
    QVERIFY(press(Qt::Key_Comma));
    QCOMPARE(s.focus.position().step, 9);
    QVERIFY(press(Qt::Key_BracketRight));
    QCOMPARE(s.focus.position().direction, 4);
    QVERIFY(press(Qt::Key_BracketLeft));
    QCOMPARE(s.focus.position().direction, 3);
    QVERIFY(press(Qt::Key_T));
    QVERIFY(s.focus.map()->history.step(s.focus.position().step).exchanges > 0);

    s.window->selection.select(4);
    const RunPosition before = s.focus.position();
    QVERIFY(press(Qt::Key_N));
    QVERIFY(before < s.focus.position());
    const auto events = s.focus.map()->history.steps_of(4);
    QVERIFY(std::find(events.begin(), events.end(), s.focus.position().step) != events.end());

    s.lanes->setFocus();
    const std::int32_t at = s.focus.position().step;
    QTest::keyClick(s.lanes, Qt::Key_Left);
    QCOMPARE(s.focus.position().step, at - 1);
    QTest::keyClick(s.lanes, Qt::Key_Right);
    QCOMPARE(s.focus.position().step, at);
    QVERIFY(press(Qt::Key_F));
    QVERIFY(s.focus.following());
  }

  void the_map_shows_what_a_step_does() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    s.focus.go_to({0, 3, -1});
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    s.focus.seek(find_where([](const MapHistory& history, std::int32_t k) {
                   return history.step(k).exchanges > 0 && !history.outside_at(k).empty();
                 }),
                 StepOrder::forward);
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    MapCanvas* canvas = s.map_view->canvas();
    s.window->findChild<QToolButton*>("map_near")->click();
    const auto picture_in = [&](const char* phase) {
      s.window->findChild<QToolButton*>(phase)->click();
      (void)s.settles();
      return canvas->grab().toImage();
    };
    const QImage before = picture_in("phase_before");
    const QImage split = picture_in("phase_split");
    const QImage after = picture_in("phase_after");
    for (const QImage& picture : {before, split, after}) {
      QVERIFY(fraction_of(picture, theme::processed) > 0);
    }
    QVERIFY(before != split && split != after && before != after);
    QVERIFY(fraction_of(split, theme::inside) > fraction_of(before, theme::inside));
    s.window->findChild<QToolButton*>("map_labels")->click();
    QVERIFY(s.settles());
    QVERIFY(canvas->grab().toImage() != after);
  }

  void all_views_show_the_step() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    s.trigger("layout_debug");
    s.focus.go_to({0, 3, -1});
    QVERIFY(s.settles());
    QCOMPARE(fraction_of(s.picture(), theme::processed), 0.0);
    s.focus.seek(find_where([](const MapHistory& history, std::int32_t k) {
                   return history.step(k).exchanges > 1 && history.outside_at(k).size() > 1;
                 }),
                 StepOrder::forward);
    s.focus.set_phase(Phase::split);
    QVERIFY(s.settles());
    const MapHistory::Step& step = s.focus.map()->history.step(s.focus.position().step);
    QVERIFY(s.text("value_i").startsWith(QString::number(step.patch)));
    QVERIFY(s.text("value_gathered").size() > 3);
    const auto* events = s.window->findChild<QTableView*>("step_events");
    QCOMPARE(events->model()->rowCount(), step.cut + 1);
    QVERIFY(fraction_of(s.picture(), theme::processed) > 0);
    // A click in the table selects the patch of the polygon that was cut.
    const QModelIndex above = events->model()->index(1, 3);
    QTest::mouseClick(events->viewport(), Qt::LeftButton, {}, events->visualRect(above).center());
    QCOMPARE(s.window->selection.patch(), above.data().toInt());
    QVERIFY(comes_to_rest(*s.window));
    save_picture(*s.window, "step");
  }

  void a_click_in_the_map_lists_the_line() {
    const Stepping s("furnace");
    QVERIFY(s.ready);
    s.trigger("layout_debug");
    s.window->views().docks.bring_to_front("event");
    s.focus.go_to({0, 3, 1 << 30});
    QVERIFY(s.settles());
    MapCanvas* canvas = s.map_view->canvas();
    QTest::mouseClick(canvas, Qt::LeftButton, {},
                      QPoint(canvas->width() / 2, canvas->height() / 2 - 12));
    const auto* line = s.window->findChild<QTableView*>("line_events");
    QVERIFY(line->isVisible());
    QVERIFY(line->model()->rowCount() >= 2);
    const int last = line->model()->rowCount() - 1;
    QCOMPARE(line->model()->index(last, 1).data().toInt(), s.window->selection.patch());
    // Go to the step of the line's first fragment.
    const QPoint first = line->visualRect(line->model()->index(0, 1)).center();
    QTest::mouseClick(line->viewport(), Qt::LeftButton, {}, first);
    QTest::mouseDClick(line->viewport(), Qt::LeftButton, {}, first);
    QCOMPARE(s.focus.position().step + 1, line->model()->index(0, 0).data().toInt());
    // With the global map, the line's patches are the region's list.
    s.window->findChild<QComboBox*>("map_kind")->setCurrentIndex(1);
    QCOMPARE(s.text("value_region_list").split(", ").size(), line->model()->rowCount());
    QVERIFY(s.text("value_region_i").startsWith(line->model()->index(0, 1).data().toString()));
    QVERIFY(comes_to_rest(*s.window));
    save_picture(*s.window, "global");
    // R is highlighted on the map, but only with the global map.
    QVERIFY(fraction_of(canvas->grab().toImage(), theme::region) > 0.002);
    s.window->findChild<QComboBox*>("map_kind")->setCurrentIndex(0);
    QVERIFY(fraction_of(canvas->grab().toImage(), theme::region) < 1e-4);
  }

  void plays_until_the_end_of_the_run() {
    const SolvedWindow s("boards", {.directions = 8});
    TestWindow& window = *s.window;
    Focus& focus = window.focus;
    focus.go_to({0, 5, 0});
    QVERIFY(wait_for([&] { return window.settled(); }));
    PlayControl& play = *window.findChild<PlayControl*>();
    QSignalSpy turned(&play, &PlayControl::turned);
    window.findChild<QAction*>("play_turns")->setChecked(true);
    const ViewPoint before = s.scene_view->view_point();
    play.set_by(PlayControl::By::directions);
    play.set_speed(50);
    std::set<int> seen;
    connect(&focus, &Focus::moved, &play, [&] { seen.insert(focus.position().direction); });
    s.trigger("play");
    QVERIFY(play.action()->isChecked() && play.playing());
    QVERIFY(wait_for([&] { return !play.action()->isChecked(); }));
    QCOMPARE(focus.target().direction, 7);
    QCOMPARE(seen, (std::set<int>{6, 7}));
    QCOMPARE(turned.count(), 2);
    QVERIFY(norm(s.scene_view->view_point().eye - before.eye) > 0);

    // The animation of polygons continues into the next direction; a second click stops it.
    play.set_by(PlayControl::By::polygons);
    focus.go_to({0, 2, 0});
    QVERIFY(wait_for([&] { return window.settled() && play.action()->isEnabled(); }));
    s.trigger("play");
    QVERIFY(wait_for([&] { return focus.position().direction >= 3; }));
    s.trigger("play");
    const RunPosition stopped = focus.target();
    handle_posted();
    QVERIFY(!play.playing() && focus.target() == stopped);

    // While there is no direction to show, the animation can be stopped, but not started.
    s.trigger("play");
    focus.begin_run(0);
    QVERIFY(play.action()->isChecked() && play.action()->isEnabled());
    s.trigger("play");
    QVERIFY(!play.action()->isChecked() && !play.action()->isEnabled());
  }

  void plays_only_with_a_scene() {
    const auto window = make_window({.directions = 8});
    auto* play = window->findChild<QAction*>("play");
    QVERIFY(!play->isEnabled());
    window->open("boards", {Goal::Kind::iteration});
    QVERIFY(wait_for([&] { return play->isEnabled() && window->focus.map(); }));
  }

  void breakpoints_belong_to_their_scene() {
    const SolvedWindow s("boards");
    TestWindow& window = *s.window;
    window.breakpoints.add({Breakpoint::Kind::patch, 3});
    const auto open = [&](const QString& scene) {
      window.files().open_scene(scene);
      return wait_for([&] { return window.windowTitle().startsWith(scene) && window.settled(); });
    };
    QVERIFY(open("furnace"));
    QVERIFY(window.breakpoints.list().empty());
    QVERIFY(open("boards"));
    QCOMPARE(window.breakpoints.list().size(), std::size_t{1});
    window.files().open_lesson("5");
    QVERIFY(window.breakpoints.list().empty());
    QVERIFY(wait_for([&] { return window.settled(); }));
    QVERIFY(window.breakpoints.list().empty());
    window.files().open_scene("boards");
    QVERIFY(wait_for([&] { return window.breakpoints.list().size() == 1; }));
  }

  void breakpoints_stop_a_run() {
    const Stepping s("cornell-box");
    QVERIFY(s.ready);
    s.trigger("layout_debug");
    s.focus.go_to({0, 3, -1});
    QVERIFY(s.settles());
    s.window->selection.select(9);
    QCOMPARE(s.window->findChild<QSpinBox*>("breakpoint_patch")->value(), 9);
    s.window->findChild<QToolButton*>("add_breakpoint")->click();
    QCOMPARE(s.window->breakpoints.list().size(), std::size_t{1});
    std::vector<RunPosition> stops;
    for (int k = 0; k < 6; ++k) {
      s.trigger("run_on");
      QVERIFY(wait_for([&] { return s.focus.arrived(); }));
      stops.push_back(s.focus.position());
      const auto steps = s.focus.map()->history.steps_of(9);
      QVERIFY(std::find(steps.begin(), steps.end(), s.focus.position().step) != steps.end());
    }
    // The list marks the breakpoint that holds.
    s.window->breakpoints.add({Breakpoint::Kind::large_map, 0, 0, 1e6, true});
    const auto* marked = s.window->findChild<QListWidget*>("breakpoint_list");
    QVERIFY(marked->item(0)->text().endsWith("here") && marked->item(0)->font().bold());
    QVERIFY(!marked->item(1)->text().endsWith("here"));
    s.window->breakpoints.remove(1);
    QVERIFY(stops.front().direction < stops.back().direction || stops.size() == 6);
    for (int k = 4; k >= 0; --k) {
      s.trigger("run_back");
      QVERIFY(wait_for([&] { return s.focus.arrived(); }));
      QVERIFY(s.focus.position() == at(stops, k));
    }
    auto* list = s.window->findChild<QListWidget*>("breakpoint_list");
    list->item(0)->setCheckState(Qt::Unchecked);
    QVERIFY(!s.window->findChild<QAction*>("run_on")->isEnabled());
    // Each can be run to from its menu, even if disabled.
    const QPoint item = list->visualItemRect(list->item(0)).center();
    for (const int action : {1, 0}) {
      emit list->customContextMenuRequested(item);
      auto* menu = s.window->findChild<QMenu*>("breakpoint_menu");
      QVERIFY(menu != nullptr);
      menu->actions()[action]->trigger();
      menu->close();
      QVERIFY(wait_for([&] { return s.focus.arrived(); }));
      QVERIFY(s.focus.position() == stops[action == 1 ? 1 : 0]);
      QVERIFY(wait_for([&] { return !s.window->findChild<QMenu*>("breakpoint_menu"); }));
    }
    list->setCurrentRow(0);
    s.window->findChild<QToolButton*>("remove_breakpoint")->click();
    QCOMPARE(list->count(), 0);
  }

  void charts_mark_the_position_and_change_it() {
    const Stepping s("furnace");
    QVERIFY(s.ready);
    auto* directions = s.window->findChild<LogChart*>("direction_chart");
    auto* iterations = s.window->findChild<LogChart*>("iteration_chart");
    s.focus.go_to({0, 6, 2});
    QVERIFY(s.settles());
    QCOMPARE(directions->mark(), std::optional(7));
    QCOMPARE(iterations->mark(), std::optional(1));
    const QImage before = directions->grab().toImage();
    QTest::mouseClick(directions, Qt::LeftButton, {}, directions->position_of(21).toPoint());
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    QVERIFY((s.focus.position() == RunPosition{0, 20, 2}));
    QCOMPARE(directions->mark(), std::optional(21));
    QVERIFY(directions->grab().toImage() != before);

    s.trigger("one_iteration");
    QVERIFY(wait_for([&] { return s.focus.iterations() == 2 && s.window->settled(); }));
    QTest::mouseClick(iterations, Qt::LeftButton, {}, iterations->position_of(2).toPoint());
    QVERIFY(wait_for([&] { return s.focus.arrived(); }));
    QVERIFY((s.focus.position() == RunPosition{1, 20, 2}));
    QCOMPARE(iterations->mark(), std::optional(2));
  }

  void every_iteration_of_the_semi_iterative_scheme_can_be_shown() {
    const auto window = make_window();
    SolveOptions options;
    options.directions = 16;
    options.scheme = Scheme::semi_iterative;
    options.burn_in = 1;
    options.iterations = 3;
    window->set_options(options, {});
    window->open("furnace", {Goal::Kind::finished});
    QVERIFY(wait_for([&] {
      return window->snapshot() && window->snapshot()->progress.finished && window->settled();
    }));
    const RadiositySolver solver(load_scene("furnace"), options);
    QVERIFY(solver.direction(0, 5) != solver.direction(2, 5));
    for (const int n : {2, 0, 1}) {
      window->focus.go_to({n, 5, 1});
      QVERIFY(wait_for([&] { return window->focus.arrived(); }));
      QCOMPARE(window->focus.position().iteration, n);
      QVERIFY(window->focus.map()->record().frame.omega == solver.direction(n, 5));
    }
  }

  void a_new_run_resets_the_focus() {
    const Stepping s("furnace");
    QVERIFY(s.ready);
    s.focus.go_to({0, 2, 1});
    QVERIFY(s.settles());
    s.trigger("stop");
    QVERIFY(wait_for([&] { return !s.focus.map(); }));
    QVERIFY(s.focus.following());
    QTest::mouseClick(s.lanes, Qt::LeftButton, {}, s.place(Lane::directions, 1, s.focus.passes()));
    QVERIFY(wait_for([&] { return s.focus.map() && s.focus.map()->direction == 1; }));
  }
};

const test::Registered registered("stepping", test::run_as_viewer<SteppingTest>);

}  // namespace transillum::viewer::stepping_test

#include "stepping_test.moc"
