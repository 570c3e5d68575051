// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Events of steps and the state of the algorithm at each, without a window.
#include "state/step_events.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>

#include "recorded_direction.h"
#include "registered.h"
#include "state/algorithm_state.h"
#include "transillum/at.h"
#include "visibility/map/map_region.h"

namespace transillum::viewer::step_events_test {

using test::Direction;
using test::FocusOn;

namespace {

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

}  // namespace

class StepEventsTest : public QObject {
  Q_OBJECT

 private slots:
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
};

const test::Registered registered("step_events", test::run_without_widgets<StepEventsTest>);

}  // namespace transillum::viewer::step_events_test

#include "step_events_test.moc"
