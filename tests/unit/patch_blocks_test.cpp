// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Patches that engine fast queries together, against the local map, which knows no blocks.
#include "visibility/fast/patch_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/scenes.h"
#include "support/transfer_difference.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "visibility/fast/patch_costs.h"

namespace transillum::patch_blocks_test {
namespace {

using testing::Sketch;

constexpr double agreed = 1e-10;

/// A room with a block and a slanted board, so that walls are cut and hidden in part.
Sketch room() {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.box({0, 0, 0}, {5, 4, 3}, true, gray).box({1, 1, 0}, {2, 2.5, 1.2}, false, gray);
  sketch.face({{3, 0.5, 0.5}, {4.5, 1, 0.7}, {4.5, 3, 2.2}, {3, 2.5, 2}}, gray);
  return sketch;
}

/// A wall whose grid is no parallelogram, below one that is turned against it.
Sketch trapezoids() {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {4, 0, 0}, {2.5, 3, 0}, {1, 2, 0}}, gray);
  sketch.face({{0.2, 0.1, 2}, {0.7, 2.4, 2.2}, {2.9, 2.1, 2.1}, {3.1, 0.3, 1.9}}, gray);
  sketch.face({{1, 0.5, 1}, {2, 0.6, 1}, {1.5, 1.5, 1.2}}, gray);
  return sketch;
}

/// A divided rug on the divided floor of a room.
Sketch rug() {
  Sketch sketch = room();
  const int red = sketch.material(0.2, 0);
  sketch.face({{2.5, 0.5, 0}, {4.1, 0.5, 0}, {4.1, 1.5, 0}, {2.5, 1.5, 0}}, red);
  return sketch;
}

/// A roof of triangles above a floor of two, and a board between.
Sketch triangles() {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, gray);
  sketch.face({{4, 0, 0}, {4, 3, 0}, {0, 3, 0}}, gray);
  sketch.face({{0.1, 0.2, 2}, {1.2, 2.9, 2.4}, {3.8, 0.3, 2.1}}, gray);
  sketch.face({{1, 0.5, 1}, {2, 0.6, 1}, {1.5, 1.5, 1.2}}, gray);
  return sketch;
}

/// Solids that cross, and boards that cut needles off the faces of a box.
Sketch crossing() {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.tetrahedra(6, 0.9, 3, gray).box({-1, -1, -1}, {2, 2, 2}, true, gray);
  for (const double inset : {1e-7, 1e-9, 1e-11}) {
    const double x = 2 - inset;
    sketch.face({{x, -1 - inset, -0.5}, {x, 1, -0.4}, {x, 1, 0.4}, {x, -1 - inset, 0.5}}, gray);
    sketch.face({{-0.5, -0.5, x}, {-1 + inset, 0.5, x}, {0.5, 1 - inset, x + 0.1 * inset}}, gray);
  }
  return sketch;
}

int patches_in_blocks(const PatchBlocks& blocks) {
  int sum = 0;
  for (const PatchBlock& block : blocks.blocks) {
    for (std::int32_t k = 0; k < block.size(); ++k) {
      const PatchId i = blocks.patches[block.patches + static_cast<std::size_t>(k)];
      sum += block.is_single() || i == no_patch ? 0 : 1;
    }
  }
  return sum;
}

void expect_each_patch_once(const Scene& scene, const PatchBlocks& blocks) {
  std::vector<int> times(scene.patches().size(), 0);
  for (std::size_t k = 0; k < blocks.blocks.size(); ++k) {
    const PatchBlock& block = blocks.blocks[k];
    double area = 0;
    for (std::int32_t p = 0; p < block.size(); ++p) {
      const PatchId i = blocks.patches[block.patches + static_cast<std::size_t>(p)];
      if (i != no_patch) {
        ++at(times, i);
        area += scene.patch(i).area;
        EXPECT_GT(dot(scene.patch(i).normal, blocks.scene->patches()[k].normal), 1 - 1e-12);
      }
    }
    EXPECT_NEAR(area, blocks.scene->patches()[k].area, 1e-13 * area);
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), scene.patch_count());
}

TEST(PatchBlocks, HoldEachPatchOfADividedRoomOnce) {
  for (const bool two_sided : {false, true}) {
    const auto scene = room().scene({.two_sided = two_sided, .max_patch_area = 0.05});
    const auto blocks = PatchBlocks::of(*scene);
    ASSERT_TRUE(blocks);
    // The back of the block's base lies in the plane of the floor, and looks as it does.
    EXPECT_GT(patches_in_blocks(*blocks), (two_sided ? 0.9 : 0.995) * scene->patch_count());
    EXPECT_LT(6 * blocks->blocks.size(), scene->patches().size());
    expect_each_patch_once(*scene, *blocks);
  }
}

TEST(PatchBlocks, HoldEachPatchOfDividedTrianglesOnce) {
  for (const double area : {1.0, 0.3, 0.05, 0.01}) {
    for (const bool two_sided : {false, true}) {
      const auto scene = triangles().scene({.two_sided = two_sided, .max_patch_area = area});
      const auto blocks = PatchBlocks::of(*scene);
      if (area < 0.3) {
        ASSERT_TRUE(blocks);
        EXPECT_GT(patches_in_blocks(*blocks), 0.95 * scene->patch_count());
      }
      if (blocks) {
        expect_each_patch_once(*scene, *blocks);
      }
    }
  }
}

TEST(PatchBlocks, AreCanceledWhileAnEngineIsMade) {
  const auto scene = room().scene({.max_patch_area = 0.05});
  const auto tree = std::make_shared<const BspTree>(*scene);
  Cancellation cancellation;
  cancellation.cancel();
  EXPECT_THROW(make_engine(Engine::fast, scene, tree, {}, cancellation), Canceled);
}

TEST(PatchBlocks, AreNotMadeOfWholeFaces) {
  Sketch sketch;
  sketch.triangles(20, 1, 4, sketch.material(0.5, 1));
  EXPECT_FALSE(PatchBlocks::of(*sketch.scene()));
  EXPECT_FALSE(PatchBlocks::of(*room().scene()));
}

/// Patches that follow each other around a hole, edge by edge, end where they began.
TEST(PatchBlocks, AreNotMadeOfAFrame) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  const std::vector<Vec3> outside{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const std::vector<Vec3> inside{{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    sketch.face({outside[k], outside[next], inside[next], inside[k]}, gray);
  }
  EXPECT_FALSE(PatchBlocks::of(*sketch.scene()));
  const auto divided = sketch.scene({.max_patch_area = 0.1});
  const auto blocks = PatchBlocks::of(*divided);
  ASSERT_TRUE(blocks);
  expect_each_patch_once(*divided, *blocks);
  EXPECT_EQ(patches_in_blocks(*blocks), divided->patch_count());
}

/// Where both overlap, patches decide which one is seen.
TEST(PatchBlocks, AreDissolvedWhereFacesOfOnePlaneOverlap) {
  const auto scene = rug().scene({.max_patch_area = 0.05});
  const auto blocks = PatchBlocks::of(*scene);
  ASSERT_TRUE(blocks);
  expect_each_patch_once(*scene, *blocks);
  const auto below_or_in_rug = [&](PatchId i) {
    const Vec3 p = scene->patch(i).center;
    return p.z == 0 && p.x > 2.5 && p.x < 4.1 && p.y > 0.5 && p.y < 1.5;
  };
  for (const PatchBlock& block : blocks->blocks) {
    for (std::int32_t k = 0; k < block.size() && !block.is_single(); ++k) {
      EXPECT_FALSE(below_or_in_rug(blocks->patches[block.patches + static_cast<std::size_t>(k)]));
    }
  }
  EXPECT_LT(patches_in_blocks(*blocks), scene->patch_count());
}

/// Directions in general, along axes and diagonals, and nearly along the walls.
std::vector<Vec3> directions() {
  std::vector<Vec3> all = testing::test_directions(14, 77);
  for (const double tilt : {1e-2, 1e-4, 1e-6, 1e-8}) {
    all.push_back(normalized(Vec3{0.7, 0.6, tilt}));
    all.push_back(normalized(Vec3{tilt, -0.3, -0.8}));
  }
  return all;
}

struct Case {
  const char* name;
  Sketch (*sketch)();
  SceneOptions options;
};

std::vector<Case> cases() {
  return {{"room", room, {.max_patch_area = 0.04}},
          {"two-sided room", room, {.two_sided = true, .max_patch_area = 0.1}},
          {"trapezoids", trapezoids, {.max_patch_area = 0.02}},
          {"rug", rug, {.max_patch_area = 0.05}},
          {"crossing", crossing, {.max_patch_area = 0.05}},
          {"triangles", triangles, {.max_patch_area = 0.03}},
          {"two-sided triangles", triangles, {.two_sided = true, .max_patch_area = 0.1}}};
}

TEST(PatchBlocks, AgreeWithTheLocalMap) {
  for (const Case& of : cases()) {
    for (const std::uint64_t turn : {0u, 1u, 2u}) {
      SceneDescription description = of.sketch().description();
      if (turn > 0) {
        const auto rotate = testing::random_rotation(turn);
        const Vec3 offset = turn == 1 ? Vec3{10.0, 20.0, -5.0} : Vec3{1e4, 1e5, -1e4};
        description =
            testing::moved(description, [&](const Vec3& p) { return rotate(p) + offset; });
      }
      const auto scene = std::make_shared<const Scene>(description, of.options);
      EXPECT_TRUE(PatchBlocks::of(*scene) || turn == 2) << of.name;
      const auto tree = std::make_shared<const BspTree>(*scene);
      const TransferEngine fast = make_engine(Engine::fast, scene, tree);
      const TransferEngine local = make_engine(Engine::local, scene, tree);
      for (const Vec3& omega : directions()) {
        const auto found = testing::difference(*scene, local(omega, {}), fast(omega, {}));
        EXPECT_LE(found.fraction, agreed)
            << of.name << ", turn " << turn << ", direction " << omega.x << ", " << omega.y << ", "
            << omega.z << ", " << found.where;
      }
    }
  }
}

TEST(PatchBlocks, HaveTheMomentsOfTheLocalMap) {
  for (const Case& of : cases()) {
    const auto scene = of.sketch().scene(of.options);
    const auto tree = std::make_shared<const BspTree>(*scene);
    const TransferEngine fast = make_engine(Engine::fast, scene, tree, {.moments = true});
    const TransferEngine local = make_engine(Engine::local, scene, tree, {.moments = true});
    for (const Vec3& omega : directions()) {
      const auto by_fast = testing::moments_of(fast(omega, {}));
      const auto by_local = testing::moments_of(local(omega, {}));
      EXPECT_LE(testing::largest_difference(*scene, by_fast, by_local), agreed) << of.name;
    }
  }
}

/// In an empty room, what each patch sees is all of its projection, and so for its moments.
TEST(PatchBlocks, CloseARoom) {
  Sketch empty;
  empty.box({0, 0, 0}, {5, 4, 3}, true, empty.material(0.5, 1));
  const auto box = std::make_shared<const Scene>(
      testing::moved(empty.description(), testing::random_rotation(5)),
      SceneOptions{.max_patch_area = 0.01});
  const TransferEngine of_box =
      make_engine(Engine::fast, box, std::make_shared<const BspTree>(*box), {.moments = true});
  for (const Vec3& along : directions()) {
    const Vec3 omega = testing::random_rotation(5)(along);
    const Transfers transfers = of_box(omega, {});
    for (PatchId i = 0; i < box->patch_count(); ++i) {
      const Coverage& side = at(transfers.forward, i);
      EXPECT_NEAR(side.projected,
                  box->patch(i).area * std::max(0.0, dot(box->patch(i).normal, omega)),
                  1e-13 * box->patch(i).area);
      if (side.projected > 1e-12 * box->patch(i).area) {  // else edge-on
        EXPECT_NEAR(side.covered, side.projected, 1e-11 * side.projected);
      }
      for (std::size_t a = 0; a < 2; ++a) {
        EXPECT_NEAR(at(transfers.forward_moments, i).covered[a], 0, 1e-11 * box->patch(i).area);
      }
    }
  }
}

/// A pass finds the same after other passes as at first.
TEST(PatchBlocks, KeepNothingFromPassToPass) {
  const auto scene = crossing().scene({.max_patch_area = 0.05});
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine used = make_engine(Engine::fast, scene, tree, {.moments = true});
  for (const Vec3& omega : directions()) {
    const Transfers a = used(omega, {});
    const Transfers b = make_engine(Engine::fast, scene, tree, {.moments = true})(omega, {});
    ASSERT_EQ(a.exchanges.size(), b.exchanges.size());
    for (std::size_t k = 0; k < a.exchanges.size(); ++k) {
      ASSERT_EQ(a.exchanges[k].area, b.exchanges[k].area);
      ASSERT_EQ(a.moments[k].value, b.moments[k].value);
    }
  }
}

TEST(PatchBlocks, ShareTheCostOfTheirQueries) {
  const auto scene = room().scene({.max_patch_area = 0.05});
  const auto tree = std::make_shared<const BspTree>(*scene);
  const std::vector<Vec3> along{normalized(Vec3{0.3, 0.5, 0.7}), normalized(Vec3{-0.9, 0.2, 0.1})};
  const PatchCosts costs = patch_costs(Engine::fast, scene, tree, along, false);
  const TransferEngine fast = make_engine(Engine::fast, scene, tree);
  PassCounts counts;
  for (const Vec3& omega : along) {
    counts += fast(omega, {}).counts;
  }
  EXPECT_EQ(costs.total().candidates, counts.pairs);
  // Fewer queries than patches, and each patch of a wall has its share of the time.
  EXPECT_LT(4 * costs.total().queries, scene->patch_count());
  const auto timed = std::count_if(costs.patches.begin(), costs.patches.end(),
                                   [](const PatchCost& cost) { return cost.seconds > 0; });
  EXPECT_GT(2 * timed, scene->patch_count());
}

}  // namespace
}  // namespace transillum::patch_blocks_test
