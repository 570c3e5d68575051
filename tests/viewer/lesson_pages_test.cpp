// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares statements in the texts of the built-in lessons with the scenes and runs that their
// pages show, as far as this needs no window.
#include <QLocale>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "colors/color_scale.h"
#include "lessons/lesson.h"
#include "model/recorded_map.h"
#include "transillum/at.h"
#include "transillum/bounds.h"
#include "transillum/discrepancy.h"
#include "transillum/engine.h"
#include "transillum/radiosity.h"

using namespace transillum;
using namespace transillum::viewer;

namespace {

/// A page and the run that it shows. Lessons and pages count from 1.
struct Shown {
  const Lesson::Page& page;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  std::vector<DirectionSample> samples;

  Shown(int lesson, int number)
      : page(at(at(built_in_lessons(), lesson - 1).pages, number - 1)),
        scene(load_scene(page.state.scene, page.state.options.scene)),
        tree(std::make_shared<const BspTree>(*scene)) {
    const SolveOptions& solve = page.state.options.solve;
    samples = make_directions(solve.sampling, solve.directions, solve.seed);
  }

  bool contains(const QString& text) const {
    return QString::fromStdString(page.text).contains(text);
  }
  Vec3 omega() const {
    const RadiositySolver solver(scene, page.state.options.solve, tree);
    return solver.direction(0, page.state.focus->direction);
  }
  MapHistory history() const { return MapHistory(record_local_map(*scene, *tree, omega()).record); }
  Solution solution() const { return solve(scene, page.state.options.solve); }
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

}  // namespace

class LessonPagesTest : public QObject {
  Q_OBJECT

 private slots:
  void what_a_patch_receives() {
    const Shown number(1, 1);
    QVERIFY(number.contains(QString("%1 unknown").arg(number.scene->patch_count())));
    // The selected patch is horizontal, at the height of the low block's top.
    const Shown top(1, 2);
    const Patch& patch = top.scene->patch(top.page.state.selection);
    QVERIFY(patch.normal.y > 0.999 && patch.center.y > 0.1 && patch.center.y < 0.2);
    const Shown few(1, 3);
    QVERIFY(few.contains("first nine") && few.contains("black"));
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
    const int rounds = all.solution().statistics.iterations;
    QVERIFY2(all.contains(QString("After %1 rounds").arg(rounds)),
             qPrintable(QString::number(rounds)));
  }

  void the_transillumination_plane() {
    const Shown plane(2, 1);
    QCOMPARE(std::get<std::int32_t>(plane.page.state.focus->step), -1);
    // Page 4 speaks of back-facing and front-facing polygons: the map has both.
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
    QVERIFY(Shown(3, 3).contains("eleven digits") && step.open_share() < 1e-11);
  }

  void building_a_visibility_map() {
    const Shown sorted(4, 1);
    const MapHistory history = sorted.history();
    QVERIFY(sorted.contains(QString("%1 patches").arg(sorted.scene->patch_count())));
    QVERIFY(sorted.contains(QString("(%1, for one").arg(history.step_count())));
    QCOMPARE(history.step(0).cut, 0);
    const std::int32_t k =
        first_step(history, [](const MapHistory::Step& step) { return step.exchanges > 0; });
    QVERIFY(history.step(k).front_facing);
    QVERIFY(!history.inside_at(k).empty() && !history.outside_at(k).empty());
    for (std::int32_t s = 0; s < history.step_count(); ++s) {  // page 6: fully covered
      if (history.step(s).front_facing) {
        QVERIFY(history.step(s).open_share() < 1e-11);
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
    QVERIFY(ring.contains("no order of these patches") && gave_up);
    QVERIFY(!ring.page.state.labels);  // patches have other numbers than the boards
    const Shown cut(5, 3);
    QVERIFY(cut.contains(QString("%1 patches of this scene became %2 polygons: six cuts")
                             .arg(cut.scene->patch_count())
                             .arg(cut.tree->fragments().size())));
    QCOMPARE(cut.tree->fragments().size(), std::size_t{46});
    QVERIFY(cut.page.state.overlays == std::vector<Overlay>{Overlay::cuts});
  }

  void monte_carlo_and_quasi_monte_carlo() {
    const Shown dice(6, 1), design(6, 2), spiral(6, 3);
    const auto discrepancy = [](const Shown& shown) { return star_discrepancy(shown.samples); };
    QVERIFY(discrepancy(dice) > 2 * discrepancy(design));
    QVERIFY(discrepancy(design) <= star_discrepancy_bound(64));
    QVERIFY(cap_discrepancy(spiral.samples).value < cap_discrepancy(design.samples).value);
    QVERIFY(design.contains("6 = 110 gives 0.011"));
    QCOMPARE(design.samples[6].v, 0.375);
    const auto flake = load_scene("sphere-flake");
    QVERIFY(Shown(6, 5).contains(QLocale(QLocale::English).toString(flake->patch_count()) +
                                 " patches"));
    double rho = 0;
    for (const Material& material : flake->materials()) {
      rho = std::max(rho, max_abs(material.reflectance));
    }
    // The paper's table contains 5,700 for rho = 0.6.
    QVERIFY(rho > 0.59 && rho < 0.61);
    QVERIFY(Shown(6, 5).contains(
        "asks for " +
        QLocale(QLocale::English).toString(static_cast<int>(paper_tables().if_homogeneous[4])) +
        " directions"));
  }

  void stars_and_the_first_shot() {
    // Size of the lamps relative to the scene.
    const Shown theory(7, 3);
    const double ratio = measure(*theory.scene).size_ratio;
    QVERIFY2(theory.contains("about 119,000") && std::round(ratio / 1000) == 119,
             qPrintable(QString::number(ratio)));
    const double needed = directions_if_heterogeneous(0.6, 0.01, 150);
    QVERIFY(theory.contains("18 million") && std::round(needed / 1e6) == 18);
    // B of the selected patch relative to its neighbors in the wall.
    const Shown few(7, 2);
    const PatchId selected = few.page.state.selection;
    const auto beside_neighbors = [&](const Shown& shown) {
      const Solution solution = shown.solution();
      const Patch& patch = shown.scene->patch(selected);
      double sum = 0;
      int count = 0;
      for (PatchId i = 0; i < shown.scene->patch_count(); ++i) {
        const Patch& other = shown.scene->patch(i);
        if (i == selected || other.material != patch.material) {
          continue;
        }
        if (dot(other.normal, patch.normal) < 0.99 || norm(other.center - patch.center) > 1) {
          continue;
        }
        sum += luminance(at(solution.radiosity, i));
        ++count;
      }
      return luminance(at(solution.radiosity, selected)) * count / sum;
    };
    QVERIFY(few.contains("darker than its neighbors"));
    const double before = beside_neighbors(few), after = beside_neighbors(Shown(7, 4));
    QVERIFY2(before < 0.85 && after > 0.93, qPrintable(QString("%1, %2").arg(before).arg(after)));
  }
};

QTEST_GUILESS_MAIN(LessonPagesTest)
#include "lesson_pages_test.moc"
