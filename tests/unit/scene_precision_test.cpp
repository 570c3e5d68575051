// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Faces that are planar only within the digits of their file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "scene/build/precision.h"
#include "scene/build/rounding_repair.h"
#include "support/scenes.h"
#include "transillum/engine.h"
#include "transillum/files.h"

namespace transillum::scene_precision_test {
namespace {

/// A scene, turned, its coordinates printed with so many digits.
SceneDescription rounded(const std::string& spec, int digits) {
  SceneDescription description = describe_scene(spec);
  const Vec3 x = normalized(Vec3{0.8, 0.5, -0.3});
  const Vec3 y = normalized(cross(Vec3{0.1, 0.2, 0.9}, x)), z = cross(x, y);
  const auto printed = [digits](double v) {
    return std::strtod(fmt::format("{:.{}g}", v, digits).c_str(), nullptr);
  };
  for (Vec3& p : description.points) {
    const Vec3 turned = p.x * x + p.y * y + p.z * z;
    p = {printed(turned.x), printed(turned.y), printed(turned.z)};
  }
  return description;
}

std::shared_ptr<const Scene> rounded_scene(const std::string& spec, int digits) {
  return std::make_shared<const Scene>(rounded(spec, digits));
}

struct Passes {
  std::size_t fragments = 0;
  std::int64_t pairs = 0;
  double closure = 0;
};

Passes run_passes(const std::shared_ptr<const Scene>& scene) {
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(Engine::fast, scene, tree);
  Passes passes;
  passes.fragments = tree->fragments().size();
  for (const Vec3& omega : testing::test_directions(30, 5)) {
    const Transfers transfers = engine(omega, {});
    passes.pairs += transfers.counts.pairs;
    passes.closure = std::max(passes.closure, closure_defect(transfers, *scene).relative);
  }
  return passes;
}

/// Rounded scenes do not change: they have the same number of patches, pieces and fragments, are
/// closed, and need no more work.
class Rounded : public ::testing::TestWithParam<const char*> {};

TEST_P(Rounded, ScenesCostNoMore) {
  const auto exact = rounded_scene(GetParam(), 17);
  const Passes of_exact = run_passes(exact);
  for (const int digits : {6, 7, 9, 12}) {
    SCOPED_TRACE(fmt::format("{} digits", digits));
    const auto scene = rounded_scene(GetParam(), digits);
    EXPECT_EQ(scene->patch_count(), exact->patch_count());
    const Passes passes = run_passes(scene);
    EXPECT_LE(passes.closure, 1e-10);
    // Without the repair, there are 1.8 times (sphere-flake) to 4 times (rooms) the fragments.
    // Where touching faces are no longer recognized, there are up to 1.061 times as many
    // (sphere-flake, 7 digits).
    EXPECT_LE(static_cast<double>(passes.fragments),
              1.07 * static_cast<double>(of_exact.fragments) + 4);
    EXPECT_LE(static_cast<double>(passes.pairs), 1.15 * static_cast<double>(of_exact.pairs));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Rounded,
                         ::testing::Values("sphere-flake:levels=1", "cornell-box", "rooms",
                                           "boards", "stars", "furnace"));

TEST(Rounding, MovesPointsWithinIt) {
  for (const char* spec : {"rooms", "stars"}) {
    const SceneDescription description = rounded(spec, 7);
    const double rounding = coordinate_rounding(description.points);
    const std::vector<Vec3> points = without_rounding(description, rounding, {});
    ASSERT_EQ(points.size(), description.points.size());
    double farthest = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      farthest = std::max(farthest, norm(points[k] - description.points[k]));
    }
    EXPECT_GT(farthest, 0.1 * rounding) << spec;
    EXPECT_LE(farthest, 8 * rounding) << spec;
  }
}

TEST(Rounding, ExactScenesKeepTheirBits) {
  for (const char* spec : {"sphere-flake", "cornell-box", "rooms", "boards", "stars", "furnace"}) {
    const SceneDescription description = describe_scene(spec);
    EXPECT_EQ(without_rounding(description, coordinate_rounding(description.points), {}),
              description.points)
        << spec;
    // The box looks like it was printed with six digits, although it was not.
    SceneDescription box;
    box.materials = description.materials;
    box.points = {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0}, {0.25, 0.5, 0.125}};
    box.add_face(std::vector<PointId>{0, 1, 2, 3}, 0);
    box.add_face(std::vector<PointId>{0, 4, 3}, 0);
    EXPECT_EQ(without_rounding(box, coordinate_rounding(box.points), {}), box.points);
  }
}

/// Along an axis, one unit of the last digit is a distance, not rounding.
TEST(Rounding, KeepsParallelFacesOneUnitApart) {
  SceneDescription description;
  description.materials.push_back({"gray", {0.5, 0.5, 0.5}, {1, 1, 1}});
  description.points = {{0, 0, 0},        {1, 0, 0},        {1, 1, 0},        {0, 1, 0},
                        {0.2, 0.2, 1e-5}, {0.8, 0.2, 1e-5}, {0.8, 0.8, 1e-5}, {0.2, 0.8, 1e-5}};
  description.add_face(std::vector<PointId>{0, 1, 2, 3}, 0);
  description.add_face(std::vector<PointId>{4, 5, 6, 7}, 0);
  const double rounding = coordinate_rounding(description.points);
  EXPECT_DOUBLE_EQ(rounding, 0.5e-5);
  EXPECT_EQ(without_rounding(description, rounding, {}), description.points);
}

TEST(Precision, IsHalfAUnitOfTheLastDigitGiven) {
  const auto of = [](std::vector<Vec3> points) { return coordinate_rounding(points); };
  EXPECT_DOUBLE_EQ(of({{1.23456, 0.5, -2}}), 0.5e-5);
  EXPECT_DOUBLE_EQ(of({{123.456789, 0, 0}}), 0.5e-6);
  // At least the sixth digit of the largest coordinate.
  EXPECT_DOUBLE_EQ(of({{0.5, 1, 2}}), 0.5e-5);
  EXPECT_DOUBLE_EQ(of({{12, 500, 0}}), 0.5e-3);
  // With all digits, this is the rounding of doubles.
  EXPECT_LT(of({{1.0 / 3, std::sqrt(2.0), 1}}), 1e-15);
  // Floats.
  EXPECT_NEAR(of({{static_cast<double>(0.1F), static_cast<double>(1.7F), 0}}), 0.5 * 0x1p-23 * 1.7,
              1e-9);
  EXPECT_EQ(of({{0, 0, 0}}), 0);
}

TEST(Precision, ABendLargerThanTheRoundingIsAFeature) {
  const auto faces = [](double height) {
    SceneDescription description;
    description.materials.push_back({"gray", {0.5, 0.5, 0.5}, {1, 1, 1}});
    description.points = {{0, 0, 0}, {1, 0, 0}, {1.00001, 1, height}, {0, 1.00001, 0}};
    description.add_face(std::vector<PointId>{0, 1, 2, 3}, 0);
    return Scene(description).patch_count();
  };
  EXPECT_EQ(faces(1e-5), 1);
  EXPECT_EQ(faces(1e-3), 2);
}

}  // namespace
}  // namespace transillum::scene_precision_test
