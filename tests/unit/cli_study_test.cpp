// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum study`, run as a process: CSV, plots, cached references, errors and interruption.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(CliStudy, WritesTheDocumentedTable) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      {"study", "furnace", "--directions", "8..32", "--sampling", "random,hammersley", "--one-way",
       "--two-way", "--reference", "64", "--no-cache", "--out", folder / "s.csv", "--plot",
       folder / "s.svg", "--plot", folder / "s.png", "--plot", folder / "s.pdf"});
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("slope"));
  EXPECT_THAT(folder.names(), ElementsAre("s.csv", "s.pdf", "s.png", "s.svg"));
  EXPECT_THAT(read_file(folder / "s.pdf"), StartsWith("%PDF-"));
  const auto lines = lines_of(read_file(folder / "s.csv"));
  ASSERT_THAT(lines, SizeIs(1 + 4 * 3));
  EXPECT_EQ(lines[0],
            "sampling,directions,passes,rms_error,max_error,bound,seconds,engine,resolution");
  EXPECT_THAT(lines[1], StartsWith("random/one-way,8,8,"));
  EXPECT_THAT(lines[6], StartsWith("random/two-way,64,32,"));
  EXPECT_THAT(lines[12], StartsWith("hammersley/two-way,64,32,"));
}

TEST(CliStudy, ComparesEngines) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      {"study", "furnace", "--directions", "8,16", "--sampling", "fibonacci,hammersley",
       "--engines", "fast,zbuffer:64,corrected,hemicube,hemicube:16,pairs:4,pairs:8", "--reference",
       "64", "--no-cache", "--out", folder / "s.csv", "--plot", folder / "s.svg", "--against",
       "seconds"});
  EXPECT_THAT(result.err, HasSubstr("12 hemicubes of 768 pixels"));
  const auto lines = lines_of(read_file(folder / "s.csv"));
  // Samplings and numbers of directions do not apply to hemicubes.
  ASSERT_THAT(lines, SizeIs(1 + 2 * 3 * 2 + 2 + 2));
  EXPECT_THAT(result.err, HasSubstr("the pairs of 12 patches, 8 points"));
  EXPECT_THAT(lines, Contains(AllOf(StartsWith("pairs:4,4,12,"), EndsWith(",pairs,4"))));
  EXPECT_THAT(lines,
              Contains(AllOf(StartsWith("fibonacci/zbuffer:64,32,16,"), EndsWith(",zbuffer,64"))));
  EXPECT_THAT(lines,
              Contains(AllOf(StartsWith("hammersley/corrected,"), EndsWith(",corrected,0"))));
  EXPECT_THAT(lines, Contains(AllOf(StartsWith("hemicube:16,768,12,"), EndsWith(",hemicube,16"))));
  EXPECT_THAT(read_file(folder / "s.svg"), Not(HasSubstr("nan")));
}

TEST(CliStudy, CachesReferences) {
  const TemporaryFolder folder;
  const auto study = [&](const Arguments& more) {
    const ProgramResult result =
        expect_success(Arguments{"study", "furnace", "--directions", "8", "--sampling", "fibonacci",
                                 "--reference", "16", "--cache", folder / "cache"} +
                       more);
    return result.out.substr(0, result.out.find("slope"));
  };
  const std::string table = study({});
  ASSERT_THAT(folder.names(), ElementsAre("cache"));
  EXPECT_EQ(study({}), table);
}

TEST(CliStudy, InvalidArgumentsGiveOneLineAndStatus2) {
  expect_all_refused(
      {"study"},
      {
          {{}, "SCENE is required"},
          {{"furnace", "--directions", "16,"}, "--directions: \"\""},
          {{"furnace", "--directions", "16,0"}, "--directions: \"0\""},
          {{"furnace", "--directions", "64..16"}, "not an increasing range"},
          {{"furnace", "--directions", "16..32,32"}, "given twice"},
          {{"furnace", "--sampling", "random,fibonaci"}, "unknown sampling \"fibonaci\""},
          {{"furnace", "--sampling", "random,random"}, "given twice"},
          {{"furnace", "--normalize", "symmetric", "--one-way"}, "two-way passes"},
          {{"furnace", "--scheme", "quick"}, "fixed, growing"},
          {{"furnace", "--first-shot", "auto,soon"}, "none, auto or a number"},
          {{"furnace", "--error", "least"}, "rms, max"},
          {{"furnace", "--engines", "fast,fest"}, "unknown engine \"fest\""},
          {{"furnace", "--engines", "fast,fast"}, "given twice"},
          {{"furnace", "--engines", "zbuffer:0"}, "\"0\""},
          {{"furnace", "--engines", "hemicube:63"}, "63 is not an even number"},
          {{"furnace", "--engines", "hemicube", "--scheme", "growing"}, "no directions"},
          {{"furnace", "--against", "time"}, "passes, seconds"},
          {{"furnace", "--rotations", "0"}, "--rotations: \"0\""},
          {{"furnace", "--reference", "0"}, "--reference: \"0\""},
          {{"furnace", "--no-cache", "--cache", "x"}, "excludes"},
          {{"furnace", "--plot", "s.eps"}, "must end in .svg, .pdf or .png"},
          {{"furnace", "--out", "s.svg", "--plot", "s.svg"}, "given twice"},
          {{"furnace", "--out", "/no/such/folder/s.csv"}, "/no/such/folder"},
      });
}

TEST(CliStudy, SkipsInvalidCombinations) {
  const ProgramResult result = expect_success(
      {"study", "furnace", "--directions", "8", "--sampling", "fibonacci", "--one-way", "--two-way",
       "--normalize", "none,symmetric", "--reference", "16", "--no-cache"});
  EXPECT_THAT(result.err, HasSubstr("skipped: normalize: symmetric requires two-way"));
  EXPECT_THAT(result.out, HasSubstr("fibonacci/two-way/symmetric"));
  EXPECT_THAT(result.out, Not(HasSubstr("one-way/symmetric")));
}

TEST(CliStudy, ComparesWithAndWithoutAFirstShot) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      {"study", "stars", "--directions", "16", "--sampling", "fibonacci", "--first-shot",
       "none,1000,auto", "--without-sources", "--error", "max", "--reference", "64", "--no-cache"});
  EXPECT_THAT(result.out, StartsWith("Largest error of B in %, by number of passes"));
  EXPECT_THAT(result.out, HasSubstr("fibonacci/no-shot"));
  EXPECT_THAT(result.out, HasSubstr("fibonacci/first-shot 1000"));
  EXPECT_THAT(result.out, HasSubstr("fibonacci/first-shot auto"));
}

TEST(CliStudy, SavesPointsSoFarWhenInterrupted) {
  const TemporaryFolder folder;
  RunningProgram program({"study", "rooms", "--max-patch-area", "0.2", "--directions", "1,1000000",
                          "--sampling", "fibonacci", "--reference", "4", "--no-cache", "--out",
                          folder / "s.csv"});
  ASSERT_TRUE(program.reports("fibonacci, 1000000 passes")) << program.err_so_far();
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted; the points so far are saved"));
  EXPECT_EQ(line_count(read_file(folder / "s.csv")), 2U);
}

}  // namespace
}  // namespace transillum::testing
