// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The program with little memory, few threads or a full disk: it goes on, or ends with one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program_run.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Sanitizers reserve terabytes of addresses, so that no limit of addresses can be set.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_limits = false;
#else
constexpr bool has_limits = true;
#endif

class CliMemory : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_limits) {
      GTEST_SKIP() << "built with a sanitizer";
    }
  }
  static ProgramResult run(const std::vector<std::string>& arguments, int megabytes) {
    return RunningProgram(arguments, {}, {}, {}, "ulimit -v " + std::to_string(megabytes * 1024))
        .wait();
  }
  /// Runs with more and more memory: from where the program starts at all to where it succeeds.
  static void expect_success_or_one_line(const std::vector<std::string>& arguments) {
    constexpr int first = 100, last = 220, step = 2;
    for (int megabytes = first; megabytes <= last; megabytes += step) {
      SCOPED_TRACE(megabytes);
      if (run({"--version"}, megabytes).status != 0) {
        continue;  // its libraries were not loaded, or had no memory to start
      }
      const ProgramResult result = run(arguments, megabytes);
      EXPECT_LE(result.status, 1) << result.err;
      EXPECT_EQ(line_count(result.err), result.status == 0 ? 0U : 1U) << result.err;
    }
  }
};

TEST_F(CliMemory, ThreadsThatDoNotStartAreDoneWithout) {
  const TemporaryFolder folder;
  const auto solve = [&](const std::string& name, const std::string& threads) {
    return std::vector<std::string>{"solve", "cornell-box", "-q",        "-m",   "16",
                                    "--out", folder / name, "--threads", threads};
  };
  ASSERT_EQ(run_program(solve("a.csv", "1")).status, 0);
  const ProgramResult result = run(solve("b.csv", "200"), 500);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(read_file(folder / "b.csv"), read_file(folder / "a.csv"));
}

TEST_F(CliMemory, ASolveSucceedsOrEndsWithOneLine) {
  expect_success_or_one_line({"solve", "cornell-box", "-q", "-m", "16", "--threads", "8"});
}

TEST_F(CliMemory, ExactNumbersSucceedOrEndWithOneLine) {
  expect_success_or_one_line(
      {"solve", "cornell-box", "-q", "--engine", "global", "-m", "4", "--threads", "2"});
}

TEST_F(CliMemory, PicturesSucceedOrEndWithOneLine) {
  const TemporaryFolder folder;
  expect_success_or_one_line(
      {"map", "cornell-box", "--direction", "1,2,3", "--out", folder / "m.png"});
}

TEST(CliFullDisk, TheReasonOfAFailedSceneIsGiven) {
  const TemporaryFolder folder;
  // A limit of the size of files fails in the same place as a full disk.
  const ProgramResult result = RunningProgram({"scene", "sphere-flake", "--out", folder / "s.obj"},
                                              {}, {}, {}, "ulimit -f 8")
                                   .wait();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(line_count(result.err), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("s.obj: cannot be written: File too large"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(CliFullDisk, ACacheThatCannotBeCreatedIsAWarning) {
  const ProgramResult result =
      run_program({"study", "furnace", "-q", "--directions", "8", "--sampling", "fibonacci",
                   "--reference", "8", "--cache", "/proc/no/such/folder"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("the reference is not cached: /proc/no/such/folder: cannot be "
                                    "created: No such file or directory"));
}

}  // namespace
}  // namespace transillum::testing
