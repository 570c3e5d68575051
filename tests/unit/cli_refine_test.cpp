// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `solve --refine-by` as a program: its rounds, files and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/program_call.h"
#include "transillum/files.h"

namespace transillum::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

const Arguments whole_box{"solve", "cornell-box", "-m", "64"};

TEST(CliRefine, RefusesInOneLineWhatItCannotDo) {
  expect_all_refused(
      whole_box,
      {
          {{"--refine-by", "jump"}, "refine-by: requires patches"},
          {{"--refine-by", "edge", "--patches", "60"}, "choose one of jump, error"},
          {{"--refine-by", "jump", "--max-patch-area", "1"}, "refine-by: requires patches"},
          {{"--refine-until", "1%"}, "--refine-by"},
          {{"--refine-by", "jump", "--patches", "60", "--refine-until", "2"}, "--refine-until"},
          {{"--refine-by", "jump", "--patches", "60", "--seconds", "9"}, "no time limit"},
          {{"--refine-by", "jump", "--patches", "60", "--shard", "1/2", "-o", "a.tsh"}, "--shard"},
          {{"--refine-by", "jump", "--patches", "60", "--factors", "f.npz"}, "--factors"},
          {{"--refine-by", "jump", "--patches", "60", "--engine", "hemicube"}, "engine hemicube"},
      });
}

TEST(CliRefine, PrintsItsRoundsAndKeepsThemInTheStatistics) {
  const TemporaryFolder folder;
  const std::string stats = folder / "stats.json", out = folder / "out.vtp";
  for (const char* by : {"jump", "error"}) {
    const ProgramResult result = expect_success(
        whole_box + Arguments{"--refine-by", by, "--patches", "100", "--stats", stats, "-o", out});
    EXPECT_THAT(result.err,
                ContainsRegex("round 1: 27 patches, (RMS jump|L2 error) [0-9.]+ % of B"));
    const auto json = nlohmann::json::parse(std::ifstream(stats));
    EXPECT_LE(json["patches"], 100);
    EXPECT_GE(json["patches"], 97);
    ASSERT_GE(json["refinement"].size(), 2U);
    EXPECT_EQ(json["refinement"][0]["patches"], 27);
    EXPECT_GT(json["refinement"][0]["figure"], 0.1);
    EXPECT_EQ(read_result(out).scene->patch_count(), json["patches"]);
  }
}

/// The last solve is of an ordinary scene, and so is its result; its checkpoint can be resumed.
TEST(CliRefine, GoesOnFromItsCheckpoint) {
  const TemporaryFolder folder;
  const std::string whole = folder / "whole.csv", resumed = folder / "resumed.csv",
                    checkpoint = folder / "run.tck";
  const Arguments refined = whole_box + Arguments{"--refine-by", "jump", "--patches", "60"};
  expect_success(refined + Arguments{"-o", whole, "--checkpoint", checkpoint});
  const ProgramResult again =
      expect_success(refined + Arguments{"-o", resumed, "--checkpoint", checkpoint, "--resume"});
  EXPECT_THAT(again.err, HasSubstr("resumes after"));
  EXPECT_EQ(read_file(whole), read_file(resumed));
}

}  // namespace
}  // namespace transillum::testing
