// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// divide(): cells, parents, two-sided faces, and that passes of a divided scene add up.
#include "scene/build/division.h"

#include <gmock/gmock.h>

#include <map>
#include <numeric>

#include "scene_test_support.h"
#include "session/divisions.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::division_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using testing::Sketch;

Scene one_face(const std::vector<Vec3>& outline) { return Scene(test::polygon(outline)); }

/// Areas of the patches of a scene with one face whose only patch is divided.
std::vector<double> areas_of_division(const std::vector<Vec3>& outline) {
  const Scene scene = one_face(outline);
  const DividedScene divided = divide(scene, std::vector<PatchId>{0});
  EXPECT_EQ(divided.scene->patch_count(), division_count(scene, 0));
  EXPECT_THAT(divided.parent, Each(0));
  std::vector<double> areas;
  for (const Patch& patch : divided.scene->patches()) {
    areas.push_back(patch.area);
    EXPECT_EQ(patch.normal, scene.patch(0).normal);
  }
  return areas;
}

TEST(Division, MakesFourOfTrianglesAndQuadrilaterals) {
  EXPECT_THAT(areas_of_division({{0, 0, 0}, {4, 0, 0}, {0, 2, 0}}), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(areas_of_division({{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}),
              ElementsAre(1, 1, 1, 1));
}

TEST(Division, CutsLongQuadrilateralsInARow) {
  for (const auto& [x, y] : {std::pair{8.0, 1.0}, std::pair{1.0, 8.0}}) {
    const Scene strip = one_face({{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}});
    const DividedScene divided = divide(strip, std::vector<PatchId>{0});
    for (PatchId i = 0; i < divided.scene->patch_count(); ++i) {
      const auto outline = divided.scene->outline(i);
      EXPECT_DOUBLE_EQ(
          norm(divided.scene->point(outline[1]) - divided.scene->point(outline[0])) +
              norm(divided.scene->point(outline[2]) - divided.scene->point(outline[1])),
          3);
    }
  }
}

TEST(Division, MakesConvexPartsOfOtherFaces) {
  // A pentagon is divided into triangles, an L into its convex pieces.
  EXPECT_THAT(areas_of_division({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}).size(), 3);
  const auto parts =
      areas_of_division({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  EXPECT_GE(parts.size(), 2U);
  EXPECT_DOUBLE_EQ(std::accumulate(parts.begin(), parts.end(), 0.0), 3);
}

TEST(Division, LeavesTheOthersAsTheyAre) {
  const auto scene = load_scene("cornell-box");
  const DividedScene divided = divide(*scene, std::vector<PatchId>{20, 3});
  std::map<PatchId, int> parts;
  std::map<PatchId, double> areas;
  PatchId last = 0;
  for (PatchId k = 0; k < divided.scene->patch_count(); ++k) {
    const PatchId i = at(divided.parent, k);
    EXPECT_GE(i, last);
    last = i;
    ++parts[i];
    areas[i] += divided.scene->patch(k).area;
    EXPECT_EQ(divided.scene->patch(k).face, scene->patch(i).face);
    EXPECT_EQ(divided.scene->patch(k).material, scene->patch(i).material);
    EXPECT_EQ(divided.scene->patch(k).group, scene->patch(i).group);
  }
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_EQ(parts[i], i == 3 || i == 20 ? 4 : 1) << i;
    EXPECT_NEAR(areas[i], scene->patch(i).area, 1e-15) << i;
  }
  EXPECT_EQ(divided.scene->name(), scene->name());
  EXPECT_EQ(divided.scene->bounds().high, scene->bounds().high);
}

TEST(Division, DividesBothSidesOfAFaceAlike) {
  const auto scene = std::make_shared<const Scene>(
      test::polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}), SceneOptions{.two_sided = true});
  for (const PatchId side : {0, 1}) {
    const DividedScene divided = divide(*scene, std::vector<PatchId>{side});
    ASSERT_THAT(divided.parent, ElementsAre(0, 1, 0, 1, 0, 1, 0, 1));
    for (PatchId k = 0; k < 8; k += 2) {
      EXPECT_EQ(divided.scene->patch(k).center, divided.scene->patch(k + 1).center);
      EXPECT_EQ(divided.scene->patch(k).normal, -divided.scene->patch(k + 1).normal);
    }
  }
}

/// The exchanges of a divided scene sum to the exchanges of the whole: oracle 1 for patches of
/// unequal size, whose edges share no corners.
TEST(Division, PassesOfUnequalPatchesAddUp) {
  for (const char* spec : {"furnace", "cornell-box", "rooms"}) {
    SCOPED_TRACE(spec);
    std::shared_ptr<const Scene> scene = load_scene(spec);
    SolveOptions options{.directions = 64, .normalize = Normalization::rows};
    for (int trial = 0; trial < 3; ++trial) {
      std::vector<PatchId> some;
      for (PatchId i = trial; i < scene->patch_count(); i += 3) {
        some.push_back(i);
      }
      scene = divide(*scene, some).scene;
    }
    const Solution solution = solve(scene, options);
    EXPECT_LE(solution.statistics.closure_defect_max, 1e-10);
    EXPECT_NEAR(solution.statistics.energy_balance, 1, 0.1);
    EXPECT_EQ(solution.statistics.counts.missed, 0);
  }
}

/// Nothing is divided into parts that coordinates cannot tell apart.
TEST(Division, LeavesWhatIsTooThin) {
  const double tiny = 3e-14;
  const Scene scene = one_face({{1, 0, 0}, {1 + tiny, 0, 0}, {1, tiny, 0}});
  std::shared_ptr<const Scene> last = std::make_shared<const Scene>(scene);
  for (int trial = 0; trial < 8; ++trial) {
    last = divide(*last, all_patches(*last)).scene;
    for (const Patch& patch : last->patches()) {
      EXPECT_GT(patch.area, 0);
    }
  }
  EXPECT_LT(last->patch_count(), 1 << 16);
}

TEST(Division, IsNamedByASurfaceOrByNumbers) {
  const auto box = load_scene("cornell-box");
  const std::vector<PatchId> all = all_patches(*box);
  EXPECT_EQ(division_name(*box, "all", all), "all");
  EXPECT_EQ(division_name(*box, "floor", all), "patch:0-" + std::to_string(box->patch_count() - 1));
  const std::vector<PatchId> some{2, 5, 6, 7, 9};
  EXPECT_EQ(division_name(*box, "patch:2", some), "patch:2,5-7,9");
  const auto by_numbers = divided_scene(box, {"patch:2,5-7,9", "patch:0"});
  const auto direct = divide(*divide(*box, some).scene, std::vector<PatchId>{0}).scene;
  ASSERT_EQ(by_numbers->patch_count(), direct->patch_count());
  for (PatchId i = 0; i < direct->patch_count(); ++i) {
    EXPECT_EQ(by_numbers->patch(i).center, direct->patch(i).center);
  }
}

TEST(Division, OfUnknownPatchesIsRefused) {
  const auto box = load_scene("cornell-box");
  const std::string last = std::to_string(box->patch_count() - 1);
  for (const char* name :
       {"patch:", "patch:1,", "patch:-1", "patch:7-3", "patch:1e2", "patch:0-99999", "patch:1 2"}) {
    try {
      divided_scene(box, {name});
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("from 0 to " + last)) << name;
    }
  }
  EXPECT_THROW(divided_scene(box, {"roof"}), InputError);
}

}  // namespace
}  // namespace transillum::division_test
