// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.

#include "visibility/embree/picking.h"

#include <gtest/gtest.h>
#include "support/canceled.h"
#include "support/scenes.h"

namespace transillum::picking_test {
namespace {

using testing::Sketch;

/// A square that faces up at z = 0, and a square that faces down at z = 1.
std::shared_ptr<const Scene> two_squares(double size, const Vec3& shift,
                                         const SceneOptions& options = {}) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, gray);
  return std::make_shared<const Scene>(
      testing::moved(sketch.description(), [=](const Vec3& p) { return size * p + shift; }),
      options);
}

TEST(Picker, ReturnsPatchDistanceAndSide) {
  for (const auto& [size, shift] :
       {std::pair{1.0, Vec3{}}, {1e-6, Vec3{}}, {1e6, Vec3{}}, {1.0, Vec3{1e6, 0, -1e5}}}) {
    const Picker picker(two_squares(size, shift));
    const Vec3 middle = size * Vec3{0.25, 0.3, 0.5} + shift;
    const auto down = picker.first_hit(middle, {0, 0, -1});
    ASSERT_TRUE(down);
    EXPECT_EQ(down->patch, 0);
    EXPECT_TRUE(down->lit_side);
    EXPECT_NEAR(down->distance, 0.5 * size, 1e-9 * size);
    EXPECT_NEAR(down->point.z, shift.z, 1e-9 * size);
    // The length of the direction does not matter; an oblique ray hits the same plane.
    const auto slanting = picker.first_hit(middle, {3e200, 4e200, 12e200});
    ASSERT_TRUE(slanting);
    EXPECT_EQ(slanting->patch, 1);
    EXPECT_NEAR(slanting->distance, 0.5 * size * 13 / 12, 1e-9 * size);
    EXPECT_FALSE(picker.first_hit(middle, {1, 0, 0}));
  }
}

TEST(Picker, FirstLitHitIgnoresBackSides) {
  const Picker picker(two_squares(1, {}));
  const Vec3 above{0.5, 0.5, 2};
  const auto first = picker.first_hit(above, {0, 0, -1});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->patch, 1);
  EXPECT_FALSE(first->lit_side);
  const auto lit = picker.first_lit_hit(above, {0, 0, -1});
  ASSERT_TRUE(lit);
  EXPECT_EQ(lit->patch, 0);
  EXPECT_TRUE(lit->lit_side);
  EXPECT_NEAR(lit->distance, 2, 1e-12);
  EXPECT_FALSE(picker.first_lit_hit(above, {0, 0, 1}));
}

TEST(Picker, HitsTwoSidedFacesOnTheSideOfTheRay) {
  const Picker picker(two_squares(1, {}, {.two_sided = true}));
  for (const auto& [z, way, patch] :
       {std::tuple{2.0, -1.0, 3}, {0.5, 1.0, 2}, {0.5, -1.0, 0}, {-1.0, 1.0, 1}}) {
    const auto hit = picker.first_hit({0.4, 0.7, z}, {0, 0, way});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->patch, patch);
    EXPECT_TRUE(hit->lit_side);
  }
}

TEST(Picker, CanBeCanceled) {
  const auto scene = load_scene("sphere-flake:levels=1");
  EXPECT_THROW(Picker(scene, testing::canceled()), Canceled);
}

TEST(Picker, IsAccurateFromFarAway) {
  const auto scene = load_scene("sphere-flake:levels=1");
  const Picker picker(scene);
  for (PatchId i = 0; i < scene->patch_count(); i += 7) {
    const Patch& patch = scene->patch(i);
    const auto near = picker.first_lit_hit(patch.center + 1e-3 * patch.normal, -patch.normal);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->patch, i);
    const Vec3 way = normalized(patch.normal + 0.3 * Vec3{patch.normal.z, patch.normal.x, 0});
    const auto reach = picker.first_lit_hit(patch.center + 1e5 * way, -way);
    ASSERT_TRUE(reach);  // that patch, or one that hides it
    if (reach->patch == i) {
      EXPECT_NEAR(reach->distance, 1e5, 1e-6);
    } else {
      EXPECT_LT(reach->distance, 1e5);
    }
  }
}

}  // namespace
}  // namespace transillum::picking_test
