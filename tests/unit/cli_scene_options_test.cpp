// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Options of scenes on the command line: lights, reflectances, defaults, scale, numbers of patches;
// scenes without light; CSV on standard output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string corpus = std::string(TRANSILLUM_DATA_DIR) + "/corpus/";

/// Status 2 and one line; warnings may come before it.
void expect_scene_refused(const std::vector<std::string>& arguments, const std::string& expected) {
  SCOPED_TRACE(::testing::PrintToString(arguments));
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(expected));
}

/// A column of CSV text, from the first patch on.
std::vector<std::string> column(const std::string& csv, std::size_t number) {
  std::vector<std::string> values;
  std::istringstream lines(csv);
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (std::size_t k = 0; k <= number; ++k) {
      std::getline(cells, cell, ',');
    }
    values.push_back(cell);
  }
  return values;
}

constexpr std::size_t area_column = 2, exitance_column = 3, reflectance_column = 6, b_column = 9;

TEST(CliSceneOptions, WithoutLightSolveNamesTheRemedy) {
  const std::string remedy =
      "no-materials.obj: nothing emits light, so B would be 0 everywhere; "
      "give a material, a group or a face an exitance in W/m2, such as "
      "--emission 'light=10'";
  expect_scene_refused({"solve", corpus + "no-materials.obj", "-m", "8"}, remedy);
  expect_scene_refused({"study", corpus + "no-materials.obj", "-m", "8", "--no-cache"}, remedy);
  expect_scene_refused({"solve", corpus + "no-materials.obj", "--engine", "hemicube"}, remedy);
  const std::string scene = corpus + "no-materials.obj";
  for (const std::vector<std::string>& call : std::vector<std::vector<std::string>>{
           {"info", scene},
           {"factors", scene, "-m", "8"},
           {"transfers", scene, "--direction", "0,0,1"},
           {"map", scene, "--direction", "0,0,1", "--out", "/dev/null.svg"}}) {
    const ProgramResult result = run_program(call);
    EXPECT_THAT(result.err, Not(HasSubstr("nothing emits"))) << call[0];
  }
}

TEST(CliSceneOptions, TheNamedRemedyWorks) {
  const ProgramResult result = expect_success(
      {"solve", corpus + "no-materials.obj", "-q", "-m", "8", "--emission", "light=10", "-o", "-"});
  const std::vector<std::string> exitances = column(result.out, exitance_column);
  EXPECT_EQ(exitances, (std::vector<std::string>{"0", "0", "0", "0", "0", "10"}));
  EXPECT_GT(std::stod(column(result.out, b_column)[0]), 0);
}

TEST(CliSceneOptions, LightsAndReflectancesAreGivenSeveralTimes) {
  const ProgramResult result = expect_success(
      {"solve", corpus + "materials.obj", "-q", "-m", "8", "--out=-", "--emission", "face:0=1,2,3",
       "--emission", "lights of the ceiling=4", "--reflectance", "room=.25", "--reflectance",
       "face:1=.125", "--default-reflectance", ".75", "--max-reflectance", ".9"});
  const auto exitances = column(result.out, exitance_column);
  const auto reflectances = column(result.out, reflectance_column);
  EXPECT_EQ(exitances[0], "1");
  EXPECT_EQ(exitances[5], "4");
  EXPECT_EQ(reflectances[0], "0.25");
  EXPECT_EQ(reflectances[1], "0.125");
  EXPECT_EQ(reflectances[7], "0.75") << "a texture that is not found";
  EXPECT_THAT(result.err, HasSubstr("walls.mtl:2: material `white`: reflectance rho (Kd) 1 1 "
                                    "0.9999999 is lowered to 0.9"));
}

TEST(CliSceneOptions, UnknownNamesAreRefused) {
  expect_scene_refused({"solve", "cornell-box", "--emission", "ligh=1"}, "did you mean \"light\"?");
  expect_scene_refused({"info", "furnace", "--emission", "face:99=1"}, "there is no face 99");
  expect_scene_refused({"scene", "furnace", "--out", "x.obj", "--reflectance", "1"},
                       "--reflectance: `1` is not NAME=VALUE or NAME=RED,GREEN,BLUE");
  expect_scene_refused({"solve", "furnace", "--reflectance", "face:0=1"}, "must be >= 0 and < 1");
  expect_scene_refused({"solve", "furnace", "--default-reflectance", "1"},
                       "--default-reflectance: \"1\" is not at least 0 and below 1");
  expect_scene_refused({"solve", "furnace", "--max-reflectance", "-1"},
                       "--max-reflectance: \"-1\"");
  expect_scene_refused({"solve", "furnace", "--scale", "0"},
                       "--scale: \"0\" is not greater than 0");
  expect_scene_refused({"solve", "furnace", "--units", "yd"}, "choose one of mm, cm, m, in, ft");
  expect_scene_refused({"solve", "furnace", "--units", "mm", "--scale", "2"}, "excludes");
  expect_scene_refused({"solve", "furnace", "--patches", "20", "--max-patch-area", "2"},
                       "excludes");
  expect_scene_refused({"solve", "furnace", "--patches", "0"}, "--patches: \"0\"");
  expect_scene_refused({"bounds", "--patches", "10"}, "--patches: used only with a SCENE");
}

TEST(CliSceneOptions, LengthsAreScaled) {
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--scale", "0.01"}, {"--units", "cm"}}) {
    const ProgramResult result = expect_success(
        Arguments{"solve", corpus + "materials.obj", "-q", "-m", "8", "-o", "-"} + option);
    EXPECT_NEAR(std::stod(column(result.out, area_column)[0]), 1e-4, 1e-18);
  }
}

TEST(CliSceneOptions, TheNumberOfPatchesIsToldBeforeTheyAreMade) {
  const ProgramResult result =
      expect_success({"solve", "cornell-box", "-m", "8", "--patches", "2000", "-o", "-"});
  const auto patches = static_cast<double>(line_count(result.out) - 1);
  EXPECT_NEAR(patches, 2000, 100);
  EXPECT_THAT(result.err, StartsWith("transillum: " + std::to_string(line_count(result.out) - 1) +
                                     " patches of at most "));
  EXPECT_THAT(result.err,
              AllOf(HasSubstr(" m2; about "), HasSubstr(" MB of memory without form factors")));
  const std::string cube = std::string(TRANSILLUM_DATA_DIR) + "/scenes/cube.obj";
  EXPECT_THAT(
      run_program({"transfers", cube, "--direction", "0,0,1", "--max-patch-area", ".5"}).err,
      StartsWith("transillum: 12 patches of at most 0.5 m2; about "));
  const ProgramResult few =
      run_program({"solve", "furnace", "-m", "8", "--patches", "5", "-o", "-"});
  EXPECT_EQ(line_count(few.out), 13U);
  EXPECT_THAT(few.err, HasSubstr("warning: --patches: the faces make 12 patches already, more than "
                                 "5"));
}

TEST(CliSceneOptions, SceneWritesTheChangedScene) {
  const TemporaryFolder folder;
  expect_success({"scene", corpus + "materials.obj", "--units", "mm", "--emission", "room=2",
                  "--out", folder / "s.obj"});
  EXPECT_THAT(read_file(folder / "s.obj"),
              AllOf(HasSubstr("g room\n"), HasSubstr("g lights of the ceiling\n"),
                    HasSubstr("g default\n"), HasSubstr("v 0.001 ")));
  const ProgramResult again = run_program({"solve", folder / "s.obj", "-m", "8", "-q", "-o", "-"});
  EXPECT_EQ(again.err, run_program({"solve", folder / "s.obj", "-m", "8", "-q", "-o", "-"}).err);
  const ProgramResult direct = run_program({"solve", corpus + "materials.obj", "--units", "mm",
                                            "-m", "8", "-q", "--emission", "room=2", "-o", "-"});
  EXPECT_EQ(again.out, direct.out) << "bit for bit";
}

TEST(CliSceneOptions, CoveredFacesAreNamed) {
  const TemporaryFolder folder;
  const ProgramResult result =
      expect_success({"solve", corpus + "coincident.obj", "-m", "8", "--emission", "face:2=1",
                      "--stats", folder / "s.json", "-o", "-"});
  EXPECT_THAT(
      result.err,
      HasSubstr("coincident.obj:6: face 0: covered by a face on the same points: it gets no "
                "light (B = E)"));
  EXPECT_THAT(read_file(folder / "s.json"), HasSubstr("\"covered_faces\": [\n    0\n  ]"));
}

TEST(CliStandardOutput, TakesTheCsvOfOut) {
  const TemporaryFolder folder;
  const ProgramResult file =
      expect_success({"solve", "furnace", "-m", "8", "-o", folder / "r.csv", "-o", "-"});
  EXPECT_EQ(file.out, read_file(folder / "r.csv")) << "nothing else is mixed with it";
  EXPECT_THAT(file.err, HasSubstr("B mean, W/m2"));
  const std::vector<std::vector<std::string>> calls{
      {"transfers", "furnace", "--direction", "0,0,1"},
      {"factors", "furnace", "-m", "8"},
      {"directions", "-m", "8"}};
  for (std::vector<std::string> call : calls) {
    const std::string expected = run_program(call).out;
    call.insert(call.end(), {"--out", "-"});
    EXPECT_EQ(run_program(call).out, expected) << call[0];
  }
  EXPECT_THAT(run_program({"study", "furnace", "-m", "8", "--no-cache", "-q", "-o", "-"}).out,
              StartsWith("sampling,directions,passes"));
}

TEST(CliStandardOutput, IsRefusedWhereTextsWouldMix) {
  expect_scene_refused({"solve", "furnace", "-m", "8", "--stats", "-"},
                       "--stats: standard output (-) takes only the CSV of --out");
  expect_scene_refused({"solve", "furnace", "-m", "8", "-o", "-", "-o", "-"},
                       "--out: standard output (-) is given twice");
  expect_scene_refused({"directions", "-m", "8", "-o", "-", "--stats"},
                       "--out: standard output takes");
  expect_scene_refused({"scene", "furnace", "--out", "-"}, "must end in .obj");
  expect_scene_refused({"map", "furnace", "--direction", "0,0,1", "--out", "-"}, "must end in");
}

}  // namespace
}  // namespace transillum::testing
