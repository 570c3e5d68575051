// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// GlossySolver: canceling, pausing, stages, and solving again with other materials.
#include "transillum/glossy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "support/glossy_scenes.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/directions.h"
#include "transillum/errors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::glossy_solver_test {
namespace {

using testing::box_scene;
using testing::glossy_box;
using testing::glossy_options;
using testing::largest_difference;
using testing::phong;

TEST(GlossySolver, CanBeCanceledAndPaused) {
  const auto scene = glossy_box();
  SolveOptions options = glossy_options(32);
  options.threads = 1;
  const Solution whole = solve(scene, options);
  GlossySolver solver(scene, options);
  int calls = 0;
  bool done = false;
  while (!done) {
    done = solver.solve([&](const SolveProgress&) { return ++calls % 3 != 0; });
  }
  const Solution paused = solver.solution();
  EXPECT_EQ(paused.radiosity, whole.radiosity);
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_TRUE(std::ranges::equal(paused.glossy->arriving(i), whole.glossy->arriving(i))) << i;
    const Vec3 toward = normalized(scene->patch(i).normal + Vec3{0.1, 0.2, 0.3});
    EXPECT_EQ(paused.glossy->radiance(i, toward), whole.glossy->radiance(i, toward)) << i;
  }
  // The bits are also the same pass by pass.
  GlossySolver stepped(scene, options);
  EXPECT_TRUE(stepped.advance(RadiositySolver::Until::direction));
  EXPECT_EQ(stepped.progress().direction, 1);
  EXPECT_TRUE(stepped.advance(RadiositySolver::Until::iteration));
  EXPECT_EQ(stepped.progress().iteration, 1);
  EXPECT_FALSE(stepped.advance(RadiositySolver::Until::finished));
  EXPECT_EQ(stepped.solution().radiosity, whole.radiosity);
  Cancellation cancellation;
  GlossySolver canceled(scene, options, {}, cancellation);
  EXPECT_THROW(canceled.solve([&](const SolveProgress& progress) {
    if (progress.iteration == 2) {
      cancellation.cancel();
    }
    return true;
  }),
               Canceled);
  EXPECT_EQ(canceled.progress().iteration, 2);
  EXPECT_FALSE(canceled.solution().complete);
  EXPECT_LE(largest_difference(canceled.solution().radiosity, whole.radiosity), 0.5);
}

std::vector<Rgb> all_light(const GlossyLight& light) {
  std::vector<Rgb> all;
  for (PatchId i = 0; i < light.scene().patch_count(); ++i) {
    const auto arriving = light.arriving(i);
    all.insert(all.end(), arriving.begin(), arriving.end());
    for (int p = 0; p < static_cast<int>(light.directions().size()); ++p) {
      all.push_back(light.leaving(i, p));
    }
  }
  return all;
}

/// A solution that was taken within an iteration stays as it was: views read it on other threads
/// while the solver continues.
TEST(GlossySolver, ChangesNoSolutionThatItGave) {
  const auto scene = glossy_box();
  SolveOptions options = glossy_options(32);
  options.threads = 1;
  GlossySolver solver(scene, options);
  std::vector<Solution> taken;
  std::vector<std::vector<Rgb>> light;
  const auto take = [&] {
    taken.push_back(solver.solution());
    light.push_back(all_light(*taken.back().glossy));
  };
  solver.solve([&](const SolveProgress& progress) {
    if (progress.iteration == 2) {
      take();
    }
    return progress.iteration < 4;
  });
  take();
  solver.set_materials(scene->materials());
  take();
  solver.solve();
  EXPECT_GT(taken.size(), 8U);
  for (std::size_t k = 0; k < taken.size(); ++k) {
    EXPECT_EQ(all_light(*taken[k].glossy), light[k]) << k;
  }
}

TEST(GlossySolver, TellsOfItsStages) {
  using Stage = SolveProgress::Stage;
  GlossySolver solver(glossy_box(), glossy_options(64));
  std::vector<SolveProgress> told;
  solver.solve([&](const SolveProgress& progress) {
    told.push_back(progress);
    return progress.iteration < 2;
  });
  const auto of = [&](Stage stage, int iteration) {
    std::vector<SolveProgress> found;
    std::copy_if(
        told.begin(), told.end(), std::back_inserter(found),
        [=](const SolveProgress& now) { return now.stage == stage && now.iteration == iteration; });
    return found;
  };
  for (const auto& [stage, iteration] :
       {std::pair{Stage::scaling_lobes, 0}, {Stage::reflecting, 0}, {Stage::reflecting, 1}}) {
    const std::vector<SolveProgress> found = of(stage, iteration);
    ASSERT_GE(found.size(), 2U);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_GT(found[k].stage_fraction, k == 0 ? 0 : found[k - 1].stage_fraction);
      EXPECT_GT(found[k].lobes_per_second, 0);
      EXPECT_GE(found[k].seconds_left, 0);
    }
    EXPECT_EQ(found.back().stage_fraction, 1);
    EXPECT_EQ(found.back().seconds_left, 0);
  }
  EXPECT_EQ(told.front().stage, Stage::scaling_lobes);
  EXPECT_TRUE(of(Stage::scaling_lobes, 1).empty());
  EXPECT_EQ(solver.progress().stage, Stage::passes);
}

/// After a cancellation while the lobes of other materials are scaled, the present light can be
/// read, and the solve continues to the right result.
TEST(GlossySolver, CanBeCanceledWhileLobesAreScaled) {
  const auto scene = glossy_box();
  const SolveOptions options = glossy_options(32);
  std::vector<Material> other = scene->materials();
  for (Material& m : other) {
    m.lobe = phong(0.2, 20);
  }
  for (const auto start : {GlossySolver::Start::emission, GlossySolver::Start::current}) {
    Cancellation cancellation;
    GlossySolver solver(scene, options, {}, cancellation);
    solver.solve();
    solver.set_materials(other, {}, start);  // patches get lobes that had none
    EXPECT_THROW(solver.solve([&](const SolveProgress& progress) {
      EXPECT_EQ(progress.stage, SolveProgress::Stage::scaling_lobes);
      cancellation.cancel();
      return true;
    }),
                 Canceled);
    EXPECT_EQ(solver.progress().stage, SolveProgress::Stage::passes);
    const Solution left = solver.solution();
    for (const Rgb& light : left.glossy->radiance_toward({0.3, 0.2, 0.1})) {
      EXPECT_TRUE(std::isfinite(max_abs(light)));
    }
  }
}

/// Starting with the present light, the same limit is reached in fewer iterations; materials can be
/// given by patch.
TEST(GlossySolver, GoesOnFromTheCurrentLight) {
  const auto scene = glossy_box();
  SolveOptions options = glossy_options(32);
  options.tolerance = 1e-10;
  std::vector<Material> other = scene->materials();
  std::vector<std::int32_t> of_patch;
  for (const Patch& patch : scene->patches()) {
    of_patch.push_back(patch.material);
  }
  for (Material& m : other) {
    if (m.lobe.present()) {
      m.lobe.reflectance = 0.98 * m.lobe.reflectance;
    }
  }
  GlossySolver from_emission(scene, options), from_current(scene, options);
  from_emission.solve();
  from_current.solve();
  from_emission.set_materials(other);
  from_emission.solve();
  from_current.set_materials(other, of_patch, GlossySolver::Start::current);
  from_current.solve();
  const Solution a = from_emission.solution(), b = from_current.solution();
  EXPECT_LT(b.statistics.iterations, a.statistics.iterations);
  EXPECT_LE(largest_difference(a.radiosity, b.radiosity), 1e-7);
  EXPECT_EQ(b.statistics.passes_made, 32);
  of_patch.pop_back();
  EXPECT_THROW(from_current.set_materials(other, of_patch), InputError);
  of_patch.push_back(static_cast<std::int32_t>(other.size()));
  EXPECT_THROW(from_current.set_materials(other, of_patch), InputError);
}

/// Another gloss from kept transfers has the bits of a solve with it.
TEST(GlossySolver, SolvesAgainWithOtherMaterials) {
  const auto scene = glossy_box();
  std::vector<Material> other = scene->materials();
  for (Material& m : other) {
    if (m.lobe.present()) {
      m.lobe = phong(0.2, 20);
    }
  }
  GlossySolver solver(scene, glossy_options(32));
  solver.solve();
  solver.set_materials(other);
  solver.solve();
  EXPECT_EQ(solver.solution().statistics.passes_made, 32);
  std::size_t k = 0;
  const auto direct = box_scene([&](std::size_t, Material& m) {
    const std::size_t first = other.size() - 60;
    m = other[first + k++];
  });
  ASSERT_EQ(direct->patch_count(), 60);
  EXPECT_LE(
      largest_difference(solver.solution().radiosity, solve(direct, glossy_options(32)).radiosity),
      1e-12);
  // A patch that becomes glossy needs its transfers by direction.
  for (Material& m : other) {
    m.lobe = phong(0.2, 20);
  }
  solver.set_materials(other);
  solver.solve();
  EXPECT_EQ(solver.solution().statistics.passes_made, 64);
}

}  // namespace
}  // namespace transillum::glossy_solver_test
