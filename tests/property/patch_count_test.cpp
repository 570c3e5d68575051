// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The number of patches that is predicted is the number made, and a limit of patch areas that is
// chosen for a number of patches comes near it.
#include "scene/build/patch_count.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "radiosity/norms.h"
#include "support/random_scenes.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/errors.h"

namespace transillum::patch_count_test {
namespace {

TEST(PatchCount, IsTheNumberOfPatchesMade) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const testing::RandomScene random = testing::random_scene(seed);
    SCOPED_TRACE(std::to_string(seed) + ": " + random.kind);
    const Scene whole(random.description, {.two_sided = seed % 3 == 0});
    for (const double parts : {0.5, 3.0, 40.0, 700.0}) {
      const double limit = total_area(whole) / parts;
      const Scene fine(random.description, {.two_sided = seed % 3 == 0, .max_patch_area = limit});
      ASSERT_EQ(count_patches(whole, limit), fine.patch_count()) << parts;
    }
  }
}

TEST(PatchCount, OfAnyLimitIsFinite) {
  const auto scene = load_scene("cornell-box");
  EXPECT_EQ(count_patches(*scene, HUGE_VAL), scene->patch_count());
  EXPECT_GE(count_patches(*scene, 1e-300), std::int64_t{1} << 50);
  EXPECT_GT(expected_memory(2000), expected_memory(1000));
  EXPECT_GT(expected_memory(1000, 1, 3), expected_memory(1000));
  // The three unknowns of a patch are in each replica.
  const auto of_replica = [](int unknowns) {
    return expected_memory(1000, 2, unknowns) - expected_memory(1000, 1, unknowns);
  };
  EXPECT_EQ(of_replica(3), 3 * of_replica(1));
}

TEST(MaxPatchAreaFor, ComesWithinATwofoldOfTheNumberOfTrianglesAndQuadrilaterals) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    testing::Sketch sketch;
    const int gray = sketch.material(0.5, 0);
    sketch.triangles(1 + static_cast<int>(seed % 7), 0.3, seed, gray);
    if (seed % 2 == 1) {
      sketch.box({0, 0, 0}, {1, 0.5 + 0.1 * static_cast<double>(seed), 3}, true, gray);
    }
    const auto whole = sketch.scene();
    for (const std::int64_t wanted : {40, 150, 1000, 7777}) {
      const double limit = max_patch_area_for(*whole, wanted);
      const auto made = static_cast<double>(sketch.scene({.max_patch_area = limit})->patch_count());
      EXPECT_GE(made, 0.5 * static_cast<double>(wanted)) << seed;
      EXPECT_LE(made, 2.0 * static_cast<double>(wanted)) << seed;
    }
  }
}

/// Equal faces are cut all at once: the worst case.
TEST(MaxPatchAreaFor, ComesWithinATwofoldWhereAllFacesAreEqual) {
  testing::Sketch cube, triangles;
  cube.box({0, 0, 0}, {1, 1, 1}, true, cube.material(0.5, 0));
  const int gray = triangles.material(0.5, 0);
  for (const double z : {0.0, 1.0, 2.0}) {
    triangles.face({{0, 0, z}, {1, 0, z}, {0, 1, z}}, gray);
  }
  for (const testing::Sketch& sketch : {cube, triangles}) {
    const auto whole = sketch.scene();
    for (std::int64_t wanted = whole->patch_count(); wanted < 400; ++wanted) {
      const double limit = max_patch_area_for(*whole, wanted);
      const std::int64_t made = limit > 0 ? count_patches(*whole, limit) : whole->patch_count();
      EXPECT_GE(2 * made, wanted);
      EXPECT_LE(made, 2 * wanted);
    }
  }
}

TEST(MaxPatchAreaFor, ComesNearWhereFacesAreManyAndDiffer) {
  for (const char* name : {"sphere-flake:levels=1", "rooms", "cornell-box", "boards"}) {
    const auto whole = load_scene(name);
    for (const std::int64_t factor : {20, 100}) {
      const std::int64_t wanted = factor * whole->patch_count();
      const double limit = max_patch_area_for(*whole, wanted);
      const auto made = static_cast<double>(count_patches(*whole, limit));
      EXPECT_NEAR(made / static_cast<double>(wanted), 1, 0.1) << name << " " << factor;
    }
  }
}

/// The area is shown in a field of the viewer and written to result files.
TEST(MaxPatchAreaFor, HasFewDigits) {
  const auto scene = load_scene("cornell-box");
  for (const std::int64_t wanted : {100, 600, 3000}) {
    const double limit = max_patch_area_for(*scene, wanted);
    EXPECT_LE(fmt::format("{}", limit).size(), std::string("0.000123").size()) << limit;
    EXPECT_NEAR(static_cast<double>(count_patches(*scene, limit)), static_cast<double>(wanted),
                0.1 * static_cast<double>(wanted));
  }
}

TEST(MaxPatchAreaFor, IsNoLimitWhereFacesAreAsMany) {
  const auto scene = load_scene("rooms");
  EXPECT_EQ(max_patch_area_for(*scene, scene->patch_count()), 0);
  EXPECT_EQ(max_patch_area_for(*scene, 1), 0);
  EXPECT_GT(max_patch_area_for(*scene, 4 * scene->patch_count()), 0);
}

TEST(MaxPatchAreaFor, RefusesImpossibleNumbersAndCanBeCanceled) {
  const auto scene = load_scene("furnace");
  EXPECT_NE(test::refusal([&] { (void)max_patch_area_for(*scene, 0); }), "");
  EXPECT_NE(test::refusal([&] { (void)max_patch_area_for(*scene, std::int64_t{1} << 40); }), "");
  const Cancellation canceled;
  canceled.cancel();
  EXPECT_THROW((void)max_patch_area_for(*scene, 1000, canceled), Canceled);
}

}  // namespace
}  // namespace transillum::patch_count_test
