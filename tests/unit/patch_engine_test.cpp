// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Engines restricted to one patch, against whole passes.
#include "visibility/fast/patch_engine.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "visibility/queries/patch_shaft.h"

namespace transillum::patch_engine_test {
namespace {

std::vector<Transfer> of_patch(const Transfers& transfers, PatchId patch) {
  std::vector<Transfer> own;
  for (const Transfer& t : transfers.exchanges) {
    if (t.receiver == patch || t.source == patch) {
      own.push_back(t);
    }
  }
  return own;
}

/// The same pairs, except slivers, with the same areas up to rounding.
void expect_same(const std::vector<Transfer>& found, const std::vector<Transfer>& expected,
                 double rounding) {
  const auto area_in = [](const std::vector<Transfer>& list, const Transfer& wanted) {
    for (const Transfer& t : list) {
      if (t.receiver == wanted.receiver && t.source == wanted.source) {
        return t.area;
      }
    }
    return 0.0;
  };
  for (const auto* list : {&found, &expected}) {
    for (const Transfer& t : *list) {
      EXPECT_NEAR(area_in(found, t), area_in(expected, t), rounding)
          << t.receiver << " from " << t.source;
    }
  }
}

class PatchEngine : public ::testing::TestWithParam<const char*> {};

TEST_P(PatchEngine, FindsTheSameAsAWholePass) {
  const auto scene = load_scene(GetParam(), {.max_patch_area = 0.2});
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine whole = make_engine(Engine::fast, scene, tree);
  const double rounding = 1e-10 * scene->bounds().diagonal() * scene->bounds().diagonal();
  std::size_t exchanges = 0;
  for (PatchId patch = 0; patch < scene->patch_count(); patch += 1 + scene->patch_count() / 6) {
    const TransferEngine one = make_patch_engine(Engine::fast, scene, tree, patch);
    for (const Vec3& omega : testing::test_directions(6, 77)) {
      const auto expected = of_patch(whole(omega, {}), patch);
      expect_same(one(omega, {}).exchanges, expected, rounding);
      exchanges += expected.size();
    }
  }
  EXPECT_GT(exchanges, 20U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PatchEngine,
                         ::testing::Values("cornell-box", "boards", "furnace", "stars"));

TEST(PatchShaft, ExcludesMostOfALargeScene) {
  const auto scene = load_scene("sphere-flake");
  const BspTree tree(*scene);
  const PatchShaft shaft(*scene, tree, 9000);
  const auto fragments = static_cast<FragmentId>(tree.fragments().size());
  for (const Vec3& omega : testing::test_directions(4, 5)) {
    FragmentId held = 0;
    for (FragmentId f = 0; f < fragments; ++f) {
      held += shaft.may_hold(f, omega);
    }
    EXPECT_GT(held, 0);
    EXPECT_LT(held, fragments / 20);
  }
}

TEST(PatchEngine, OtherEnginesAreRestrictedToThePatch) {
  const auto scene = load_scene("cornell-box");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const Vec3 omega = testing::test_directions(1, 3).front();
  const auto expected = of_patch(make_engine(Engine::local, scene, tree)(omega, {}), 5);
  expect_same(make_patch_engine(Engine::local, scene, tree, 5)(omega, {}).exchanges, expected, 0);
}

}  // namespace
}  // namespace transillum::patch_engine_test
