// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/merged_pieces.h"

#include <gtest/gtest.h>

#include "radiosity/norms.h"
#include "support/scenes.h"

namespace transillum::merged_pieces_test {
namespace {

using testing::Sketch;

double area(const std::vector<MergedPiece>& polygons) {
  double sum = 0;
  for (const MergedPiece& polygon : polygons) {
    sum += norm(area_vector(polygon.outline));
  }
  return sum;
}

TEST(MergedPieces, OfARefinedBoxAreItsSides) {
  Sketch sketch;
  sketch.box({0, 0, 0}, {1, 2, 3}, true, sketch.material(0.5, 0));
  for (const bool two_sided : {false, true}) {
    const auto sides =
        merged_pieces(*sketch.scene({.two_sided = two_sided, .max_patch_area = 0.01}));
    ASSERT_EQ(sides.size(), 6U);
    EXPECT_NEAR(area(sides), 22, 1e-12);
    for (const MergedPiece& side : sides) {
      EXPECT_EQ(side.outline.size(), 4U);
    }
  }
}

/// The walls and sides of a box in a cube, of one patch a face.
TEST(MergedPieces, OfCoplanarFacesThatShareEdgesAreOnePolygon) {
  const auto scene = testing::box_in_cube(4, 2).scene();
  const auto polygons = merged_pieces(*scene);
  ASSERT_EQ(polygons.size(), 12U);
  EXPECT_NEAR(area(polygons), 6 + 6 * 0.16, 1e-12);
  for (const MergedFace& face : merged_faces(*scene)) {
    EXPECT_TRUE(std::is_sorted(face.patches.begin(), face.patches.end()));
    EXPECT_EQ(face.patches.size(), face.patches.front() < 96 ? 16U : 4U);
  }
}

TEST(MergedPieces, OfConcaveFacesAreTheirPiecesAndOfNonplanarOnesTheirTriangles) {
  Sketch concave, nonplanar;
  concave.face({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}}, concave.material(0.5, 0));
  nonplanar.face({{0, 0, 1}, {1, 0, 1}, {1, 1, 1.5}, {0, 1, 1}}, nonplanar.material(0.5, 0));
  for (const double area_bound : {0.0, 0.1}) {
    const auto scene = concave.scene({.max_patch_area = area_bound});
    EXPECT_EQ(merged_pieces(*scene).size(), scene->pieces().size());
    EXPECT_EQ(merged_pieces(*nonplanar.scene({.max_patch_area = area_bound})).size(), 2U);
  }
}

/// A corner of the second triangle is beyond the first: folded by more than a right angle, they
/// face away from each other.
TEST(MergedPieces, OfAFoldedFaceAreBothItsTriangles) {
  Sketch sketch;
  sketch.face({{-.2, 0, 0}, {0, -1, 2}, {.2, 0, 0}, {0, 1, 2}}, sketch.material(0.5, 0));
  ASSERT_LT(dot(sketch.scene()->patch(0).normal, sketch.scene()->patch(1).normal), 0);
  for (const bool two_sided : {false, true}) {
    for (const double area_bound : {0.0, 0.1}) {
      const auto scene = sketch.scene({.two_sided = two_sided, .max_patch_area = area_bound});
      double expected = 0;
      for (const Patch& patch : scene->patches()) {
        expected += patch.area / (two_sided ? 2 : 1);
      }
      const auto triangles = merged_pieces(*scene);
      EXPECT_EQ(triangles.size(), 2U);
      EXPECT_NEAR(area(triangles), expected, 1e-12);
    }
  }
}

TEST(MergedPieces, OfCoincidentFacesAreOne) {
  Sketch sketch;
  const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> reversed(corners.rbegin(), corners.rend());
  for (const double reflectance : {0.1, 0.2, 0.3}) {
    sketch.face(corners, sketch.material(reflectance, 0));
    sketch.face(reversed, sketch.material(reflectance, 1));
  }
  sketch.face({{0, 0, 1}, {2, 0, 1}, {2, 1, 1}}, sketch.material(0.5, 0));
  const auto polygons = merged_pieces(*sketch.scene());
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_EQ(polygons[0].patches, (std::vector<PatchId>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(polygons[1].patches, (std::vector<PatchId>{6}));
  // The lamps are above the others, and the last one above the first.
  std::vector<PatchId> uppermost;
  for (const Piece& piece : uppermost_pieces(*sketch.scene())) {
    uppermost.push_back(piece.patch);
  }
  EXPECT_EQ(uppermost, (std::vector<PatchId>{4, 5, 6}));
}

TEST(MergedPieces, CoverTheSameAreaAsThePatches) {
  for (const char* spec : {"cornell-box", "rooms", "stars", "sphere-flake:levels=1"}) {
    const auto scene = load_scene(spec, {.max_patch_area = 0.05});
    const double patches = total_area(*scene);
    const auto merged = merged_pieces(*scene);
    EXPECT_LT(merged.size(), scene->pieces().size()) << spec;
    EXPECT_NEAR(area(merged), patches, 1e-9 * patches) << spec;
  }
}

}  // namespace
}  // namespace transillum::merged_pieces_test
