// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Light maps: what linear filtering reads of them is the light at points of surfaces, up to their
// edges, without seams; the same bits for any number of threads.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/linear_basis.h"
#include "transillum/picture.h"
#include "transillum/solve_session.h"

namespace transillum::testing::light_map_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;

std::shared_ptr<const Solution> solved(const std::shared_ptr<const Scene>& scene) {
  SolveOptions options;
  options.directions = 64;
  return std::make_shared<const Solution>(solve(scene, options));
}

LightMap exact_map(const std::shared_ptr<const Solution>& solution,
                   const LightMap::Options& options) {
  return {*solution->scene, SurfaceLight(solution), options};
}

/// The value that linear filtering reads of the map at a point of a patch.
double filtered(const LightMap& map, PatchId patch, const Vec3& point) {
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

TEST(LightMap, OfAFurnaceIsTwoEverywhere) {
  const auto scene = load_scene("furnace", {.max_patch_area = 0.3});
  const LightMap map = exact_map(solved(scene), {.density = 30});
  for_points(*scene, [&](PatchId i, const Vec3& x) { EXPECT_NEAR(filtered(map, i, x), 2, 1e-3); });
}

TEST(LightMap, FilteredIsTheLightAtPoints) {
  const auto scene = box_in_cube(3, 2, random_rotation(3)).scene();
  const auto solution = solved(scene);
  const LightMap map = exact_map(solution, {.density = 120});
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

TEST(LightMap, CoversTrianglesAndSlivers) {
  Sketch sketch;
  const int lamp = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, lamp);
  sketch.face({{0, 0, 2}, {1, 0, 2}, {1, 1e-5, 2}}, lamp);
  sketch.face({{0, 3, 0}, {0.001, 3, 0}, {0.001, 3.001, 0}}, lamp);
  const auto scene = sketch.scene();
  const LightMap map = exact_map(solved(scene), {.density = 37});
  for_points(*scene, [&](PatchId i, const Vec3& x) { EXPECT_NEAR(filtered(map, i, x), 1, 1e-6); });
}

TEST(LightMap, HasNoSeamsBetweenPatchesOfAPlane) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.05});
  const LightMap map = exact_map(solved(scene), {.density = 40});
  std::map<PointId, std::vector<PatchId>> patches;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    for (const PointId p : scene->outline(i)) {
      patches[p].push_back(i);
    }
  }
  int shared = 0;
  for (const auto& [p, around] : patches) {
    for (const PatchId j : around) {
      const Patch &first = scene->patch(around.front()), &other = scene->patch(j);
      if (dot(first.normal, other.normal) > 1 - 1e-9 && first.material == other.material) {
        ++shared;
        // Beside the corner, too: both patches read the same texels.
        for (const double part : {0.0, 0.1}) {
          const Vec3 x = (1 - part) * scene->point(p) + part * other.center;
          EXPECT_EQ(filtered(map, around.front(), x), filtered(map, j, x));
        }
      }
    }
  }
  EXPECT_GT(shared, 150);
}

TEST(LightMap, OfASolutionIsItsFunction) {
  SolveOptions options;
  options.directions = 32;
  options.basis = Basis::linear;
  const auto scene = box_in_cube(2, 2).scene();
  const Solution solution = solve(scene, options);
  const LightMap map(solution);
  ASSERT_FALSE(solution.linear_terms.empty());
  for_points(*scene, [&](PatchId i, const Vec3& x) {
    const auto [first, second] = linear_basis(*scene, i).at(x);
    const LinearTerm& term = at(solution.linear_terms, i);
    const double b = at(solution.radiosity, i).r + first * term.first.r + second * term.second.r;
    EXPECT_NEAR(filtered(map, i, x), b, 1e-6 * (1 + std::abs(b)));
  });
}

TEST(LightMap, HasTheSameBitsForAnyNumberOfThreads) {
  const auto solution = solved(box_in_cube(2, 1).scene());
  const LightMap one = exact_map(solution, {.density = 40, .threads = 1}),
                 three = exact_map(solution, {.density = 40, .threads = 3});
  EXPECT_EQ(one.radiosity(), three.radiosity());
}

TEST(LightMap, RefusesWhatIsTooLarge) {
  const auto solution = solved(box_in_cube(2, 1).scene());
  EXPECT_THAT(refusal([&] { exact_map(solution, {.density = 1e5}); }),
              HasSubstr("it needs fewer patches or texels per meter"));
  EXPECT_THAT(refusal([&] { exact_map(solution, {.density = -1}); }),
              HasSubstr("-1 texels per meter"));
  EXPECT_THAT(refusal([&] { exact_map(solution, {.density = 40, .tolerance = 0}); }),
              HasSubstr("a tolerance of 0"));
}

}  // namespace
}  // namespace transillum::testing::light_map_test
