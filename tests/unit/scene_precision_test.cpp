// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Faces that are planar only within the digits of their file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "scene/build/precision.h"
#include "support/scenes.h"
#include "transillum/engine.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// The sphere-flake, turned, its coordinates printed with so many digits.
std::shared_ptr<const Scene> rounded_flake(int digits) {
  SceneDescription description = describe_scene("sphere-flake:levels=1");
  const Vec3 x = normalized(Vec3{0.8, 0.5, -0.3});
  const Vec3 y = normalized(cross(Vec3{0.1, 0.2, 0.9}, x)), z = cross(x, y);
  const auto rounded = [digits](double v) {
    return std::strtod(fmt::format("{:.{}g}", v, digits).c_str(), nullptr);
  };
  for (Vec3& p : description.points) {
    const Vec3 turned = p.x * x + p.y * y + p.z * z;
    p = {rounded(turned.x), rounded(turned.y), rounded(turned.z)};
  }
  return std::make_shared<const Scene>(description);
}

struct Passes {
  std::int64_t pairs = 0;
  double closure = 0;
};

Passes run_passes(const std::shared_ptr<const Scene>& scene) {
  const TransferEngine engine =
      make_engine(Engine::fast, scene, std::make_shared<const BspTree>(*scene));
  Passes passes;
  for (const Vec3& omega : testing::test_directions(30, 5)) {
    const Transfers transfers = engine(omega, {});
    passes.pairs += transfers.counts.pairs;
    passes.closure = std::max(passes.closure, closure_defect(transfers, *scene).relative);
  }
  return passes;
}

TEST(Precision, RoundedFacesStayOnePatchAndCostNoMore) {
  const auto exact = rounded_flake(17);
  const Passes of_exact = run_passes(exact);
  for (const int digits : {6, 7, 9, 12}) {
    SCOPED_TRACE(fmt::format("{} digits", digits));
    const auto scene = rounded_flake(digits);
    EXPECT_EQ(scene->patch_count(), exact->patch_count());
    EXPECT_EQ(scene->pieces().size(), exact->pieces().size());
    const Passes passes = run_passes(scene);
    EXPECT_LE(passes.closure, 1e-10);
    // Triangles are joined again: else there are 2.2 times the pairs.
    EXPECT_LE(static_cast<double>(passes.pairs), 1.7 * static_cast<double>(of_exact.pairs));
  }
}

TEST(Precision, IsHalfAUnitOfTheLastDigitGiven) {
  const auto of = [](std::vector<Vec3> points) { return coordinate_rounding(points); };
  EXPECT_DOUBLE_EQ(of({{1.23456, 0.5, -2}}), 0.5e-5);
  EXPECT_DOUBLE_EQ(of({{123.456789, 0, 0}}), 0.5e-6);
  // At least the sixth digit of the largest coordinate.
  EXPECT_DOUBLE_EQ(of({{0.5, 1, 2}}), 0.5e-5);
  EXPECT_DOUBLE_EQ(of({{12, 500, 0}}), 0.5e-3);
  // In full: the rounding of doubles.
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
}  // namespace transillum
