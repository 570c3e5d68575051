// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Closed parts that cross, touch or contain one another, united: areas are known in closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "transillum/at.h"
#include "transillum/solids.h"

namespace transillum {
namespace {

/// Adds an axis-parallel box of six faces in its own group.
void add_box(SceneDescription& scene, const Vec3& low, const Vec3& high, bool inward = false) {
  const auto first = static_cast<PointId>(scene.points.size());
  for (int k = 0; k < 8; ++k) {
    scene.points.push_back(
        {k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
  }
  if (scene.materials.empty()) {
    scene.materials.push_back({"gray", {0.5, 0.5, 0.5}, {1, 1, 1}});
  }
  scene.groups.push_back("box " + std::to_string(scene.groups.size()));
  constexpr std::array<std::array<PointId, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& face : faces) {
    std::vector<PointId> outline;
    for (const PointId p : face) {
      outline.insert(inward ? outline.begin() : outline.end(), first + p);
    }
    scene.add_face(outline, 0, 0, static_cast<int>(scene.groups.size()) - 1);
  }
}

double area_of(const SceneDescription& description) {
  double sum = 0;
  const Scene scene(description);
  for (const Patch& patch : scene.patches()) {
    sum += patch.area;
  }
  return sum;
}

TEST(UniteSolids, BoxesThatCrossLoseWhatIsInsideTheOther) {
  SceneDescription scene;
  add_box(scene, {0, 0, 0}, {2, 2, 2});
  add_box(scene, {1, 1, 1}, {3, 3, 3});
  EXPECT_NEAR(share_inside_solids(scene), 6.0 / 48, 0.02);
  const SolidsReport report = unite_solids(scene);
  EXPECT_EQ(report.solids, 2);
  EXPECT_EQ(report.united, 2);
  EXPECT_EQ(report.refused, 0);
  EXPECT_NEAR(report.area_after, 42, 1e-12);
  EXPECT_NEAR(area_of(scene), 42, 1e-12);
  EXPECT_EQ(share_inside_solids(scene), 0);
  const Scene united(scene);
  std::set<std::int32_t> faces;
  for (const Patch& patch : united.patches()) {
    faces.insert(patch.face);
    EXPECT_EQ(patch.group, patch.face / 6);  // faces keep their numbers and groups
  }
  EXPECT_EQ(faces.size(), 12u);
  EXPECT_TRUE(report.removed.empty());
  EXPECT_EQ(report.cut, (std::vector<std::int32_t>{1, 3, 5, 6, 8, 10}));
}

/// Points that are moved within the rounding of their file change areas, too.
TEST(UniteSolids, NamesTheCutFacesOfRoundedBoxes) {
  SceneDescription scene;
  add_box(scene, {0, 0, 0}, {2, 2, 2});
  add_box(scene, {1, 1, 1}, {3, 3, 3});
  add_box(scene, {5, 5, 5}, {6, 6, 6});
  for (Vec3& p : scene.points) {
    const auto rounded = [](double x) { return std::round(1e4 * x) / 1e4; };
    p = {rounded(0.8 * p.x - 0.6 * p.y + p.z / 7), rounded(0.6 * p.x + 0.8 * p.y), rounded(p.z)};
  }
  scene.coordinate_rounding = 5e-5;
  EXPECT_EQ(unite_solids(scene).cut, (std::vector<std::int32_t>{1, 3, 5, 6, 8, 10}));
}

TEST(UniteSolids, BoxesThatTouchLoseTheirCommonWall) {
  SceneDescription scene;
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  add_box(scene, {1, 0, 0}, {2, 1, 1});
  unite_solids(scene);
  EXPECT_NEAR(area_of(scene), 10, 1e-12);
}

TEST(UniteSolids, ABoxInsideAnotherVanishes) {
  SceneDescription scene;
  add_box(scene, {0, 0, 0}, {3, 3, 3});
  add_box(scene, {1, 1, 1}, {2, 2, 2});
  const SolidsReport report = unite_solids(scene);
  EXPECT_NEAR(area_of(scene), 54, 1e-12);
  EXPECT_EQ(report.removed, (std::vector<std::int32_t>{6, 7, 8, 9, 10, 11}));
  EXPECT_TRUE(report.cut.empty());
}

// A block in a room, half sunk into the floor: the floor below it goes, and so does its lower half.
TEST(UniteSolids, TheRoomIsUnitedWithWhatStandsInItsWalls) {
  SceneDescription scene;
  add_box(scene, {0, 0, 0}, {4, 4, 4}, true);
  add_box(scene, {1, 1, -1}, {2, 2, 1});
  const SolidsReport report = unite_solids(scene);
  EXPECT_EQ(report.rooms, 1);
  EXPECT_NEAR(area_of(scene), 96 - 1 + 1 + 4, 1e-12);
}

TEST(UniteSolids, OpenPartsAndPartsApartKeepTheirFaces) {
  SceneDescription scene;
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  add_box(scene, {5, 0, 0}, {6, 1, 1});
  scene.points.insert(scene.points.end(), {{0, 0, 0.5}, {9, 0, 0.5}, {9, 9, 0.5}});
  scene.add_face(std::array<PointId, 3>{16, 17, 18}, 0);
  const SceneDescription before = scene;
  const SolidsReport report = unite_solids(scene);
  EXPECT_EQ(report.open, 1);
  EXPECT_EQ(report.united, 0);
  EXPECT_EQ(scene.corners, before.corners);
  EXPECT_EQ(scene.points, before.points);
}

}  // namespace
}  // namespace transillum
