// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Breakpoints, events and the state of the algorithm, without a window.
#include "state/breakpoints.h"

#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUndoStack>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "registered.h"
#include "state/algorithm_state.h"
#include "state/camera_views.h"
#include "state/step_events.h"
#include "transillum/at.h"
#include "transillum/directions.h"
#include "visibility/map/map_region.h"

namespace transillum::viewer::breakpoints_test {

namespace {

using Kind = Breakpoint::Kind;

std::shared_ptr<const LoadedScene> loaded(const std::string& spec) {
  auto result = std::make_shared<LoadedScene>();
  result->scene = load_scene(spec);
  result->tree = std::make_shared<BspTree>(*result->scene);
  return result;
}

struct Direction {
  std::shared_ptr<const LoadedScene> scene;
  Transfers transfers;
  std::shared_ptr<RecordedMap> map = std::make_shared<RecordedMap>();

  explicit Direction(const std::string& spec, const Vec3& along = {0.3, 0.5, 0.8})
      : scene(loaded(spec)) {
    RecordedDirection recorded = record_local_map(*scene->scene, *scene->tree, normalized(along));
    transfers = std::move(recorded.transfers);
    map->loaded = scene;
    map->history = MapHistory(std::move(recorded.record));
    map->passes = 1;
  }
  const MapHistory& history() const { return map->history; }
};

/// A snapshot of the direction's scene, of 10 directions and their opposites, with B as it is.
SolverSnapshot snapshot_of(const Direction& d, const std::vector<Rgb>& radiosity) {
  SolverSnapshot snapshot;
  snapshot.loaded = d.scene;
  snapshot.progress.passes = 10;
  snapshot.kept_radiosity = {std::make_shared<const std::vector<Rgb>>(radiosity)};
  return snapshot;
}

/// Another B for each patch.
std::vector<Rgb> uneven_radiosity(const Scene& scene) {
  std::vector<Rgb> radiosity;
  for (PatchId p = 0; p < scene.patch_count(); ++p) {
    radiosity.push_back({1.0 + p, 2.0 + p, 0.5 * p});
  }
  return radiosity;
}

/// A focus before the first step of the direction.
struct FocusOn : Focus {
  explicit FocusOn(const Direction& d) {
    begin_run(1);
    go_to({0, 0, -1});
    show_map(d.map);
  }
};

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

  void events_of_a_step_are_its_cuts() {
    const Direction d("cornell-box");
    std::map<std::pair<PatchId, PatchId>, double> exchanged;
    for (std::int32_t k = 0; k < d.history().step_count(); ++k) {
      const auto events = events_of_step(d.history(), k);
      QCOMPARE(events.size(), static_cast<std::size_t>(d.history().step(k).cut + 1));
      QCOMPARE(events.front().above, no_patch);
      std::size_t parts = 0;
      for (const StepEvent& event : events) {
        QCOMPARE(event.step, k);
        parts += static_cast<std::size_t>(event.parts);
        if (event.kind == StepEvent::Kind::exchange) {
          exchanged[{event.below, event.above}] += event.area;
        }
      }
      QCOMPARE(parts, d.history().outside_at(k).size());
    }
    QCOMPARE(exchanged.size(), d.transfers.exchanges.size());
    for (const Transfer& transfer : d.transfers.exchanges) {
      QVERIFY(std::abs(exchanged[{transfer.receiver, transfer.source}] - transfer.area) < 1e-12);
    }
  }

  void events_of_a_patch_are_those_of_all_steps_with_it() {
    const Direction d("cornell-box");
    for (const PatchId patch : {0, 5, 11}) {
      std::size_t expected = 0;
      for (std::int32_t k = 0; k < d.history().step_count(); ++k) {
        for (const StepEvent& event : events_of_step(d.history(), k)) {
          expected += event.below == patch || event.above == patch;
        }
      }
      const auto events = events_of_patch(d.history(), patch);
      QCOMPARE(events.size(), expected);
      for (std::size_t k = 1; k < events.size(); ++k) {
        QVERIFY(events[k - 1].step <= events[k].step);
      }
    }
  }

  void a_line_lists_its_patches_in_order() {
    const Direction d("furnace", {0, 0.2, 1});
    const Vec3 middle = d.scene->scene->bounds().center();
    const auto events =
        events_at_point(d.history(), d.map->record().frame.project(middle + Vec3{0.21, 0.13, 0}));
    QVERIFY(events.size() >= 2);
    QCOMPARE(events.front().above, no_patch);
    for (std::size_t k = 1; k < events.size(); ++k) {
      QCOMPARE(events[k].above, events[k - 1].below);
      QVERIFY(events[k - 1].step < events[k].step);
    }
    QVERIFY(events_at_point(d.history(), {1e3, 1e3}).empty());
  }

  void a_line_lists_the_whole_area_that_its_pairs_exchange() {
    const Direction d("cornell-box", {0.1, 0.2, 1});
    std::map<std::pair<PatchId, PatchId>, double> areas;
    for (const Transfer& t : d.transfers.exchanges) {
      areas[{t.receiver, t.source}] = t.area;
    }
    int exchanges = 0;
    for (int k = 0; k < 46; ++k) {
      const double x = -1 + 0.0437 * k;
      for (const StepEvent& event : events_at_point(d.history(), {x, 0.31 * x})) {
        if (event.kind != StepEvent::Kind::exchange) {
          QCOMPARE(event.pair_area, 0.0);
          continue;
        }
        ++exchanges;
        QVERIFY(std::abs(event.pair_area - areas.at({event.below, event.above})) < 1e-12);
        QVERIFY(event.area <= event.pair_area + 1e-12);
      }
    }
    QVERIFY(exchanges > 3);
    QCOMPARE(exchanged_area(d.history(), 0, 0), 0.0);
  }

  void a_global_map_is_traversed_at_the_probed_point() {
    const Direction d("furnace", {0, 0.2, 1});
    const Scene& scene = *d.scene->scene;
    const std::vector<Rgb> radiosity(static_cast<std::size_t>(scene.patch_count()), {1, 2, 3});
    const SolverSnapshot snapshot = snapshot_of(d, radiosity);
    FocusOn focus(d);
    QVERIFY(!region_state(focus, snapshot));
    QVERIFY(current_lines(focus, MapKind::global) == std::vector<CodeLine>{CodeLine::global_map});
    const Vec3 middle = d.scene->scene->bounds().center();
    const Vec2 point = d.map->record().frame.project(middle + Vec3{0.21, 0.13, 0});
    focus.set_probe(point);
    QVERIFY(current_lines(focus, MapKind::global) == std::vector<CodeLine>{CodeLine::region_list});
    const auto line = events_at_point(d.history(), point);
    const double area = region_at(d.history(), point)->area;
    int exchanges = 0;
    for (std::int32_t k = 0; k < d.history().step_count(); ++k) {
      focus.go_to({0, 0, k});
      const auto state = region_state(focus, snapshot);
      QVERIFY(state.has_value());
      QCOMPARE(state->list.size(), line.size());
      QCOMPARE(state->region.value().area, area);
      const auto lines = current_lines(focus, MapKind::global);
      const auto here = std::find_if(line.begin(), line.end(),
                                     [&](const StepEvent& event) { return event.step == k; });
      if (here == line.end()) {
        QVERIFY(lines.front() == CodeLine::each_receiver || lines.front() == CodeLine::region_list);
        continue;
      }
      QCOMPARE(state->i, here->below);
      QCOMPARE(state->j, here->above);
      const bool gathers = lines.back() == CodeLine::gather_region;
      QCOMPARE(gathers, here->kind == StepEvent::Kind::exchange);
      exchanges += gathers;
      // The line of pseudo-code says: A(R)/A_i · rho_i/(pi M) · 4 pi · B_j.
      QCOMPARE(state->gathered.has_value(), gathers);
      if (!gathers) {
        continue;
      }
      const Rgb expected = (area * 4 / (scene.patch(state->i).area * 20)) *
                           (scene.reflectance(state->i) * at(radiosity, state->j));
      QVERIFY(max_abs(*state->gathered - expected) < 1e-12);
      QVERIFY(max_abs(expected) > 0);
    }
    QVERIFY(exchanges > 0);
  }

  void the_steps_of_a_direction_sum_to_eq_11() {
    // Summed over the steps of a direction, line `gather` is eq. 11 for that direction.
    const Direction d("cornell-box");
    const Scene& scene = *d.scene->scene;
    const std::vector<Rgb> radiosity = uneven_radiosity(scene);
    const SolverSnapshot snapshot = snapshot_of(d, radiosity);
    FocusOn focus(d);
    std::vector<Rgb> sums(radiosity.size());
    QVERIFY(!algorithm_state(focus, snapshot, no_patch));
    QVERIFY(current_lines(focus, MapKind::local) == std::vector<CodeLine>{CodeLine::empty_map});
    for (std::int32_t k = 0; k < d.history().step_count(); ++k) {
      focus.go_to({0, 0, k});
      const auto state = algorithm_state(focus, snapshot, no_patch);
      QVERIFY(state.has_value());
      QCOMPARE(state->directions, 20);
      QCOMPARE(state->map_after, state->map_before - state->inside + state->outside +
                                     (d.history().step(k).row != MapRecord::no_row));
      if (state->gathered) {
        at(sums, state->i) += *state->gathered;
      }
      QCOMPARE(current_lines(focus, MapKind::local).back() == CodeLine::leave_hole,
               state->front_facing);
    }
    std::vector<Rgb> expected(radiosity.size());
    for (const Transfer& t : d.transfers.exchanges) {
      const auto i = static_cast<std::size_t>(t.receiver), j = static_cast<std::size_t>(t.source);
      expected[i] += (4 * t.area / (20 * scene.patch(t.receiver).area)) *
                     (scene.reflectance(t.receiver) * radiosity[j]);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      QVERIFY(max_abs(sums[i] - expected[i]) < 1e-12);
    }
  }

  void the_steps_of_a_direction_have_the_moments_of_its_pass() {
    // ALGORITHM.md 6.12; a room whose patches the tree cuts has exchanges in several steps.
    for (const char* spec : {"cornell-box", "boards"}) {
      const Direction d(spec);
      const Scene& scene = *d.scene->scene;
      const Transfers pass = make_engine(Engine::local, d.scene->scene, d.scene->tree,
                                         {.moments = true})(d.history().record().frame.omega, {});
      std::map<std::pair<PatchId, PatchId>, TransferMoments> sums;
      for (std::int32_t k = -1; k < d.history().step_count(); ++k) {
        for (const auto& [j, moments] : moments_of_step(d.history(), scene, k)) {
          TransferMoments& sum = sums[{d.history().step(k).patch, j}];
          for (std::size_t ab = 0; ab < 9; ++ab) {
            sum.value[ab] += moments.value[ab];
          }
        }
      }
      int compared = 0;
      for (std::size_t t = 0; t < pass.exchanges.size(); ++t) {
        const Transfer& transfer = pass.exchanges[t];
        // The list belongs to omega: i receives.
        const auto found = sums.find({transfer.receiver, transfer.source});
        QVERIFY(found != sums.end());
        for (std::size_t ab = 0; ab < 9; ++ab) {
          QVERIFY2(std::abs(found->second.value[ab] - pass.moments[t].value[ab]) <
                       1e-11 * scene.patch(transfer.receiver).area,
                   qPrintable(QString("%1 %2: %3").arg(spec).arg(t).arg(ab)));
        }
        ++compared;
      }
      QVERIFY(compared > 10 && compared == static_cast<int>(sums.size()));
    }
  }

  void the_steps_of_a_direction_sum_to_the_linear_equation() {
    const Direction d("cornell-box");
    const Scene& scene = *d.scene->scene;
    const std::vector<Rgb> radiosity = uneven_radiosity(scene);
    std::vector<LinearTerm> parts;
    for (PatchId p = 0; p < scene.patch_count(); ++p) {
      parts.push_back({{0.1 * p, -0.2, 0.3}, {1, 0.02 * p, -0.5}});
    }
    SolverSnapshot snapshot = snapshot_of(d, radiosity);
    snapshot.options.basis = Basis::linear;
    snapshot.kept_linear_terms = {std::make_shared<const std::vector<LinearTerm>>(parts)};
    FocusOn focus(d);
    std::vector<Rgb> sums(radiosity.size());
    for (std::int32_t k = 0; k < d.history().step_count(); ++k) {
      focus.go_to({0, 0, k});
      const auto state = algorithm_state(focus, snapshot, no_patch);
      QCOMPARE(state->moments.has_value(), state->j != no_patch);
      if (state->moments) {
        QVERIFY(std::abs(state->moments->of(0, 0) - state->area_j) < 1e-12);
      }
      if (state->gathered) {
        at(sums, state->i) += *state->gathered;
      }
    }
    const Transfers pass = make_engine(Engine::local, d.scene->scene, d.scene->tree,
                                       {.moments = true})(d.history().record().frame.omega, {});
    std::vector<Rgb> expected(radiosity.size());
    for (std::size_t t = 0; t < pass.exchanges.size(); ++t) {
      const Transfer& transfer = pass.exchanges[t];
      const auto j = static_cast<std::size_t>(transfer.source);
      const TransferMoments& moments = pass.moments[t];
      const Rgb gathered = moments.of(0, 0) * radiosity[j] + moments.of(0, 1) * parts[j].first +
                           moments.of(0, 2) * parts[j].second;
      at(expected, transfer.receiver) += (4 / (20 * scene.patch(transfer.receiver).area)) *
                                         (scene.reflectance(transfer.receiver) * gathered);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      QVERIFY(max_abs(sums[i] - expected[i]) < 1e-11);
    }
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
