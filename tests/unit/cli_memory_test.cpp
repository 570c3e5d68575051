// transillum: diffuse light by the transillumination method. GPL-3.0-or-later. With little memory,
// few threads or a full disk, the program continues or ends with one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/program_call.h"
#include "support/sanitizers.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Sanitizers reserve terabytes of addresses, so that no limit of addresses can be set.
constexpr bool has_limits = !has_address_sanitizer && !has_thread_sanitizer;

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
  /// @param worst status: 2 where what is asked for may be refused beforehand
  static void expect_success_or_one_line(const std::vector<std::string>& arguments, int worst = 1) {
    constexpr int first = 100, last = 220, step = 2;
    for (int megabytes = first; megabytes <= last; megabytes += step) {
      SCOPED_TRACE(megabytes);
      if (run({"--version"}, megabytes).status != 0) {
        continue;  // its libraries were not loaded, or had no memory to start
      }
      const ProgramResult result = run(arguments, megabytes);
      EXPECT_LE(result.status, worst) << result.err;
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
  expect_success(solve("a.csv", "1"));
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
      {"map", "cornell-box", "--direction", "1,2,3", "--out", folder / "m.png"}, 2);
}

/// The memory that a solve takes beyond a solve that keeps nothing, MB of addresses, and its
/// result.
class KeptMemory {
 public:
  explicit KeptMemory(std::vector<std::string> solve) : solve_(std::move(solve)) {}

  /// The least limit of addresses with which the solve succeeds, MB.
  int least(int megabytes_of_option) const {
    int fails = 60, succeeds = 500;
    while (succeeds - fails > 1) {
      const int middle = (fails + succeeds) / 2;
      (run(megabytes_of_option, middle).status == 0 ? succeeds : fails) = middle;
    }
    return succeeds;
  }
  ProgramResult run(int megabytes_of_option, int limit = 4000) const {
    std::vector<std::string> arguments = solve_;
    arguments.insert(arguments.end(),
                     {"--memory", std::to_string(megabytes_of_option) + "M", "--threads", "1",
                      "--stats", folder_ / "s.json", "--out", folder_ / "b.csv", "-q"});
    // Threads that happen to wait for each other in malloc would reserve 64 MB of addresses more.
    return RunningProgram(arguments, {}, {}, {},
                          "export MALLOC_ARENA_MAX=1; ulimit -v " + std::to_string(limit * 1024))
        .wait();
  }
  bool kept() const {
    return read_file(folder_ / "s.json").find("\"kept_form_factors\": true") != std::string::npos;
  }

 private:
  TemporaryFolder folder_;
  std::vector<std::string> solve_;
};

/// With form factors as large as --memory allows, the program takes at most 1.05 times this limit
/// more than without form factors.
void expect_memory_held(const std::vector<std::string>& options) {
  SCOPED_TRACE(options.empty() ? "plain" : options.front());
  const std::vector<std::string> box{"solve", "cornell-box", "--patches",    "5000",
                                     "-m",    "96",          "--iterations", "2"};
  std::vector<std::string> solve = box;
  solve.insert(solve.end(), options.begin(), options.end());
  const KeptMemory memory(solve);
  // The least --memory with which form factors are kept: they take all of the limit.
  int dropped = 1, kept = 128;
  while (kept - dropped > std::max(1, kept / 25)) {
    const int middle = (dropped + kept) / 2;
    const bool is_kept = memory.run(middle).status == 0 && memory.kept();
    (is_kept ? kept : dropped) = middle;
  }
  ASSERT_LT(kept, 128);
  ASSERT_GT(kept, 20);
  const bool required = !options.empty() && options.back() == "symmetric";
  const int base = required ? KeptMemory(box).least(1) : memory.least(1);
  EXPECT_EQ(memory.run(kept, base + kept + kept / 20).status, 0) << base << " " << kept;
  EXPECT_TRUE(memory.kept());
  // The bound also holds while passes exceed the limit, until the form factors are dropped.
  if (!required) {
    EXPECT_EQ(memory.run(dropped, base + dropped + dropped / 20).status, 0) << dropped;
    EXPECT_FALSE(memory.kept());
  }
}

TEST_F(CliMemory, MemoryIsHeldToFivePercent) { expect_memory_held({"--replicas", "8"}); }

TEST_F(CliMemory, NightlyMemoryIsHeldToFivePercent) {
  expect_memory_held({});
  expect_memory_held({"--by", "material"});
  expect_memory_held({"--normalize", "symmetric"});
}

TEST_F(CliMemory, RecordsOfMapsAreHeldToFivePercent) {
  // Where two threads meet in malloc, glibc reserves 64 MiB of addresses for one of them: by
  // chance, and without memory.
  const auto run = [](const std::vector<std::string>& arguments, int megabytes) {
    return RunningProgram(
               arguments, {}, {}, {},
               "export MALLOC_ARENA_MAX=1; ulimit -v " + std::to_string(megabytes * 1024))
        .wait();
  };
  const TemporaryFolder folder;
  const std::string scene = "sphere-flake:levels=2";
  const auto least_limit = [&run](const std::vector<std::string>& arguments) {
    int fails = 60, succeeds = 1000;
    while (succeeds - fails > 1) {
      const int middle = (fails + succeeds) / 2;
      (run(arguments, middle).status == 0 ? succeeds : fails) = middle;
    }
    return succeeds;
  };
  const auto map = [&](int megabytes) {
    // No polygon is left to write after no step.
    return std::vector<std::string>{"map",         scene,
                                    "--step",      "0",
                                    "--memory",    std::to_string(megabytes) + "M",
                                    "--direction", "1,2,3",
                                    "--out",       folder / "m.json"};
  };
  int refused = 1, recorded = 200;
  const ProgramResult error = run(map(refused), 4000);
  EXPECT_EQ(error.status, 1);
  EXPECT_THAT(error.err,
              HasSubstr("the record of this direction exceeds the memory limit of 1.05 MB "
                        "after "));
  EXPECT_THAT(error.err, HasSubstr(" (try a larger --memory)"));
  EXPECT_THAT(folder.names(), IsEmpty());
  while (recorded - refused > 1) {
    const int middle = (refused + recorded) / 2;
    (run(map(middle), 4000).status == 0 ? recorded : refused) = middle;
  }
  ASSERT_GT(recorded, 20);
  const int base = least_limit(
      {"transfers", scene, "--engine", "local", "--direction", "1,2,3", "--out", folder / "t.csv"});
  EXPECT_EQ(run(map(recorded), base + recorded + recorded / 20).status, 0) << base << recorded;
}

TEST_F(CliMemory, ASceneThatIsTooLargeSaysWhatItNeedsBeforeItBegins) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run({"solve", "cornell-box", "--patches", "400000", "--out", folder / "a.csv"}, 500);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, ::testing::ContainsRegex(
                              "cornell-box: [0-9]+ patches take about 0.7[0-9]* GB of memory "
                              "without form factors, but only 0.[0-9]+ GB are free"));
  const ProgramResult replicas = run({"solve", "cornell-box", "--patches", "40000", "--replicas",
                                      "64", "-q", "--out", folder / "a.csv"},
                                     500);
  EXPECT_EQ(replicas.status, 1);
  EXPECT_THAT(replicas.err, HasSubstr(" patches in 64 replicas take about "));
  EXPECT_THAT(folder.names(), IsEmpty());
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
      expect_success({"study", "furnace", "-q", "--directions", "8", "--sampling", "fibonacci",
                      "--reference", "8", "--cache", "/proc/no/such/folder"});
  EXPECT_THAT(result.err, HasSubstr("the reference is not cached: /proc/no/such/folder: cannot be "
                                    "created: No such file or directory"));
}

}  // namespace
}  // namespace transillum::testing
