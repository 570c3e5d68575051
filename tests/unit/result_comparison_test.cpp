// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// compare_results() and `transillum compare`, on results whose differences are known.
#include "radiosity/analysis/result_comparison.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/program_call.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/files.h"

namespace transillum::testing::result_comparison_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;

/// Three unit squares in two groups; the third is in none.
SceneDescription squares() {
  Sketch sketch("squares");
  const int gray = sketch.material(0.5, 1);
  for (int k = 0; k < 3; ++k) {
    const double z = k;
    sketch.face({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, gray);
  }
  SceneDescription description = sketch.description();
  description.groups = {"low", "unused", "middle"};
  description.face_group = {0, 2, no_group};
  return description;
}

/// @param reflected B - E
Solution result(const std::vector<Rgb>& reflected,
                const SceneDescription& description = squares()) {
  Solution solution;
  solution.scene = std::make_shared<const Scene>(description);
  for (const Rgb& light : reflected) {
    const auto i = static_cast<PatchId>(solution.radiosity.size());
    solution.radiosity.push_back(light + solution.scene->exitance(i));
  }
  solution.irradiance.resize(reflected.size());
  return solution;
}

TEST(ResultComparison, FindsTheKnownDifferences) {
  const Solution a = result({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}});
  const Solution b = result({{1, 1, 1.5}, {2, 3, 2}, {4, 4, 4}});
  const ResultComparison comparison = compare_results(a, b);
  EXPECT_DOUBLE_EQ(comparison.whole.rms, std::sqrt((0.25 + 1) / (3 + 12 + 48)));
  EXPECT_DOUBLE_EQ(comparison.whole.largest, 1.0 / 4);
  EXPECT_EQ(comparison.whole.worst, 1);
  EXPECT_EQ(comparison.whole.second, (Rgb{3, 4, 3}));
  ASSERT_EQ(comparison.groups.size(), 3U);
  EXPECT_EQ(comparison.groups[0].group, 0);
  EXPECT_DOUBLE_EQ(comparison.groups[0].difference.largest, 0.5);
  EXPECT_EQ(comparison.groups[1].group, 2);
  EXPECT_DOUBLE_EQ(comparison.groups[1].difference.rms, std::sqrt(1.0 / 12));
  EXPECT_EQ(comparison.groups[2].group, no_group);
  EXPECT_EQ(comparison.groups[2].difference.worst, no_patch);
}

/// Sources do not count, however bright, unless a group has only sources.
TEST(ResultComparison, LeavesSourcesOut) {
  SceneDescription description = squares();
  description.materials.push_back(description.materials[0]);
  description.materials[0].exitance = {};
  description.materials[1].exitance = {1e6, 1e6, 1e6};
  description.face_material = {0, 0, 1};
  description.face_group = {0, 0, 2};
  const Solution a = result({{1, 1, 1}, {1, 1, 1}, {4, 4, 4}}, description);
  const Solution b = result({{1, 1, 1}, {1.5, 1.5, 1.5}, {5, 5, 5}}, description);
  const ResultComparison comparison = compare_results(a, b);
  EXPECT_DOUBLE_EQ(comparison.whole.rms, std::sqrt(0.125));
  EXPECT_DOUBLE_EQ(comparison.whole.largest, 0.5);
  EXPECT_EQ(comparison.whole.worst, 1);
  ASSERT_EQ(comparison.groups.size(), 2U);
  EXPECT_NEAR(comparison.groups[1].difference.rms, 0.25, 1e-9);
}

TEST(ResultComparison, NamesDifferentSkies) {
  const std::vector<Rgb> b(3, Rgb{1, 1, 1});
  Solution one = result(b), other = result(b);
  EXPECT_EQ(compare_results(one, other).sky_difference, "");
  other.sky = {.exitance = {1, 2, 3}, .model = SkyModel::cie_overcast};
  EXPECT_EQ(compare_results(one, other).sky_difference,
            "one has none, and the other has a sky of 1 2 3 W/m2, cie-overcast, up 0 0 1");
  one.sky = other.sky;
  EXPECT_EQ(compare_results(one, other).sky_difference, "");
  // The direction of a uniform sky means nothing.
  one.sky.model = other.sky.model = SkyModel::uniform;
  other.sky.up = {0, 1, 0};
  EXPECT_EQ(compare_results(one, other).sky_difference, "");
  // Files of older versions do not say which sky the solve had.
  one.sky = {};
  one.sky_irradiance.resize(3);
  EXPECT_EQ(compare_results(one, other).sky_difference, "");
}

TEST(ResultComparison, EqualResultsDoNotDiffer) {
  const Solution dark = result({{}, {}, {}}), bright = result({{1, 1, 1}, {}, {}});
  EXPECT_EQ(compare_results(dark, dark).whole.rms, 0);
  EXPECT_EQ(compare_results(bright, bright).whole.largest, 0);
  EXPECT_EQ(compare_results(dark, bright).whole.rms, HUGE_VAL);
  EXPECT_EQ(compare_results(bright, dark).whole.largest, 1);
}

TEST(ResultComparison, IsRelativeForLightOfAnyStrength) {
  for (const double strength : {1e-170, 1.0, 1e170}) {
    const Rgb one = strength * Rgb{1, 1, 1};
    SceneDescription dark = squares();
    dark.materials[0].exitance = {};
    const Solution a = result({one, one, one}, dark), b = result({one, one, 1.5 * one}, dark);
    EXPECT_NEAR(compare_results(a, b).whole.rms, std::sqrt(0.25 / 3), 1e-15);
  }
}

TEST(ResultComparison, NamesTheDifferenceOfScenes) {
  const auto against = [](const SceneDescription& other) {
    const Scene scene(other);
    const std::vector<Rgb> b(static_cast<std::size_t>(scene.patch_count()));
    return refusal([&] { compare_results(result({{}, {}, {}}), result(b, other)); });
  };
  EXPECT_EQ(against(squares()), "");
  SceneDescription other = squares();
  other.materials[0].reflectance = {0.25, 0.5, 0.5};
  EXPECT_EQ(against(other),
            "the results are of different scenes: patch 0 has rho 0.5 0.5 0.5 in one and 0.25 0.5 "
            "0.5 in the other");
  other.materials[0].exitance = {2, 2, 2};
  EXPECT_THAT(against(other), HasSubstr("patch 0 has E 1 1 1 in one and 2 2 2 in the other"));
  other = moved(squares(), [](const Vec3& p) { return p.z > 1.5 ? p + Vec3{0, 0, 1} : p; });
  EXPECT_THAT(against(other), HasSubstr("patch 2 has corner 0 at 0 0 2 in one and 0 0 3"));
  other = reordered(squares(), {0, 1});
  EXPECT_THAT(against(other), HasSubstr("one has 3 patches and the other 2"));
}

class CliCompare : public ::testing::Test {
 protected:
  CliCompare() {
    write_result(folder_ / "a.vtp", result({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}}));
    write_result(folder_ / "b.vtp", result({{1, 1, 1}, {2, 3, 2}, {4, 4, 4}}));
  }
  ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run_program(arguments, {}, {}, folder_.path().string());
  }

  TemporaryFolder folder_;
};

TEST_F(CliCompare, PrintsByGroupAndWhere) {
  const ProgramResult compared = run({"a.vtp", "b.vtp"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_EQ(compared.err, "");
  EXPECT_THAT(compared.out, HasSubstr("0.25 of the largest reflected light"));
  EXPECT_THAT(compared.out, HasSubstr("patch 1 (face 1"));
  EXPECT_THAT(compared.out, HasSubstr("group middle)"));
  EXPECT_THAT(compared.out, ::testing::ContainsRegex("low +1 +0 +0"));
  EXPECT_THAT(compared.out, HasSubstr("(no group)"));
}

TEST_F(CliCompare, ExitsWith1OverTheTolerance) {
  EXPECT_EQ(run({"a.vtp", "b.vtp", "--tolerance", "0.25"}).status, 0);
  const ProgramResult over = run({"a.vtp", "b.vtp", "--tolerance", "0.24"});
  EXPECT_EQ(over.status, 1);
  EXPECT_THAT(over.out, HasSubstr("patch 1"));
  EXPECT_EQ(over.err, "transillum: the results differ by 0.25, more than the tolerance of 0.24\n");
  EXPECT_EQ(run({"a.vtp", "a.vtp", "--tolerance", "0"}).status, 0);
}

TEST_F(CliCompare, RefusesWhatCannotBeCompared) {
  const auto expect_refused = [&](const std::vector<std::string>& arguments,
                                  const std::string& what) {
    const ProgramResult refused = run(arguments);
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(line_count(refused.err), 1U);
    EXPECT_THAT(refused.err, HasSubstr(what));
  };
  SceneDescription other = squares();
  other.materials[0].reflectance = {};
  write_result(folder_ / "c.vtp", result({{}, {}, {}}, other));
  expect_refused({"a.vtp", "c.vtp"},
                 "a.vtp and c.vtp: the results are of different scenes: patch 0 has rho");
  expect_refused({"a.vtp", "missing.vtp"}, "missing.vtp");
  expect_refused({"a.csv", "b.vtp"}, "a.csv: only results in .vtp files");
  expect_refused({"a.vtp", "b.vtp", "--tolerance", "-1"}, "is less than 0");
  expect_refused({"a.vtp"}, "B");
}

}  // namespace
}  // namespace transillum::testing::result_comparison_test
