// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Light maps with exact direct light: what linear filtering reads of them is the light at points of
// surfaces, up to their edges; the same bits for any number of threads.
#include <gmock/gmock.h>

#include <cmath>

#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/picture.h"
#include "transillum/solve_session.h"

namespace transillum::testing::sharp_light_map_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;

std::shared_ptr<const Solution> solved(const std::shared_ptr<const Scene>& scene) {
  SolveOptions options;
  options.directions = 64;
  return std::make_shared<const Solution>(solve(scene, options));
}

/// The value that linear filtering reads of the map at a point of a patch.
double filtered(const SharpLightMap& map, PatchId patch, const Vec3& point) {
  const auto [x, y] = map.place(patch, point);
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  double sum = 0;
  for (const int row : {0, 1}) {
    for (const int column : {0, 1}) {
      const double part = (column == 0 ? 1 - (x - 0.5 - left) : x - 0.5 - left) *
                          (row == 0 ? 1 - (y - 0.5 - top) : y - 0.5 - top);
      const auto at_row = static_cast<std::size_t>(top) + static_cast<std::size_t>(row);
      const auto at_column = static_cast<std::size_t>(left) + static_cast<std::size_t>(column);
      sum += part *
             static_cast<double>(
                 map.radiosity()[at_row * static_cast<std::size_t>(map.width()) + at_column][0]);
    }
  }
  return sum;
}

/// Calls visit(patch, point) for points of all patches, from the middle to the corners themselves.
template <class Visit>
void for_points(const Scene& scene, Visit visit) {
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      for (const double part : {0.0, 0.4, 0.8, 1.0}) {
        visit(i, (1 - part) * scene.patch(i).center + part * scene.point(p));
      }
    }
  }
}

TEST(SharpLightMap, OfAFurnaceIsTwoEverywhere) {
  const auto scene = load_scene("furnace", {.max_patch_area = 0.3});
  const SharpLightMap map(solved(scene), {.density = 30});
  for_points(*scene, [&](PatchId i, const Vec3& x) { EXPECT_NEAR(filtered(map, i, x), 2, 1e-3); });
}

TEST(SharpLightMap, FilteredIsTheLightAtPoints) {
  const auto scene = box_in_cube(3, 2, random_rotation(3)).scene();
  const auto solution = solved(scene);
  const SharpLightMap map(solution, {.density = 120});
  const SurfaceLight light(solution);
  double squares = 0, all = 0;
  for_points(*scene, [&](PatchId i, const Vec3& x) {
    if (max_abs(scene->exitance(i)) == 0) {
      const Vec3 inside = x + 1e-3 * (scene->patch(i).center - x);
      squares += std::pow(filtered(map, i, x) - light.radiosity(i, inside).r, 2);
      all += std::pow(light.radiosity(i, inside).r, 2);
    }
  });
  EXPECT_LT(std::sqrt(squares / all), 0.02);
}

TEST(SharpLightMap, CoversTrianglesAndSlivers) {
  Sketch sketch;
  const int lamp = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, lamp);
  sketch.face({{0, 0, 2}, {1, 0, 2}, {1, 1e-5, 2}}, lamp);
  sketch.face({{0, 3, 0}, {0.001, 3, 0}, {0.001, 3.001, 0}}, lamp);
  const auto scene = sketch.scene();
  const SharpLightMap map(solved(scene), {.density = 37});
  for_points(*scene, [&](PatchId i, const Vec3& x) { EXPECT_NEAR(filtered(map, i, x), 1, 1e-6); });
}

TEST(SharpLightMap, HasTheSameBitsForAnyNumberOfThreads) {
  const auto solution = solved(box_in_cube(2, 1).scene());
  const SharpLightMap one(solution, {.density = 40, .threads = 1}),
      three(solution, {.density = 40, .threads = 3});
  EXPECT_EQ(one.radiosity(), three.radiosity());
}

TEST(SharpLightMap, RefusesWhatIsTooLarge) {
  const auto solution = solved(box_in_cube(2, 1).scene());
  EXPECT_THAT(refusal([&] { SharpLightMap(solution, {.density = 1e5}); }),
              HasSubstr("ask for fewer texels per meter"));
  EXPECT_THAT(refusal([&] { SharpLightMap(solution, {.density = -1}); }),
              HasSubstr("-1 texels per meter"));
}

}  // namespace
}  // namespace transillum::testing::sharp_light_map_test
