// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares what the texts of the built-in lessons say of their scenes and runs with those that
// their pages show, as far as this needs no window.
#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "colors/color_scale.h"
#include "lesson_page.h"
#include "lessons/lesson.h"
#include "model/requests/recorded_map.h"
#include "radiosity/analysis/function_comparison.h"
#include "registered.h"
#include "sampling/discrepancy.h"
#include "transillum/bounds.h"
#include "transillum/engine.h"
#include "transillum/glossy.h"
#include "transillum/radiosity_solver.h"
#include "transillum/refinement.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "visibility/embree/picking.h"
#include "widgets/theme.h"

namespace transillum::viewer::lesson_pages_test {

namespace {

struct Shown : test::ShownPage {
  using ShownPage::ShownPage;

  MapHistory history() const { return MapHistory(record_local_map(*scene, *tree, omega()).record); }
};

// The first step for which `holds` is true, or MapHistory::none.
template <typename Holds>
std::int32_t first_step(const MapHistory& history, const Holds& holds) {
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    if (holds(history.step(k))) {
      return k;
    }
  }
  return MapHistory::none;
}

// B of a patch relative to the mean of its neighbors within 1 m in the same plane and of the same
// material.
double relative_to_neighbors(const Scene& scene, const std::vector<Rgb>& radiosity,
                             PatchId selected) {
  const Patch& patch = scene.patch(selected);
  double sum = 0;
  int count = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& other = scene.patch(i);
    const Vec3 offset = other.center - patch.center;
    if (i == selected || other.material != patch.material ||
        dot(other.normal, patch.normal) < 0.99 || std::abs(dot(offset, patch.normal)) > 1e-6 ||
        norm(offset) > 1) {
      continue;
    }
    sum += luminance(at(radiosity, i));
    ++count;
  }
  return luminance(at(radiosity, selected)) * count / sum;
}

}  // namespace

class LessonPagesTest : public QObject {
  Q_OBJECT

 private slots:
  void what_a_patch_receives() {
    // The selected patch is horizontal, at the height of the low block's top.
    const Shown top(1, 2);
    const Patch& patch = top.scene->patch(top.page.state.selection);
    QVERIFY(patch.normal.y > 0.999 && patch.center.y > 0.1 && patch.center.y < 0.2);
    const Shown few(1, 3);
    QVERIFY(few.contains("first nine") && few.contains("two arrowheads"));
    QVERIFY(few.page.state.options.solve.two_way);
    QVERIFY(few.page.state.solve.kind == Goal::Kind::passes);
    QCOMPARE(few.page.state.solve.passes, 9);
    RadiositySolver solver(few.scene, few.page.state.options.solve);
    for (int d = 0; d < 9; ++d) {
      solver.advance(RadiositySolver::Until::direction);
    }
    const std::vector<Rgb> running = solver.running_estimate();
    const auto black = std::count_if(running.begin(), running.end(),
                                     [](const Rgb& b) { return luminance(b) == 0; });
    QVERIFY2(black > 3 && black < 20, qPrintable(QString::number(black)));
    const Shown all(1, 5);
    QVERIFY(all.contains("a millionth of the reflected light"));
    QCOMPARE(all.page.state.options.solve.tolerance, 1e-6);
    const SolveStatistics run = all.solution().statistics;
    QVERIFY(run.converged && run.predicted_contraction > run.rho_max);
    for (const IterationRecord& iteration : run.iteration_records) {
      QVERIFY(iteration.contraction < run.rho_max);
    }
  }

  void the_transillumination_plane() {
    const Shown plane(2, 1);
    QCOMPARE(std::get<std::int32_t>(plane.page.state.focus->step), -1);
    // Page 4 speaks of back-facing and front-facing patches: the map has both.
    const Shown sides(2, 4);
    QVERIFY(sides.page.state.labels && sides.page.state.selection == 16);
    const MapHistory history = sides.history();
    int backs = 0, fronts = 0;
    for (const std::int32_t r : history.record().map_after(history.record().fullest_step())) {
      ++(history.row(r).front_facing ? backs : fronts);
    }
    QVERIFY2(backs > 1 && fronts > 5, qPrintable(QString("%1, %2").arg(backs).arg(fronts)));
  }

  void what_i_sees_of_j() {
    const Shown shown(3, 1);
    QVERIFY(shown.page.state.focus->iteration > 0);  // in the first, only the lamp has a B > 0
    const MapHistory history = shown.history();
    const std::int32_t k = first_step(history, [&](const MapHistory::Step& step) {
      return step.patch == shown.page.state.selection;
    });
    QVERIFY(k != MapHistory::none);
    const MapHistory::Step& step = history.step(k);
    QVERIFY(step.front_facing && step.exchanges > 1);
    QVERIFY(!history.outside_at(k).empty());
    const Shown closed(3, 3);
    const SolveStatistics run = closed.solution().statistics;
    QVERIFY(closed.contains("at least eleven digits for every patch and every direction"));
    QVERIFY(step.open_fraction() < 1e-11 && run.closure_defect_max < 1e-11);
    QVERIFY(run.kept_form_factors);  // page 4: further iterations are sums
  }

  void building_a_visibility_map() {
    const Shown sorted(4, 1);
    const MapHistory history = sorted.history();
    QVERIFY(sorted.contains("no patch had to be cut in two"));
    QCOMPARE(history.step_count(), sorted.scene->patch_count());
    QVERIFY(sorted.page.state.options.solve.normalize == Normalization::none);  // like on page 4
    QCOMPARE(history.step(0).cut, 0);
    QVERIFY(!history.step(0).front_facing);  // page 2: this fragment emits
    const std::int32_t k =
        first_step(history, [](const MapHistory::Step& step) { return step.exchanges > 0; });
    QVERIFY(k > 1 && history.step(k).front_facing);
    QVERIFY(!history.inside_at(k).empty() && !history.outside_at(k).empty());
    for (std::int32_t s = 0; s < history.step_count(); ++s) {  // page 6: fully covered
      if (history.step(s).front_facing) {
        QVERIFY(history.step(s).open_fraction() < 1e-11);
      }
    }
  }

  void cyclic_overlap() {
    const Shown ring(5, 2);
    const EngineOptions newell{.resolution = 64, .order = PaintersOrder::newell};
    bool gave_up = false;
    try {
      make_engine(Engine::painter, ring.scene, ring.tree, newell)(ring.omega(), {});
    } catch (const std::exception&) {
      gave_up = true;
    }
    QVERIFY(ring.contains("No order of these patches is correct") && gave_up);
    QVERIFY(ring.contains("from below") && ring.omega().z > 0);
    QVERIFY(!ring.page.state.labels);  // patches have other numbers than the boards
    const Shown cut(5, 3);
    const int cuts = static_cast<int>(cut.tree->fragments().size()) - cut.scene->patch_count();
    QVERIFY(cut.contains("by six cuts") && cuts == 6);
    QVERIFY(cut.page.state.overlays == std::vector<Overlay>{Overlay::cuts});
    const Shown other(5, 4);
    QVERIFY(other.contains("the same tree gives a different order"));
    QVERIFY(other.history().record().order != ring.history().record().order);
  }

  void monte_carlo_and_quasi_monte_carlo() {
    const Shown random(6, 1), design(6, 2), spiral(6, 3), both_ways(6, 5);
    const auto discrepancy = [](const Shown& shown) { return star_discrepancy(shown.samples); };
    QVERIFY(discrepancy(random) > 2 * discrepancy(design));
    QVERIFY(discrepancy(design) <= star_discrepancy_bound(64));
    QVERIFY(cap_discrepancy(spiral.samples).value < cap_discrepancy(design.samples).value);
    const auto both_discrepancy = [](const Shown& shown) {
      return cap_discrepancy(with_opposites(shown.samples)).value;
    };
    QVERIFY(both_discrepancy(both_ways) < both_discrepancy(spiral));
    QVERIFY(both_ways.page.state.options.solve.used_sampling() == SolveOptions().used_sampling());
    QVERIFY(both_ways.page.state.options.solve.two_way && SolveOptions().two_way);
    QVERIFY(!random.page.state.options.solve.two_way && !design.page.state.options.solve.two_way);
    // The reflectance for which Table 2 of the paper is quoted.
    const double rho = measure(*load_scene("sphere-flake")).rho_max;
    QVERIFY(rho > 0.59 && rho < 0.61);
  }

  // The numbers that a student finds on paper.
  void flatland_by_hand() {
    const Shown room(8, 4), slanted(8, 6);
    const Vec3 up = room.omega();
    QVERIFY(up.x == 0 && up.y == 0 && up.z == 1);
    const MapHistory history = room.history();
    const std::int32_t floor =
        first_step(history, [](const MapHistory::Step& step) { return step.patch == 0; });
    std::map<PatchId, double> seen;
    for (const std::int32_t r : history.inside_at(floor)) {
      seen[history.row(r).patch] += history.record().area(history.row(r));
    }
    const std::map<PatchId, double> paper{{3, 1}, {4, 1}, {5, 1}, {7, 1}, {11, 2}};
    QCOMPARE(seen.size(), paper.size());
    for (const auto& [patch, length] : paper) {
      QVERIFY(std::abs(seen[patch] - length) < 1e-12);
    }
    // Page 6: before, the floor saw half of the lamp.
    QCOMPARE(paper.at(4) / room.scene->patch(4).area, 0.5);
    QVERIFY(slanted.contains("leans to the right") && slanted.omega().x > 0.1 &&
            std::abs(slanted.omega().y) < 1e-12);
    QVERIFY(room.solution().statistics.escaped < 1e-9);  // closed
  }

  void trust_in_error_bars() {
    const Shown bars(9, 1), few(9, 3), why(9, 4);
    QCOMPARE(bars.page.state.options.solve.replicas, 8);
    QCOMPARE(few.samples.size() / std::size_t(few.page.state.options.solve.replicas),
             std::size_t{8});
    QVERIFY(why.contains("fewer than three"));
    QCOMPARE(least_light_directions, 3.0);
    QVERIFY(few.solution().statistics.light_directions < 3 * 8);
  }

  void from_steps_to_slopes() {
    const Shown steps(10, 1), linear(10, 2), jumps(10, 3), shadows(10, 6);
    QVERIFY(linear.contains("are the same as on the page before"));
    QCOMPARE(linear.scene->patch_count(), steps.scene->patch_count());
    QVERIFY(linear.page.state.options.solve.basis == Basis::linear);
    SolveOptions constant = linear.page.state.options.solve;
    constant.basis = Basis::constant;
    QVERIFY(constant == steps.page.state.options.solve);
    QVERIFY(linear.page.state.quantity == Quantity::radiosity &&
            jumps.page.state.quantity == Quantity::jump);
    // "Where they do meet, a linear function describes the light well": jumps become smaller.
    const Solution flat = steps.solution(), tilted = jumps.solution();
    const auto mean_jump = [](const Solution& solution) {
      const std::vector<double> values = radiosity_jumps(solution);
      return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    };
    QVERIFY2(mean_jump(tilted) < 0.7 * mean_jump(flat),
             qPrintable(QString("%1, %2").arg(mean_jump(tilted)).arg(mean_jump(flat))));
    // "Click the patch": the right one is visible, and has neighbors in its plane.
    const Picker picker(steps.scene);
    const Vec3 eye = steps.page.state.camera->eye;
    QVERIFY(jumps.page.state.camera->eye == eye);
    for (const Solution* solution : {&flat, &tilted}) {
      const std::vector<double> values = radiosity_jumps(*solution);
      const auto worst =
          static_cast<PatchId>(std::max_element(values.begin(), values.end()) - values.begin());
      const auto hit = picker.first_lit_hit(eye, steps.scene->patch(worst).center - eye);
      QVERIFY2(hit && hit->patch == worst, qPrintable(QString::number(worst)));
    }
    // "In the dark it goes below zero".
    QVERIFY(shadows.solution().statistics.negative_corners > 0);
    // Page 5: fewer patches with linear functions are better than more constant ones.
    const Shown fine(10, 4), coarse(10, 5);
    QVERIFY(fine.page.state.options.solve.basis == Basis::constant);
    SolveOptions options = coarse.page.state.options.solve;
    const auto solved = [&options](double area, Basis basis) {
      options.basis = basis;
      return solve(load_scene("rooms:n=0,rooms=1", {.max_patch_area = area}), options);
    };
    QCOMPARE(coarse.page.state.scene, std::string("rooms:n=0,rooms=1"));
    const Solution reference = solved(0.16, Basis::linear);
    const double few = compare_functions(reference, solved(1, Basis::linear)).l2;
    const double many = compare_functions(reference, solved(0.25, Basis::constant)).l2;
    QVERIFY2(few < 0.5 * many, qPrintable(QString("%1, %2").arg(few).arg(many)));
  }

  void when_surfaces_shine() {
    const Shown lobes(11, 2), narrow(11, 5);
    std::map<std::string, bool> shines;
    for (PatchId i = 0; i < lobes.scene->patch_count(); ++i) {
      shines[lobes.scene->material(i).name] = lobes.scene->material(i).lobe.present();
    }
    QVERIFY(lobes.contains("parts of the ball, and a wall, which has no lobe"));
    QVERIFY(shines.at("floor") && shines.at("brass") && !shines.at("white"));
    QVERIFY(narrow.contains("Ten are enough"));
    QCOMPARE(resolved_exponent(500), 50.0);
  }

  void stars_and_the_first_shot() {
    const Shown all(7, 1), few(7, 2), shot(7, 4);
    const std::vector<Rgb> before = all.solution().radiosity, after = shot.solution().radiosity;
    const PatchId selected = few.page.state.selection;
    QVERIFY(few.contains("darker than its neighbors"));
    const double dark = relative_to_neighbors(*few.scene, before, selected);
    const double even = relative_to_neighbors(*few.scene, after, selected);
    QVERIFY2(dark < 0.85 && even > 0.93, qPrintable(QString("%1, %2").arg(dark).arg(even)));
    // Differences between neighbors in the walls.
    QVERIFY(all.contains("jumps from patch to patch") && shot.contains("changes smoothly"));
    const auto roughness = [&](const std::vector<Rgb>& radiosity) {
      double sum = 0;
      int count = 0;
      for (PatchId i = 0; i < few.scene->patch_count(); ++i) {
        if (few.scene->patch(i).material == few.scene->patch(selected).material) {
          sum += std::abs(relative_to_neighbors(*few.scene, radiosity, i) - 1);
          ++count;
        }
      }
      return sum / count;
    };
    const double rough = roughness(before), smooth = roughness(after);
    QVERIFY2(rough > 1.5 * smooth, qPrintable(QString("%1, %2").arg(rough).arg(smooth)));
  }
};

const test::Registered registered("lesson_pages", test::run_without_widgets<LessonPagesTest>);

}  // namespace transillum::viewer::lesson_pages_test

#include "lesson_pages_test.moc"
