// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The cost of passes by patch, against the counts of the same passes.
#include "visibility/fast/patch_costs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/canceled.h"
#include "support/imperfect_scenes.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum::patch_costs_test {
namespace {

using testing::Sketch;

struct Measured {
  std::shared_ptr<const Scene> scene;
  std::vector<Vec3> directions;
  PassCounts counts;
  PatchCosts costs;

  explicit Measured(std::shared_ptr<const Scene> of, bool moments = false)
      : scene(std::move(of)), directions(testing::test_directions(12, 5)) {
    directions.erase(directions.begin(), directions.begin() + 8);  // axes and diagonals
    const auto tree = std::make_shared<const BspTree>(*scene);
    const TransferEngine engine = make_engine(Engine::fast, scene, tree, {.moments = moments});
    for (const Vec3& omega : directions) {
      counts += engine(omega, {}).counts;
    }
    costs = patch_costs(Engine::fast, scene, tree, directions, moments);
  }

  /// The sum over the patches of a material.
  PatchCost of(const char* material) const {
    PatchCost sum;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      if (scene->material(i).name == material) {
        sum += at(costs.patches, i);
      }
    }
    return sum;
  }
};

std::shared_ptr<const Scene> truss() {
  return std::make_shared<const Scene>(
      testing::describe(
          {.kind = testing::Imperfect::truss, .count = 150, .aspect = 1e7, .seed = 3}),
      SceneOptions{});
}

std::int64_t repeated_queries(const PatchCost& cost) {
  std::int64_t sum = 0;
  for (const std::int32_t count : cost.repeated) {
    sum += count;
  }
  return sum;
}

void expect_counts_of_passes(const Measured& measured) {
  const PatchCost total = measured.costs.total();
  EXPECT_EQ(measured.costs.passes, 4);
  EXPECT_EQ(total.candidates, measured.counts.pairs);
  EXPECT_EQ(total.exact_queries(), measured.counts.exact_queries);
  EXPECT_GT(total.queries, 0);
  EXPECT_LE(total.exact_queries(), repeated_queries(total));
  EXPECT_LE(repeated_queries(total), total.queries);
  EXPECT_EQ(total.repeated[0], 0);
  EXPECT_EQ(total.exact[0], 0);
  EXPECT_GT(total.seconds, 0);
  EXPECT_LT(total.seconds, measured.costs.seconds);
}

TEST(PatchCosts, SumToTheCountsOfThePasses) {
  expect_counts_of_passes(Measured(load_scene("cornell-box")));
  expect_counts_of_passes(Measured(load_scene("boards"), true));
  expect_counts_of_passes(Measured(truss()));
}

TEST(PatchCosts, TellsThatNeedlesAreRepeatedAndWhy) {
  const Measured measured(truss());
  const PatchCost needles = measured.of("thing"), total = measured.costs.total();
  EXPECT_GT(repeated_queries(needles), 0.9 * static_cast<double>(repeated_queries(total)));
  EXPECT_GT(repeated_queries(needles), 0.2 * static_cast<double>(needles.queries));
  EXPECT_TRUE(needles.main_reason() == QueryFailure::thin ||
              needles.main_reason() == QueryFailure::crowded);
}

TEST(PatchCosts, AreLowWithoutNeedles) {
  const PatchCost total = Measured(load_scene("sphere-flake:levels=2")).costs.total();
  EXPECT_LT(static_cast<double>(total.exact_queries()), 0.005 * static_cast<double>(total.queries));
  EXPECT_LT(static_cast<double>(repeated_queries(total)),
            0.02 * static_cast<double>(total.queries));
}

TEST(PatchCosts, AreOfFacesByDecreasingTime) {
  Sketch sketch = testing::box_in_cube(2, 1);
  const auto scene = sketch.scene({.max_patch_area = 0.05});
  const Measured measured(scene);
  const std::vector<FaceCost> faces = costly_faces(*scene, measured.costs, 1000);
  EXPECT_LT(std::ssize(faces), scene->patch_count());
  PatchCost sum;
  std::int64_t patches = 0;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    EXPECT_TRUE(k == 0 || faces[k - 1].cost.seconds >= faces[k].cost.seconds);
    sum += faces[k].cost;
    patches += faces[k].patches;
  }
  EXPECT_EQ(patches, scene->patch_count());
  EXPECT_EQ(sum.queries, measured.costs.total().queries);
  EXPECT_EQ(sum.candidates, measured.costs.total().candidates);
  const auto first = costly_faces(*scene, measured.costs, 1);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].patch, faces[0].patch);
}

TEST(PatchCosts, NeedEngineFastAndDirections) {
  const auto scene = load_scene("furnace");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const std::vector<Vec3> directions = testing::test_directions(1, 1);
  EXPECT_THROW(patch_costs(Engine::local, scene, tree, directions, false), InputError);
  EXPECT_THROW(patch_costs(Engine::fast, scene, tree, {}, false), InputError);
  EXPECT_THROW(patch_costs(Engine::fast, scene, tree, directions, false, testing::canceled()),
               Canceled);
  EXPECT_TRUE(directions_to_measure({}).empty());
  EXPECT_EQ(directions_to_measure(testing::test_directions(16, 1)).size(), 1U);
  const std::vector<Vec3> many = testing::test_directions(1024, 1);
  const std::vector<Vec3> chosen = directions_to_measure(many);
  ASSERT_EQ(chosen.size(), 4U);
  EXPECT_EQ(chosen[3].x, many[768].x);
}

}  // namespace
}  // namespace transillum::patch_costs_test
