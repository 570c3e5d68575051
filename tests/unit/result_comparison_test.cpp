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
using ::testing::Not;

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
Solution result(const std::vector<Rgb>& reflected, const SceneDescription& description = squares(),
                const SceneOptions& options = {}) {
  Solution solution;
  solution.scene = std::make_shared<const Scene>(description, options);
  for (const Rgb& light : reflected) {
    const auto i = static_cast<PatchId>(solution.radiosity.size());
    solution.radiosity.push_back(light + solution.scene->exitance(i));
  }
  solution.irradiance.resize(reflected.size());
  return solution;
}

/// Squares that do not emit.
SceneDescription dark_squares() {
  SceneDescription description = squares();
  description.materials[0].exitance = {};
  return description;
}

TEST(ResultComparison, FindsTheKnownDifferencesTheWorstSurfaceFirst) {
  const Solution a = result({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}});
  const Solution b = result({{1, 1, 1.6}, {2, 3, 2}, {4, 4, 4}});
  const ResultComparison comparison = compare_results(a, b);
  ASSERT_EQ(comparison.surfaces.size(), 3U);
  const SurfaceDifference& low = comparison.surfaces[0];
  const SurfaceDifference& middle = comparison.surfaces[1];
  EXPECT_EQ(low.name, "low");
  EXPECT_DOUBLE_EQ(low.level, 1);
  EXPECT_DOUBLE_EQ(low.rms, 0.6);
  EXPECT_DOUBLE_EQ(low.largest, 0.6);
  EXPECT_EQ(low.worst, 0);
  EXPECT_EQ(middle.name, "middle");
  EXPECT_DOUBLE_EQ(middle.rms, 0.5);
  EXPECT_EQ(middle.second, (Rgb{3, 4, 3}));
  EXPECT_EQ(comparison.surfaces[2].name, "no group");
  EXPECT_EQ(comparison.surfaces[2].worst, no_patch);
  EXPECT_DOUBLE_EQ(comparison.rms, std::sqrt(1.0 / (1 + 4 + 16)));
}

/// A dim surface that is wrong by its own level disappears in the RMS over everything.
TEST(ResultComparison, PutsADimSurfaceFirstThatIsWrongByItsOwnLevel) {
  const Solution a = result({{100, 100, 100}, {1, 1, 1}, {100, 100, 100}}, dark_squares());
  const Solution b = result({{101, 101, 101}, {2, 2, 2}, {100, 100, 100}}, dark_squares());
  const ResultComparison comparison = compare_results(a, b);
  EXPECT_EQ(comparison.surfaces.front().name, "middle");
  EXPECT_DOUBLE_EQ(comparison.surfaces.front().rms, 1);
  EXPECT_FALSE(comparison.surfaces.front().is_dark);
  EXPECT_LT(comparison.rms, 0.02);
}

TEST(ResultComparison, MeasuresASurfaceInTheDarkByAThousandthOfTheBrightest) {
  const Solution a = result({{1000, 1000, 1000}, {1e-6, 1e-6, 1e-6}, {10, 10, 10}}, dark_squares());
  Solution b = a;
  b.radiosity[1] = {0.1, 0.1, 0.1};
  const SurfaceDifference dark = compare_results(a, b).surfaces.front();
  EXPECT_EQ(dark.name, "middle");
  EXPECT_TRUE(dark.is_dark);
  EXPECT_EQ(dark.unit, (Rgb{1, 1, 1}));
  EXPECT_NEAR(dark.rms, 0.1, 1e-5);
}

/// Sources are omitted, however bright, and so are surfaces of sources only.
TEST(ResultComparison, OmitsSources) {
  SceneDescription description = dark_squares();
  description.materials.push_back(description.materials[0]);
  description.materials[1].exitance = {1e6, 1e6, 1e6};
  description.face_material = {0, 0, 1};
  description.face_group = {0, 1, 2};
  const Solution a = result({{1, 1, 1}, {1, 1, 1}, {4, 4, 4}}, description);
  const Solution b = result({{1, 1, 1}, {1.5, 1.5, 1.5}, {5, 5, 5}}, description);
  const ResultComparison comparison = compare_results(a, b);
  ASSERT_EQ(comparison.surfaces.size(), 2U);
  EXPECT_EQ(comparison.surfaces[0].name, "unused");
  EXPECT_DOUBLE_EQ(comparison.surfaces[0].rms, 0.5);
  EXPECT_DOUBLE_EQ(comparison.rms, std::sqrt(0.125));
  EXPECT_EQ(comparison.units, (std::vector<Rgb>{{1, 1, 1}, {1, 1, 1}, {}}));
}

/// A lamp that is switched off in one of two runs is a lamp.
TEST(ResultComparison, OmitsWhatEmitsInEither) {
  const Scene scene(dark_squares());
  const PatchLight on{{{5, 5, 5}, {}, {}}, {{6, 6, 6}, {2, 2, 2}, {2, 2, 2}}};
  const PatchLight off{{{}, {}, {5, 5, 5}}, {{1, 1, 1}, {1, 1, 1}, {6, 6, 6}}};
  const ResultComparison comparison = compare_light(scene, on, off);
  ASSERT_EQ(comparison.surfaces.size(), 1U);
  EXPECT_EQ(comparison.surfaces[0].name, "middle");
  EXPECT_DOUBLE_EQ(comparison.surfaces[0].rms, 0.5);
  EXPECT_DOUBLE_EQ(comparison.rms, 0.5);
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
  EXPECT_EQ(compare_results(dark, dark).rms, 0);
  EXPECT_EQ(compare_results(bright, bright).surfaces.front().largest, 0);
  EXPECT_EQ(compare_results(dark, bright).rms, HUGE_VAL);
  EXPECT_EQ(compare_results(dark, bright).surfaces.front().largest, HUGE_VAL);
  EXPECT_EQ(compare_results(bright, dark).surfaces.front().largest, 1);
}

TEST(ResultComparison, IsRelativeForLightOfAnyStrength) {
  for (const double strength : {1e-170, 1.0, 1e170}) {
    const Rgb one = strength * Rgb{1, 1, 1};
    const Solution a = result({one, one, one}, dark_squares()),
                   b = result({one, one, 1.5 * one}, dark_squares());
    EXPECT_NEAR(compare_results(a, b).rms, std::sqrt(0.25 / 3), 1e-15);
    EXPECT_NEAR(compare_results(a, b).surfaces.front().rms, 0.5, 1e-15);
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

TEST_F(CliCompare, NamesTheWorstSurfaceFirstAndTheRmsOverAllLast) {
  const ProgramResult compared = run({"a.vtp", "b.vtp"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_EQ(compared.err, "");
  EXPECT_THAT(compared.out, HasSubstr("patches            3\n"
                                      "worst surface      middle: 50 % RMS\n"
                                      "largest there      50 %, patch 1 (face 1, material m0, "
                                      "group middle)\n"));
  EXPECT_THAT(compared.out, ::testing::ContainsRegex("\nmiddle +1 +50 % +50 % +patch 1\n"
                                                     "low +1 +0 % +0 %"));
  EXPECT_THAT(compared.out, HasSubstr("no group"));
  EXPECT_THAT(compared.out,
              ::testing::EndsWith("RMS over all       21.82 % of the RMS of reflected "
                                  "light\n"));
  EXPECT_THAT(compared.out, Not(HasSubstr("dark")));
}

TEST_F(CliCompare, SaysWhichSurfacesAreInTheDark) {
  const std::vector<Rgb> light{{1000, 1000, 1000}, {}, {10, 10, 10}};
  Solution one = result(light, dark_squares()), other = one;
  other.radiosity[1] = {0.1, 0.1, 0.1};
  write_result(folder_ / "one.vtp", one);
  write_result(folder_ / "other.vtp", other);
  const std::string text = run({"one.vtp", "other.vtp"}).out;
  EXPECT_THAT(text, HasSubstr("middle: 10 % RMS of a thousandth of the brightest surface"));
  EXPECT_THAT(text, ::testing::ContainsRegex("middle .*patch 1 \\(dark\\)\n"));
  EXPECT_THAT(text, HasSubstr("\n(dark): relative to a thousandth of the level"));
}

TEST_F(CliCompare, ExitsWith1IfTheWorstSurfaceIsOverTheTolerance) {
  EXPECT_EQ(run({"a.vtp", "b.vtp", "--tolerance", "0.501"}).status, 0);
  EXPECT_EQ(run({"a.vtp", "b.vtp", "--tolerance", "50.1%"}).status, 0);
  const ProgramResult over = run({"a.vtp", "b.vtp", "--tolerance", "0.28"});
  EXPECT_EQ(over.status, 1);
  EXPECT_THAT(over.out, HasSubstr("patch 1"));
  EXPECT_EQ(over.err,
            "transillum: the results of surface \"middle\" differ by 50 %, more than the "
            "tolerance of 28 %\n");
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
  expect_refused({"a.vtp", "c.vtp", "--functions"},
                 "a.vtp and c.vtp: the results are of different scenes: face 0 has rho 0.5 0.5 0.5 "
                 "in one and 0 0 0 in the other");
  write_result(folder_ / "halves.vtp",
               result(std::vector<Rgb>(6), squares(), {.max_patch_area = 0.5}));
  expect_refused({"a.vtp", "halves.vtp"},
                 "one has 3 patches and the other 6; --functions compares results whose patches "
                 "alone differ\n");
  EXPECT_EQ(run({"a.vtp", "halves.vtp", "--functions"}).status, 0);
  write_result(folder_ / "black-halves.vtp",
               result(std::vector<Rgb>(6), other, {.max_patch_area = 0.5}));
  expect_refused({"a.vtp", "black-halves.vtp"}, "one has 3 patches and the other 6\n");
  expect_refused({"a.vtp", "missing.vtp"}, "missing.vtp");
  expect_refused({"a.csv", "b.vtp"}, "a.csv: only results in .vtp files");
  expect_refused({"a.vtp", "b.vtp", "--tolerance", "-1"}, "is less than 0");
  expect_refused({"a.vtp"}, "B");
}

}  // namespace
}  // namespace transillum::testing::result_comparison_test
