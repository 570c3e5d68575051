// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/focus.h"

#include <QSignalSpy>
#include <QTest>
#include <algorithm>

#include "registered.h"
#include "transillum/at.h"
#include "transillum/directions.h"

namespace transillum::viewer::focus_test {

namespace {

constexpr int passes = 4;

/// A focus with the recorded directions of a small scene; the test decides when each arrives.
struct FocusWithMaps {
  std::shared_ptr<LoadedScene> loaded = std::make_shared<LoadedScene>();
  std::vector<std::shared_ptr<const RecordedMap>> maps;
  Focus focus;
  std::vector<int> requested;  ///< directions
  bool answers_at_once = true;

  FocusWithMaps() {
    loaded->scene = load_scene("boards");
    loaded->tree = std::make_shared<BspTree>(*loaded->scene);
    const auto samples = make_directions(Sampling::random, passes, 3);
    for (int d = 0; d < passes; ++d) {
      auto map = std::make_shared<RecordedMap>();
      const Vec3& omega = at(samples, d).direction;
      map->history = MapHistory(record_local_map(*loaded->scene, *loaded->tree, omega).record);
      map->loaded = loaded;
      map->direction = d;
      map->passes = passes;
      maps.push_back(map);
    }
    QObject::connect(&focus, &Focus::map_requested, &focus, [this](int iteration, int direction) {
      requested.push_back(direction);
      if (answers_at_once) {
        show(direction, iteration);
      }
    });
    focus.begin_run(passes);
  }
  void show(int direction, int iteration = 0) {
    auto map = std::make_shared<RecordedMap>(*at(maps, direction));
    map->iteration = iteration;
    focus.show_map(map);
  }
  std::int32_t last_step(int direction) const {
    return at(maps, direction)->history.step_count() - 1;
  }
  bool arrived_at(const RunPosition& position) const {
    return focus.position() == position && focus.arrived() && focus.map() &&
           focus.map()->direction == position.direction;
  }
};

}  // namespace

class FocusTest : public QObject {
  Q_OBJECT

 private slots:
  void positions_are_ordered() {
    QVERIFY((RunPosition{0, 3, 100}) < (RunPosition{1, 0, -1}));
    QVERIFY((RunPosition{1, 2, 7}) < (RunPosition{1, 3, -1}));
    QVERIFY((RunPosition{1, 2, -1}) < (RunPosition{1, 2, 0}));
  }

  void follows_the_newest_until_it_is_moved() {
    FocusWithMaps w;
    w.focus.follow(0, 0);
    QCOMPARE(w.focus.position().step, w.last_step(0));
    w.focus.follow(0, 2);
    QVERIFY(w.arrived_at({0, 2, w.last_step(2)}));
    QVERIFY(!w.focus.at_step());
    w.focus.step_by(-1);
    QVERIFY(!w.focus.following() && w.focus.at_step());
    const RunPosition here = w.focus.position();
    w.focus.follow(0, 3);
    QVERIFY(w.arrived_at(here));
    w.focus.set_following(true);
    QVERIFY(w.arrived_at({0, 3, w.last_step(3)}));
    QVERIFY(!w.focus.at_step());
  }

  void a_step_has_the_reason_of_the_command_that_chose_it() {
    FocusWithMaps w;
    w.focus.follow(0, 1);
    QCOMPARE(w.focus.reason(), StepReason::none);
    w.focus.step_by(1);
    QVERIFY(w.arrived_at({0, 1, 0}));
    QCOMPARE(w.focus.reason(), StepReason::stepped);
    w.focus.go_to_step(3);
    QCOMPARE(w.focus.reason(), StepReason::chosen);
    const StepFinder last = [](const MapHistory& history, std::int32_t from, StepOrder) {
      return from < history.step_count() - 1 ? history.step_count() - 1 : MapHistory::none;
    };
    w.focus.seek(last, StepOrder::forward, StepReason::breakpoint);
    QVERIFY(w.arrived_at({0, 1, w.last_step(1)}));
    QCOMPARE(w.focus.reason(), StepReason::breakpoint);
    // A search without success leaves step and reason.
    w.focus.seek([](const MapHistory&, std::int32_t, StepOrder) { return MapHistory::none; },
                 StepOrder::forward);
    QCOMPARE(w.focus.reason(), StepReason::breakpoint);
    w.focus.direction_by(1);
    QCOMPARE(w.focus.reason(), StepReason::breakpoint);
    w.focus.show_whole();
    QVERIFY(!w.focus.at_step() && !w.focus.following());
    QVERIFY(w.arrived_at({0, 2, w.last_step(2)}));
    w.focus.direction_by(1);
    QVERIFY(!w.focus.at_step());
    QVERIFY(w.arrived_at({0, 3, w.last_step(3)}));
    // While a map is awaited, the reason is of the step shown.
    w.answers_at_once = false;
    w.focus.go_to({0, 0, 2});
    QVERIFY(!w.focus.at_step());
    w.show(0);
    QCOMPARE(w.focus.reason(), StepReason::chosen);
  }

  /// In the run, the first iteration had one direction, the second two, the third all four.
  void offers_the_directions_that_an_iteration_had() {
    FocusWithMaps w;
    w.focus.set_passes_of_iterations({1, 2, 4});
    w.focus.set_iterations(3);
    w.focus.go_to({0, 3, 1});
    QVERIFY(w.arrived_at({0, 0, 1}));
    std::vector<std::pair<int, int>> visited;
    for (int k = 0; k < 8; ++k) {
      visited.emplace_back(w.focus.position().iteration, w.focus.position().direction);
      w.focus.direction_by(1);
    }
    const std::vector<std::pair<int, int>> expected{{0, 0}, {1, 0}, {1, 1}, {2, 0},
                                                    {2, 1}, {2, 2}, {2, 3}, {2, 3}};
    QCOMPARE(visited, expected);
    w.focus.direction_by(-4);
    QCOMPARE(w.focus.position().iteration, 1);
    QCOMPARE(w.focus.position().direction, 1);
    w.focus.iteration_by(-1);
    QCOMPARE(w.focus.position().direction, 0);
    // A search reaches directions of later iterations that the earlier iterations did not have.
    w.focus.go_to({0, 0, w.last_step(0)});
    w.requested.clear();
    w.focus.seek([](const MapHistory&, std::int32_t, StepOrder) { return MapHistory::none; },
                 StepOrder::forward);
    QVERIFY(std::find(w.requested.begin(), w.requested.end(), 3) != w.requested.end());
    QCOMPARE(w.focus.position().iteration, 0);
  }

  void goes_to_the_first_step_that_is_found() {
    FocusWithMaps w;
    w.focus.follow(0, 0);
    const PatchId patch = w.maps[2]->history.step(w.last_step(2)).patch;
    w.focus.go_to_first(0, 2, find_exchanges_of(patch));
    const MapHistory& history = w.maps[2]->history;
    std::int32_t expected = MapHistory::none;
    for (std::int32_t k = history.step_count() - 1; k >= 0; --k) {
      for (const std::int32_t r : history.inside_at(k)) {
        if (history.exchanges(r) &&
            (history.step(k).patch == patch || history.row(r).patch == patch)) {
          expected = k;
        }
      }
    }
    QVERIFY(w.arrived_at({0, 2, expected}));
    QVERIFY(!w.focus.following());
    w.focus.go_to_first(0, 3, find_exchanges_of(100000));
    QVERIFY(w.arrived_at({0, 3, -1}));
  }

  void the_same_newest_direction_is_shown_once() {
    FocusWithMaps w;
    w.focus.follow(0, 1);
    const QSignalSpy moved(&w.focus, &Focus::moved);
    w.focus.follow(0, 1);
    QCOMPARE(moved.count(), 0);
  }

  void steps_go_through_all_directions_and_back() {
    FocusWithMaps w;
    w.focus.go_to({0, 0, -1});
    std::vector<RunPosition> visited{w.focus.position()};
    while (w.focus.step_by(1)) {
      visited.push_back(w.focus.position());
    }
    std::size_t expected = 0;
    for (int d = 0; d < passes; ++d) {
      expected += static_cast<std::size_t>(w.last_step(d) + 2);
    }
    QCOMPARE(visited.size(), expected);
    QVERIFY(w.arrived_at({0, passes - 1, w.last_step(passes - 1)}));
    for (std::size_t k = 1; k < visited.size(); ++k) {
      QVERIFY(visited[k - 1] < visited[k]);
    }
    for (std::size_t k = visited.size(); k-- > 1;) {
      QVERIFY(w.arrived_at(visited[k]));
      QVERIFY(w.focus.step_by(-1));
    }
    QVERIFY(w.arrived_at({0, 0, -1}));
    QVERIFY(!w.focus.step_by(-1));
  }

  void a_phase_is_a_part_of_a_step() {
    FocusWithMaps w;
    w.focus.go_to({0, 0, -1});
    w.focus.phase_by(1);
    for (std::int32_t k = 0; k <= w.last_step(0); ++k) {
      for (const Phase phase : {Phase::before, Phase::split, Phase::after}) {
        QVERIFY(w.arrived_at({0, 0, k}));
        QVERIFY(w.focus.phase() == phase);
        w.focus.phase_by(1);
      }
    }
    QVERIFY(w.arrived_at({0, 1, -1}));
    w.focus.phase_by(-1);
    QVERIFY(w.arrived_at({0, 0, w.last_step(0)}));
    QVERIFY(w.focus.phase() == Phase::after);
    w.focus.phase_by(-1);
    QVERIFY(w.focus.phase() == Phase::split);
    // There is no phase before the start of the run.
    w.focus.go_to({0, 0, -1});
    w.focus.phase_by(-1);
    QVERIFY(w.arrived_at({0, 0, -1}));
  }

  void iterations_that_have_not_begun_cannot_be_focused() {
    FocusWithMaps w;
    w.focus.go_to({0, 1, 2});
    w.focus.iteration_by(1);
    QVERIFY(w.arrived_at({0, 1, 2}));
    w.focus.set_iterations(3);
    w.focus.iteration_by(1);
    QVERIFY(w.arrived_at({1, 1, 2}));
    w.focus.go_to({1, passes - 1, 0});
    w.focus.direction_by(1);
    QVERIFY(w.arrived_at({2, 0, 0}));
    w.focus.go_to({9, 99, 1 << 30});
    QVERIFY(w.arrived_at({2, passes - 1, w.last_step(passes - 1)}));
    w.focus.go_to({-9, -9, -9});
    QVERIFY(w.arrived_at({0, 0, -1}));
  }

  void iterations_may_have_directions_of_their_own() {
    FocusWithMaps w;
    w.focus.begin_run(passes, true);
    w.focus.set_iterations(3);
    w.focus.go_to({0, 2, 1});
    QVERIFY(w.arrived_at({0, 2, 1}));
    w.requested.clear();
    w.focus.iteration_by(2);
    QVERIFY(w.arrived_at({2, 2, 1}));
    QCOMPARE(w.focus.map()->iteration, 2);
    QCOMPARE(w.requested, std::vector<int>{2});  // not the current map
    w.focus.go_to({1, 2, 0});
    QCOMPARE(w.focus.map()->iteration, 1);
    // A search goes through the directions of all iterations.
    w.requested.clear();
    w.focus.go_to({0, 0, -1});
    w.focus.seek(find_where([](const MapHistory&, std::int32_t) { return false; }),
                 StepOrder::forward);
    QVERIFY(w.arrived_at({0, 0, -1}));
    QCOMPARE(w.requested.size(), std::size_t{3 * passes});
    // An outdated map is shown with its own iteration.
    w.answers_at_once = false;
    w.focus.go_to({1, 1, 0});
    w.focus.go_to({2, 1, 0});
    w.show(1, 1);
    QVERIFY(!w.focus.arrived());
    QCOMPARE(w.focus.position().iteration, 1);
    w.show(1, 2);
    QVERIFY(w.arrived_at({2, 1, 0}));
  }

  void the_old_position_stays_until_the_new_one_is_recorded() {
    FocusWithMaps w;
    w.focus.go_to({0, 0, 1});
    w.answers_at_once = false;
    w.focus.go_to({0, 2, 3});
    QVERIFY(!w.focus.arrived());
    QCOMPARE(w.focus.position().direction, 0);
    QCOMPARE(w.focus.map()->direction, 0);
    QCOMPARE(w.focus.target().direction, 2);
    w.show(2);
    QVERIFY(w.arrived_at({0, 2, 3}));
  }

  void the_newest_target_replaces_older_ones() {
    FocusWithMaps w;
    w.focus.go_to({0, 0, 1});
    w.answers_at_once = false;
    w.focus.go_to({0, 1, 0});
    w.focus.go_to({0, 3, 0});
    w.show(1);  // shown although it is outdated
    QVERIFY(!w.focus.arrived());
    QCOMPARE(w.focus.position().direction, 1);
    w.show(3);
    QVERIFY(w.arrived_at({0, 3, 0}));
    w.show(1);  // outdated
    QVERIFY(w.arrived_at({0, 3, 0}));
  }

  void searches_all_directions() {
    FocusWithMaps w;
    w.focus.go_to({0, 0, -1});
    const PatchId patch = 2;
    std::vector<RunPosition> expected;
    for (int d = 0; d < passes; ++d) {
      for (const std::int32_t k : at(w.maps, d)->history.steps_of(patch)) {
        expected.push_back({0, d, k});
      }
    }
    QVERIFY(expected.front().direction < expected.back().direction);
    const QSignalSpy ended(&w.focus, &Focus::seek_ended);
    for (const RunPosition& position : expected) {
      w.focus.seek(find_events_of(patch), StepOrder::forward);
      QVERIFY(w.arrived_at(position));
    }
    w.focus.seek(find_events_of(patch), StepOrder::forward);
    QVERIFY(w.arrived_at(expected.back()));
    QCOMPARE(ended.back().front().toBool(), false);
    for (std::size_t k = expected.size() - 1; k-- > 0;) {
      w.focus.seek(find_events_of(patch), StepOrder::backward);
      QVERIFY(w.arrived_at(expected[k]));
    }
  }

  void a_search_without_a_match_ends_after_all_directions() {
    FocusWithMaps w;
    w.focus.set_iterations(1000);
    w.focus.go_to({500, 1, 3});
    w.requested.clear();
    const QSignalSpy ended(&w.focus, &Focus::seek_ended);
    for (const StepOrder order : {StepOrder::forward, StepOrder::backward}) {
      w.focus.seek(find_where([](const MapHistory&, std::int32_t) { return false; }), order);
      QVERIFY(w.arrived_at({500, 1, 3}));
    }
    QCOMPARE(ended.count(), 2);
    QVERIFY(w.requested.size() <= 2 * passes);
  }

  void a_search_can_be_stopped() {
    FocusWithMaps w;
    w.focus.go_to({0, 0, 3});
    w.answers_at_once = false;
    const QSignalSpy ended(&w.focus, &Focus::seek_ended);
    w.focus.seek(find_where([](const MapHistory&, std::int32_t) { return false; }),
                 StepOrder::forward);
    QVERIFY(w.focus.seeking());
    const QSignalSpy stopped(&w.focus, &Focus::seek_stopped);
    w.focus.stop();
    QVERIFY(!w.focus.seeking());
    QVERIFY(w.arrived_at({0, 0, 3}));
    QCOMPARE(ended.count(), 0);
    QCOMPARE(stopped.count(), 1);
    QCOMPARE(stopped.back().front().toInt(), 1);
    w.show(1);
    QVERIFY(w.arrived_at({0, 0, 3}));
  }

  void finds_the_steps_that_cover_a_point() {
    const FocusWithMaps w;
    const MapHistory& history = w.maps[1]->history;
    const MapRecord& record = history.record();
    const MapRecord::Row& row = record.rows[record.rows.size() / 2];
    Vec2 p{0, 0};
    const auto outline = record.outline(row);
    for (const Vec2& corner : outline) {
      p.x += corner.x / static_cast<double>(outline.size());
      p.y += corner.y / static_cast<double>(outline.size());
    }
    const auto top_after = [&](std::int32_t step) {
      for (const std::int32_t r : record.map_after(step)) {
        if (record.covers(history.row(r), p)) {
          return history.row(r).patch;
        }
      }
      return no_patch;
    };
    const StepFinder finder = find_changes_at(p);
    std::int32_t k = -1;
    int changes = 0;
    while ((k = finder(history, k, StepOrder::forward)) != MapHistory::none) {
      QCOMPARE(top_after(k), history.step(k).patch);
      ++changes;
    }
    QVERIFY(changes > 0);
  }
};

const test::Registered registered("focus", test::run_without_widgets<FocusTest>);

}  // namespace transillum::viewer::focus_test

#include "focus_test.moc"
