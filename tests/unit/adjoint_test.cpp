// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// solve_adjoint() and find_light_paths() against solves with other emissions and against all paths.
#include "transillum/adjoint.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "geometry/luminance.h"
#include "radiosity/form_factors/light_paths.h"
#include "support/form_factor_rows.h"
#include "transillum/at.h"
#include "transillum/material_changes.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::adjoint_test {
namespace {

using testing::form_factors_of;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double tight = 1e-13;

// The definition: a watt is added on patch j, and the scene is solved again by passes.
TEST(Adjoint, EqualsTheDifferenceOfSolvesWithAndWithoutAWatt) {
  const SceneDescription description = describe_scene("cornell-box");
  const auto scene = std::make_shared<const Scene>(description);
  for (const bool two_way : {true, false}) {
    for (const Normalization normalize : {Normalization::none, Normalization::rows}) {
      const SolveOptions options{.directions = 60,
                                 .two_way = two_way,
                                 .normalize = normalize,
                                 .first_shot = {},
                                 .tolerance = tight};
      const PatchId i = 3;
      const Adjoint adjoint = solve_adjoint(*scene, form_factors_of(scene, options), i,
                                            scene->materials(), {.tolerance = tight});
      const Rgb without = at(solve(scene, options).radiosity, i);
      for (const PatchId j : {PatchId{0}, i, PatchId{9}, PatchId{20}}) {
        const double watt = 1 / scene->patch(j).area;
        SceneDescription emitting = description;
        change_materials(emitting, std::vector{MaterialChange{
                                       "face:" + std::to_string(scene->patch(j).face), std::nullopt,
                                       scene->exitance(j) + Rgb{watt, watt, watt}}});
        const auto changed = std::make_shared<const Scene>(emitting);
        ASSERT_EQ(changed->patch_count(), scene->patch_count());
        const Rgb with = at(solve(changed, options).radiosity, i);
        const Rgb expected = with - without;
        EXPECT_LE(max_abs(at(adjoint.per_watt, j) - expected), 1e-9 * (1 + max_abs(with))) << j;
        EXPECT_EQ(max_abs(expected) > 1e-9, max_abs(at(adjoint.per_watt, j)) > 1e-9) << j;
      }
    }
  }
}

TEST(Adjoint, ContributionsSumToTheRadiosity) {
  for (const char* spec : {"cornell-box", "rooms", "furnace"}) {
    const auto scene = load_scene(spec);
    const SolveOptions options{.directions = 40, .tolerance = tight};
    const FormFactors form_factors = form_factors_of(scene, options);
    const std::vector<Rgb> b = solve_radiosity(*scene, form_factors, tight);
    for (const PatchId i : {PatchId{0}, PatchId{5}, scene->patch_count() - 1}) {
      const Adjoint adjoint =
          solve_adjoint(*scene, form_factors, i, scene->materials(), {.tolerance = tight});
      Rgb sum;
      for (PatchId j = 0; j < scene->patch_count(); ++j) {
        sum += scene->patch(j).area * (at(adjoint.per_watt, j) * scene->exitance(j));
      }
      EXPECT_LE(max_abs(sum - at(b, i)), 1e-10 * (1 + max_abs(at(b, i)))) << spec << i;
    }
  }
}

TEST(Adjoint, DoesNotDependOnTheNumberOfThreads) {
  const auto scene = load_scene("rooms");
  const FormFactors form_factors = form_factors_of(scene, {.directions = 20});
  const auto solved = [&](int threads) {
    return solve_adjoint(*scene, form_factors, 7, scene->materials(), {.threads = threads})
        .per_watt;
  };
  EXPECT_TRUE(solved(1) == solved(4));
}

TEST(Adjoint, UsesTheMaterialsOfPatches) {
  const auto scene = load_scene("furnace");
  const FormFactors form_factors = form_factors_of(scene, {.directions = 20});
  std::vector<Material> black(1);
  const std::vector<std::int32_t> of_patch(scene->patches().size(), 0);
  const Adjoint adjoint =
      solve_adjoint(*scene, form_factors, 2, black, {.patch_materials = of_patch});
  for (PatchId j = 0; j < scene->patch_count(); ++j) {
    EXPECT_EQ(at(adjoint.per_watt, j).r, j == 2 ? 1 / scene->patch(2).area : 0);
  }
}

TEST(Adjoint, RefusesAPatchThatDoesNotExist) {
  const auto scene = load_scene("furnace");
  const FormFactors form_factors = form_factors_of(scene, {.directions = 20});
  EXPECT_THAT(([&] { solve_adjoint(*scene, form_factors, 12, scene->materials()); }),
              ThrowsMessage<InputError>(HasSubstr("patch 12 does not exist")));
  EXPECT_THAT(([&] { find_light_paths(*scene, form_factors, -1, scene->materials()); }),
              ThrowsMessage<InputError>(HasSubstr("patch -1 does not exist")));
  EXPECT_THAT(
      ([&] { find_light_paths(*scene, form_factors, 0, scene->materials(), {.count = 0}); }),
      ThrowsMessage<InputError>(HasSubstr("number of paths")));
}

TEST(LightPaths, SumWithWhatIsCutOffToTheRadiosity) {
  for (const char* spec : {"cornell-box", "rooms"}) {
    const auto scene = load_scene(spec);
    const FormFactors form_factors = form_factors_of(scene, {.directions = 60});
    const std::vector<Rgb> b = solve_radiosity(*scene, form_factors, tight);
    for (const int count : {1, 50, 5000}) {
      const PatchId receiver = 6;
      const LightPaths found = find_light_paths(*scene, form_factors, receiver, scene->materials(),
                                                {.count = count, .tolerance = tight});
      EXPECT_TRUE(found.complete);
      Rgb sum = found.cut_off;
      for (std::size_t k = 0; k < found.paths.size(); ++k) {
        const LightPath& path = found.paths[k];
        sum += path.contribution;
        EXPECT_EQ(path.patches.back(), receiver);
        EXPECT_GT(max_abs(scene->exitance(path.patches.front())), 0);
        EXPECT_TRUE(k == 0 || luminance(path.contribution) <=
                                  luminance(found.paths[k - 1].contribution) * (1 + 1e-12));
      }
      EXPECT_LE(std::ssize(found.paths), count);
      const Rgb& expected = at(b, receiver);
      EXPECT_LE(max_abs(sum - expected), 1e-10 * max_abs(expected)) << spec << count;
      EXPECT_LE(max_abs(found.radiosity - expected), 1e-10 * max_abs(expected));
    }
  }
}

// Every path of up to `bounces` reflections, by definition.
void all_paths(const Scene& scene, const FormFactors& f, int bounces, const LightPath& tail,
               std::vector<LightPath>& paths) {
  const PatchId k = tail.patches.front();
  paths.push_back({tail.patches, tail.contribution * scene.exitance(k)});
  for (auto entry = at(f.row_begin, k); bounces > 0 && entry < at(f.row_begin, k + 1); ++entry) {
    LightPath longer{{f.source[entry]},
                     f.value[entry] * (tail.contribution * scene.reflectance(k))};
    longer.patches.insert(longer.patches.end(), tail.patches.begin(), tail.patches.end());
    all_paths(scene, f, bounces - 1, longer, paths);
  }
}

TEST(LightPaths, AreTheStrongestOfAllPaths) {
  const auto scene = load_scene("furnace");  // E = 1, rho = 0.5
  const FormFactors form_factors = form_factors_of(scene, {.directions = 50});
  std::vector<LightPath> all;
  all_paths(*scene, form_factors, 5, {{8}, {1, 1, 1}}, all);
  std::sort(all.begin(), all.end(), [](const LightPath& a, const LightPath& b) {
    return a.contribution.r > b.contribution.r;
  });
  // Above the largest contribution after 6 reflections.
  constexpr double bound = 0.015625;
  const auto strong = std::count_if(
      all.begin(), all.end(), [](const LightPath& path) { return path.contribution.r > bound; });
  ASSERT_GT(strong, 10);
  const LightPaths found = find_light_paths(*scene, form_factors, 8, scene->materials(),
                                            {.count = static_cast<int>(strong)});
  ASSERT_EQ(std::ssize(found.paths), strong);
  for (std::size_t k = 0; k < found.paths.size(); ++k) {
    EXPECT_NEAR(found.paths[k].contribution.r, all[k].contribution.r, 1e-12) << k;
  }
  EXPECT_EQ(found.paths[0].patches, std::vector<PatchId>{8});  // its own emission
}

}  // namespace
}  // namespace transillum::adjoint_test
