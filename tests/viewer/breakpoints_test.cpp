// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Breakpoints and their undo, without a window.
#include "state/breakpoints.h"

#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUndoStack>
#include <algorithm>
#include <iterator>
#include <set>

#include "recorded_direction.h"
#include "registered.h"
#include "state/camera_views.h"
#include "transillum/at.h"

namespace transillum::viewer::breakpoints_test {

using test::Direction;

namespace {

using Kind = Breakpoint::Kind;

RunPosition nowhere() { return {}; }

std::vector<std::int32_t> steps_where(const MapHistory& history, const Breakpoint& breakpoint) {
  Breakpoints breakpoints;
  breakpoints.add(breakpoint);
  return breakpoints.steps_in(history);
}

}  // namespace

class BreakpointsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_patch_breakpoint_holds_where_the_patch_is_involved() {
    const Direction d("cornell-box");
    for (PatchId patch = 0; patch < d.scene->scene->patch_count(); ++patch) {
      const auto expected = d.history().steps_of(patch);
      const auto steps = steps_where(d.history(), {Kind::patch, patch});
      QVERIFY(std::equal(steps.begin(), steps.end(), expected.begin(), expected.end()));
      std::vector<std::int32_t> cut;
      for (const MapRecord::Row& row : d.history().record().rows) {
        if (row.patch == patch && row.made == row.consumed &&
            (cut.empty() || cut.back() != row.made)) {
          cut.push_back(row.made);
        }
      }
      QCOMPARE(steps_where(d.history(), {Kind::cut, patch}), cut);
    }
  }

  void a_pair_breakpoint_holds_where_the_pair_exchanges() {
    const Direction d("cornell-box");
    QVERIFY(!d.transfers.exchanges.empty());
    for (const Transfer& transfer : d.transfers.exchanges) {
      const auto steps = steps_where(d.history(), {Kind::pair, transfer.receiver, transfer.source});
      QVERIFY(!steps.empty());
      QCOMPARE(steps_where(d.history(), {Kind::pair, transfer.source, transfer.receiver}), steps);
      for (const std::int32_t k : steps) {
        QCOMPARE(d.history().step(k).patch, transfer.receiver);
      }
    }
    QVERIFY(steps_where(d.history(), {Kind::pair, 0, 0}).empty());
  }

  void a_threshold_breakpoint_holds_where_its_value_is_passed() {
    const Direction d("cornell-box");
    const MapHistory& history = d.history();
    int largest = 0;
    double smallest = HUGE_VAL;
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      largest = std::max(largest, history.step(k).map_size);
      if (history.step(k).row != MapRecord::no_row) {
        smallest = std::min(smallest, history.step(k).smallest);
      }
    }
    for (const Kind kind : {Kind::large_map, Kind::growing_map}) {
      QVERIFY(steps_where(history, {kind, 0, 0, static_cast<double>(largest)}).empty());
      QVERIFY(!steps_where(history, {kind, 0, 0, largest - 1.0}).empty());
    }
    // A large map is a state: it holds at each step. Growing is the step that passes the bound.
    const auto large = steps_where(history, {Kind::large_map, 0, 0, largest / 2.0});
    std::vector<std::int32_t> passing;
    std::size_t above = 0;
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      const bool is_above = history.step(k).map_size > largest / 2.0;
      above += is_above ? 1 : 0;
      QCOMPARE(std::binary_search(large.begin(), large.end(), k), is_above);
      if (is_above && (k == 0 || history.step(k - 1).map_size <= largest / 2.0)) {
        passing.push_back(k);
      }
    }
    QVERIFY(above > passing.size() && !passing.empty());
    QCOMPARE(steps_where(history, {Kind::growing_map, 0, 0, largest / 2.0}), passing);
    QVERIFY(steps_where(history, {Kind::small_fragment, 0, 0, smallest}).empty());
    QVERIFY(!steps_where(history, {Kind::small_fragment, 0, 0, smallest + 1e-9}).empty());
  }

  void a_closed_scene_has_no_open_receiver() {
    const Breakpoint open{Kind::open_receiver, 0, 0, 1e-9};
    QVERIFY(steps_where(Direction("furnace").history(), open).empty());
    // With a bound below any defect, the breakpoint holds at every receiver.
    const Direction d("furnace");
    std::vector<std::int32_t> receivers;
    for (std::int32_t k = 0; k < d.history().step_count(); ++k) {
      if (d.history().step(k).front_facing) {
        receivers.push_back(k);
      }
    }
    QCOMPARE(steps_where(d.history(), {Kind::open_receiver, 0, 0, -1}), receivers);
  }

  void disabled_breakpoints_do_not_hold() {
    const Direction d("cornell-box");
    Breakpoints breakpoints;
    breakpoints.add({Kind::patch, 3});
    breakpoints.add({Kind::patch, 5});
    const QSignalSpy changed(&breakpoints, &Breakpoints::changed);
    breakpoints.set_enabled(0, false);
    QCOMPARE(changed.count(), 1);
    QCOMPARE(breakpoints.steps_in(d.history()), steps_where(d.history(), {Kind::patch, 5}));
    breakpoints.set_enabled(1, false);
    QVERIFY(!breakpoints.any_enabled());
    QVERIFY(breakpoints.steps_in(d.history()).empty());
    breakpoints.remove(0);
    QCOMPARE(breakpoints.list().size(), std::size_t{1});
    QCOMPARE(breakpoints.list()[0].condition.patch, 5);
  }

  void conditions_are_joined_by_and_and_or() {
    const Direction d("cornell-box");
    const auto steps = [&](const Breakpoint& breakpoint) {
      const auto list = steps_where(d.history(), breakpoint);
      return std::set<std::int32_t>(list.begin(), list.end());
    };
    int tried = 0;
    const PatchId count = d.scene->scene->patch_count();
    for (PatchId one = 0; one < count; ++one) {
      const Condition a{Kind::patch, (one + 5) % count}, b{Kind::cut, one},
          c{Kind::patch, (one + 1) % count};
      const auto of_a = steps({a}), of_b = steps({b}), of_c = steps({c});
      std::set<std::int32_t> both, either = of_a, a_or_both = of_a;
      std::set_intersection(of_b.begin(), of_b.end(), of_c.begin(), of_c.end(),
                            std::inserter(both, both.end()));
      either.insert(of_b.begin(), of_b.end());
      a_or_both.insert(both.begin(), both.end());
      tried += !both.empty() && both != of_b && both != of_c && a_or_both != of_a;
      QVERIFY(steps({b, true, {{false, c}}}) == both);
      QVERIFY(steps({a, true, {{true, b}}}) == either);
      // "And" binds more strongly, on both sides of "or".
      QVERIFY(steps({a, true, {{true, b}, {false, c}}}) == a_or_both);
      QVERIFY(steps({b, true, {{false, c}, {true, a}}}) == a_or_both);
    }
    QVERIFY(tried > 0);
    QCOMPARE(text_of({{Kind::patch, 3},
                      true,
                      {{true, {Kind::cut, 7}}, {false, {Kind::growing_map, 0, 0, 50}}},
                      4}),
             QString("Patch 3 takes part, or patch 7 is cut and V grows beyond 50 polygons (stop "
                     "at hit 4)"));
  }

  void a_run_counts_hits_and_stops_at_the_given_one() {
    const Direction d("cornell-box");
    const MapHistory& history = d.history();
    // The patch with the most events, and a patch that is cut.
    PatchId busy = 0;
    for (PatchId patch = 1; patch < d.scene->scene->patch_count(); ++patch) {
      if (history.steps_of(patch).size() > history.steps_of(busy).size()) {
        busy = patch;
      }
    }
    const auto steps = steps_where(history, {Kind::patch, busy});
    const auto cuts = steps_where(history, {Kind::cut, busy});
    QVERIFY(steps.size() >= 6 && !cuts.empty());
    Breakpoints breakpoints;
    breakpoints.add({{Kind::patch, busy}, true, {}, 3});
    breakpoints.add({{Kind::cut, busy}, true, {}, 1000});
    breakpoints.add({{Kind::patch, 5}, false});
    const auto hits = std::make_shared<HitCounts>();
    const StepFinder run = breakpoints.run_finder(hits, nowhere);
    QCOMPARE(run(history, -1, StepOrder::forward), steps[2]);
    const auto passed = [&](std::int32_t end) {
      return std::count_if(cuts.begin(), cuts.end(), [end](std::int32_t k) { return k <= end; });
    };
    const auto counts = [&] {
      std::vector<std::int64_t> numbers;
      for (const BreakpointHits& found : *hits) {
        numbers.push_back(found.steps);
      }
      return numbers;
    };
    QCOMPARE(counts(), (std::vector<std::int64_t>{3, passed(steps[2]), 0}));
    QCOMPARE(hits->front().first->step, steps[0]);
    // A run back from there stops at the third hit before it; a run back from the third hit stops
    // nowhere.
    QCOMPARE(breakpoints.run_finder(hits, nowhere)(history, steps[5], StepOrder::backward),
             steps[2]);
    QCOMPARE(breakpoints.run_finder(hits, nowhere)(history, steps[2], StepOrder::backward),
             MapHistory::none);
    QCOMPARE((*hits)[0].steps, 2);
  }

  // Patch 20 and more than 50 polygons: both at one step, though V has grown before.
  void a_state_is_joined_by_and_where_it_lasts() {
    const Direction d("cornell-box");
    const MapHistory& history = d.history();
    const PatchId last = history.step(history.step_count() - 1).patch;
    const double half = history.step(history.step_count() - 1).map_size / 2.0;
    const Breakpoint both{{Kind::patch, last}, true, {{false, {Kind::large_map, 0, 0, half}}}};
    QVERIFY(!steps_where(history, both).empty());
    const Breakpoint never{{Kind::patch, last}, true, {{false, {Kind::large_map, 0, 0, 500}}}};
    Breakpoints breakpoints;
    breakpoints.add(both);
    breakpoints.add(never);
    const auto hits = std::make_shared<HitCounts>();
    const RunPosition searched{.direction = 6};
    const StepFinder run = breakpoints.run_finder(hits, [&] { return searched; });
    for (std::int32_t k = run(history, -1, StepOrder::forward); k != MapHistory::none;) {
      k = run(history, k, StepOrder::forward);
    }
    QVERIFY(text_of_miss(both, (*hits)[0]).isEmpty());
    const auto steps = steps_where(history, {Kind::patch, last});
    QCOMPARE(text_of_miss(never, (*hits)[1]),
             QString("Patch %1 takes part: first in direction 7, step %2; %3 in all\n"
                     "V has more than 500 polygons: never")
                 .arg(last)
                 .arg(steps.front() + 1)
                 .arg(steps.size()));
  }

  void a_run_that_comes_back_counts_no_step_twice() {
    const Direction d("cornell-box");
    const Direction other("cornell-box", {0.1, -0.4, 0.7});
    const Breakpoint all{{Kind::patch, 3}, true, {}, 1'000'000};
    Breakpoints breakpoints;
    breakpoints.add(all);
    const auto here = steps_where(d.history(), all).size();
    const auto there = steps_where(other.history(), all).size();
    const auto total = static_cast<std::int64_t>(here + there);
    const std::int32_t middle = d.history().step_count() / 2;
    for (const StepOrder order : {StepOrder::forward, StepOrder::backward}) {
      const auto hits = std::make_shared<HitCounts>();
      const StepFinder run = breakpoints.run_finder(hits, nowhere);
      const auto from = [&](const MapHistory& history) {
        return order == StepOrder::forward ? -1 : history.step_count();
      };
      QCOMPARE(run(d.history(), middle, order), MapHistory::none);
      QCOMPARE(run(other.history(), from(other.history()), order), MapHistory::none);
      QCOMPARE(run(d.history(), from(d.history()), order), MapHistory::none);
      QCOMPARE((*hits)[0].steps, total);
    }
  }

  void running_forward_and_back_finds_the_same_steps() {
    const Direction d("cornell-box");
    Breakpoints breakpoints;
    breakpoints.add({Kind::patch, 3});
    breakpoints.add({Kind::cut, 7});
    const auto steps = breakpoints.steps_in(d.history());
    QVERIFY(steps.size() > 2);
    std::vector<std::int32_t> back;
    const StepFinder finder = breakpoints.finder();
    for (std::int32_t k = finder(d.history(), d.history().step_count(), StepOrder::backward);
         k != MapHistory::none; k = finder(d.history(), k, StepOrder::backward)) {
      back.insert(back.begin(), k);
    }
    QCOMPARE(back, steps);
  }

  void breakpoints_are_saved_in_settings() {
    const QTemporaryDir folder;
    Breakpoints before, after;
    before.set_scene("cornell-box");
    before.add({Kind::pair, 12, 7});
    before.set_scene("boards");
    before.add({Kind::small_fragment, 0, 0, 1.25e-9, false});
    before.add({{Kind::large_map, 0, 0, 1000},
                true,
                {{false, {Kind::cut, 4}}, {true, {Kind::pair, 5, 6}}},
                12});
    {
      QSettings settings(folder.filePath("kept.ini"), QSettings::IniFormat);
      before.save(settings);
    }
    QSettings settings(folder.filePath("kept.ini"), QSettings::IniFormat);
    after.set_scene("boards");
    after.load(settings);
    QVERIFY(after.list() == before.list());
    QCOMPARE(after.list().size(), std::size_t{2});
    after.set_scene("cornell-box");
    QCOMPARE(after.list().size(), std::size_t{1});
    after.set_scene("furnace");
    QVERIFY(after.list().empty());
    after.set_scene("boards");
    // A kind written by a later version is ignored.
    settings.setValue("breakpoints/2/kind", "unknown-kind");
    after.load(settings);
    QCOMPARE(after.list().size(), std::size_t{1});
  }

  void undo_names_the_change_of_a_breakpoint() {
    QUndoStack undo;
    Breakpoints breakpoints;
    breakpoints.set_undo_stack(&undo);
    breakpoints.add({Kind::patch, 3});
    breakpoints.add({Kind::large_map, 0, 0, 50});
    breakpoints.set_enabled(1, false);
    breakpoints.set_enabled(1, false);
    const auto before = breakpoints.list();
    breakpoints.remove(0);
    QCOMPARE(undo.count(), 4);
    QCOMPARE(undo.undoText(), QString("remove breakpoint: Patch 3 takes part"));
    undo.undo();
    QVERIFY(breakpoints.list() == before);
    QCOMPARE(undo.undoText(), QString("disable breakpoint: V has more than 50 polygons"));
    undo.undo();
    QVERIFY(breakpoints.list()[1].enabled);
    undo.undo();
    undo.undo();
    QVERIFY(breakpoints.list().empty());
    undo.setIndex(3);
    QVERIFY(breakpoints.list() == before);
  }

  void changes_of_saved_views_can_be_undone() {
    QUndoStack undo;
    CameraBookmarks views;
    views.set_undo_stack(&undo);
    const auto names = [&] {
      QStringList list;
      for (const auto& view : views.all()) {
        list << view.name;
      }
      return list;
    };
    views.add({});
    views.add({});
    views.remove(0);
    views.add({});  // takes an unused name
    QCOMPARE(names(), QStringList({"View 2", "View 3"}));
    views.rename(0, "mine");
    QCOMPARE(undo.undoText(), QString("rename view: View 2"));
    views.clear();
    QCOMPARE(names(), QStringList());
    undo.undo();
    QCOMPARE(names(), QStringList({"mine", "View 3"}));
    undo.undo();
    undo.undo();
    undo.undo();
    QCOMPARE(names(), QStringList({"View 1", "View 2"}));
  }
};

const test::Registered registered("breakpoints", test::run_without_widgets<BreakpointsTest>);

}  // namespace transillum::viewer::breakpoints_test

#include "breakpoints_test.moc"
