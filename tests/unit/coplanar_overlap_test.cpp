// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/bsp/coplanar_overlap.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "support/scenes.h"
#include "transillum/bsp_tree.h"

namespace transillum::testing::coplanar_overlap_test {
namespace {

std::vector<Vec3> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}

std::vector<CoplanarOverlap> overlaps_in(Sketch& sketch, std::size_t most = 100) {
  const auto scene = sketch.scene();
  return coplanar_overlaps(*scene, most);
}

/// A lamp overlaps the floor; a tile beside the lamp only touches it, and a reversed tile is
/// another side.
TEST(CoplanarOverlaps, AreTheCommonAreasOfFacesWithTheSameNormal) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0, 1);
  std::vector<Vec3> turned = rectangle(0, 0, 4, 4);
  std::reverse(turned.begin(), turned.end());
  sketch.face(rectangle(0, 0, 4, 4), gray)
      .face(rectangle(3, 1, 5, 2), lamp)
      .face(rectangle(4, 0, 5, 1), gray)
      .face(turned, gray);
  const auto overlaps = overlaps_in(sketch);
  ASSERT_EQ(overlaps.size(), 1U);
  EXPECT_EQ(overlaps[0].upper, 1);
  EXPECT_EQ(overlaps[0].lower, 0);
  EXPECT_NEAR(overlaps[0].area, 1, 1e-12);
}

/// Panels through both faces change nothing.
TEST(CoplanarOverlaps, DoNotDependOnWhatCrossesThem) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face(rectangle(0, 0, 3, 3), gray).face(rectangle(1, 1, 4, 4), gray);
  const auto at = [](double y, double z) { return Vec3{1.3 + 0.2 * y, y, z}; };
  for (int panel = 0; panel < 10; ++panel) {
    const double y = 0.5 * panel - 0.5;
    sketch.face({at(y, -1), at(y + 0.5, -1), at(y + 0.5, 1), at(y, 1)}, gray);
  }
  const auto scene = sketch.scene();
  const auto overlaps = coplanar_overlaps(*scene, 100);
  ASSERT_EQ(overlaps.size(), 1U);
  EXPECT_NEAR(overlaps[0].area, 4, 24 * BspTree::thickness(*scene));
}

/// The pieces of concave patches are compared, and their areas add up.
TEST(CoplanarOverlaps, AddUpOverPieces) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}, gray)
      .face({{0, 0, 0}, {4, 0, 0}, {2, 3, 0}}, gray);
  const auto overlaps = overlaps_in(sketch);
  ASSERT_EQ(overlaps.size(), 1U);
  EXPECT_EQ(overlaps[0].upper, 1);
  // Borders of pieces lose strips. The triangle of area 6 without the kite between (2,1), (2,3) and
  // the crossings of the edges y = 1.5 x and y = 4 - 1.5 x at x = 4/3, mirrored at x = 2.
  EXPECT_NEAR(overlaps[0].area, 6 - 4.0 / 3, 64 * BspTree::thickness(*sketch.scene()));
}

/// Many copies of one face: no more pairs are returned than requested.
TEST(CoplanarOverlaps, AreNoMoreThanRequested) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  for (int k = 0; k < 40; ++k) {
    sketch.face(rectangle(0, 0, 1, 1), gray);
  }
  EXPECT_EQ(overlaps_in(sketch, 1000).size(), 40U * 39 / 2);
  EXPECT_EQ(overlaps_in(sketch, 100).size(), 100U);
}

TEST(CoplanarOverlaps, DoNotOccurInBuiltInScenes) {
  for (const char* name : {"cornell-box", "rooms", "boards", "furnace"}) {
    const auto scene = load_scene(name);
    EXPECT_THAT(coplanar_overlaps(*scene, 10), ::testing::IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace transillum::testing::coplanar_overlap_test
