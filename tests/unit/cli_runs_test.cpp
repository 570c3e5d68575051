// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `solve --checkpoint`, `--resume` and `--shard`, `merge` and `study --checkpoint` as programs:
// kills, full disks and wrong calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "support/program_call.h"
#include "support/wait_until.h"

namespace transillum::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A solve of about a second, unless the options choose the directions.
Arguments solve(const std::string& out, const Arguments& options = {}) {
  const bool chosen = std::any_of(options.begin(), options.end(), [](const std::string& option) {
    return option == "-m" || option == "--accuracy";
  });
  return Arguments{"solve", "cornell-box", "--max-patch-area", "0.02", "--out", out} +
         (chosen ? Arguments{} : Arguments{"-m", "900"}) + options;
}

/// Identifies the file that a path names now; it changes whenever the file is replaced.
std::tuple<ino_t, time_t, long> identity_of(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0
             ? std::tuple(status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec)
             : std::tuple(ino_t{0}, time_t{0}, 0L);
}

/// Waits until the file has been replaced at least so many times, or the program is over.
void wait_for_saves(const RunningProgram& program, const std::string& file, int times) {
  auto before = identity_of(file);
  int seen = 0;
  EXPECT_TRUE(wait_until([&] {
    const auto now = identity_of(file);
    seen += now != before ? 1 : 0;
    before = now;
    return seen >= times || program.ended();
  }));
}

/// Waits until the program begins to write a file in the folder, or is over.
void wait_for_writing(const RunningProgram& program, const TemporaryFolder& folder) {
  const int events = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  ASSERT_GE(::inotify_add_watch(events, folder.path().c_str(), IN_CREATE), 0);
  pollfd created{events, POLLIN, 0};
  constexpr int longest_ms = 10;
  EXPECT_TRUE(wait_until([&] { return ::poll(&created, 1, longest_ms) > 0 || program.ended(); }));
  ::close(events);
}

/// Kills a solve with SIGKILL after random numbers of saves, every second time during one, `kills`
/// times, and lets it finish.
void expect_kills_change_nothing(int kills, const Arguments& options, unsigned seed) {
  const TemporaryFolder folder;
  expect_success(solve(folder / "whole.csv", options));
  std::mt19937 random(seed);
  const Arguments again = options + Arguments{"--checkpoint", folder / "run.tck",
                                              "--checkpoint-every", "0", "--resume"};
  int resumed = 0;
  for (int k = 0; k < kills; ++k) {
    RunningProgram program(solve(folder / "killed.csv", again));
    wait_for_saves(program, folder / "run.tck", 1 + static_cast<int>(random() % 16));
    if (k % 2 == 1) {
      wait_for_writing(program, folder);
    }
    program.send(SIGKILL);
    resumed += program.wait().err.find("resumes after") != std::string::npos ? 1 : 0;
    // There are only complete files, whenever the kill came. Between the call that names a file and
    // the call that replaces the previous file by it, the file has its own name.
    for (const std::string& name : folder.names()) {
      EXPECT_THAT(name, ::testing::AnyOf("whole.csv", "killed.csv", "run.tck",
                                         ::testing::StartsWith(".transillum-")));
    }
  }
  EXPECT_EQ(resumed, kills - 1);  // all but the first: each has saved before it was killed
  expect_success(solve(folder / "killed.csv", again));
  EXPECT_EQ(read_file(folder / "whole.csv"), read_file(folder / "killed.csv"));
}

TEST(CliRuns, KillsAtRandomMomentsChangeNoBit) {
  expect_kills_change_nothing(8, {}, 1);
  expect_kills_change_nothing(4, {"--scheme", "semi-iterative", "-m", "60", "--iterations", "20"},
                              2);
  expect_kills_change_nothing(4, {"--accuracy", "1%"}, 3);
  expect_kills_change_nothing(3, {"--accuracy", "25%", "--total"}, 7);
}

TEST(CliRuns, NightlyFiftyKillsChangeNoBit) {
  expect_kills_change_nothing(50, {}, 4);
  expect_kills_change_nothing(50, {"--replicas", "4", "--threads", "1"}, 5);
  expect_kills_change_nothing(50, {"--accuracy", "0.5%"}, 6);
  expect_kills_change_nothing(50, {"--accuracy", "15%", "--total"}, 8);
}

/// A file that may not grow stands for a disk that is full.
TEST(CliRuns, AFullDiskCostsTheCheckpointNotTheSolve) {
  const TemporaryFolder folder;
  const Arguments options{"--checkpoint", folder / "run.tck", "--checkpoint-every", "0", "-q"};
  expect_success(solve(folder / "whole.csv"));
  const ProgramResult full =
      RunningProgram(solve(folder / "a.csv", options), {}, {}, {}, "trap '' XFSZ; ulimit -f 60")
          .wait();
  EXPECT_EQ(full.status, 0) << full.err;
  EXPECT_THAT(full.err, HasSubstr("warning: the checkpoint could not be saved: "));
  EXPECT_EQ(read_file(folder / "a.csv"), read_file(folder / "whole.csv"));
}

TEST(CliRuns, ACheckpointIsSavedAtTheEndAndWhenInterrupted) {
  const TemporaryFolder folder;
  const Arguments keep{"--checkpoint", folder / "run.tck"};
  const ProgramResult whole = expect_success(solve(folder / "a.csv", keep));
  EXPECT_THAT(whole.err, ::testing::ContainsRegex("run.tck: [0-9.]+ [kM]B, saved once in"));
  const ProgramResult again = run_program(solve(folder / "b.csv", keep + Arguments{"--resume"}));
  EXPECT_THAT(again.err, HasSubstr("resumes after"));
  EXPECT_EQ(read_file(folder / "a.csv"), read_file(folder / "b.csv"));

  const Arguments keep_long{"-m", "100000", "--checkpoint", folder / "long.tck", "--resume"};
  RunningProgram interrupted(solve(folder / "c.csv", keep_long));
  ASSERT_TRUE(interrupted.reports("passes/s")) << interrupted.err_so_far();
  interrupted.send(SIGINT);
  EXPECT_EQ(interrupted.wait().status, 130);
  EXPECT_THAT(folder.names(), ElementsAre("a.csv", "b.csv", "c.csv", "long.tck", "run.tck"));
}

TEST(CliRuns, WrongCallsOfCheckpointsAreRefused) {
  const TemporaryFolder folder;
  write_text(folder / "there.tck", "mine");
  const auto refused = [&](const Arguments& options, const std::string& expected) {
    expect_refused(solve(folder / "a.csv", options), expected);
  };
  refused({"--checkpoint", folder / "there.tck"}, "there.tck: there is such a file already");
  refused({"--resume"}, "--checkpoint");
  refused({"--checkpoint", folder / "a.tck", "--engine", "pairs"},
          "--checkpoint: not used with engine pairs");
  refused({"--checkpoint", folder / "no/a.tck"}, "there is no folder");
  refused({"--checkpoint", folder / "a.csv"}, "given twice");
  // The message about the number of patches comes first.
  const ProgramResult other =
      run_program(solve(folder / "a.csv", {"--checkpoint", folder / "there.tck", "--resume"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("there.tck: it is not a checkpoint of transillum"));
  EXPECT_EQ(read_file(folder / "there.tck"), "mine");
  EXPECT_THAT(folder.names(), ElementsAre("there.tck"));
}

TEST(CliRuns, ShardsMergeToTheBitsOfOneSolve) {
  const TemporaryFolder folder;
  const Arguments options{"--replicas",   "3",    "-m",      "99",          "--sky",
                          "10",           "--up", "-.5,0,1", "--sky-model", "cie-overcast",
                          "--first-shot", "auto"};
  expect_success(solve(folder / "whole.csv", options));
  Arguments parts;
  for (const char* share : {"1/3", "2/3", "3/3"}) {
    parts.push_back(folder / ("part" + std::string(1, share[0]) + ".tsh"));
    const ProgramResult made =
        expect_success(solve(parts.back(), options + Arguments{"--shard", share}));
    EXPECT_THAT(made.err, HasSubstr(std::string("share ") + share + " of the passes, 33 of 99"));
  }
  const ProgramResult merged =
      expect_success(Arguments{"merge"} + parts +
                     Arguments{"--out", folder / "merged.csv", "--stats", folder / "merged.json"});
  EXPECT_EQ(read_file(folder / "whole.csv"), read_file(folder / "merged.csv"));

  // Notes about the scene may come before these messages.
  const Refusal refusals[] = {
      {{parts[0], parts[2]}, "shards are missing: 2/3"},
      {{parts[0], parts[0]}, "part1.tsh: it is share 1/3, as is"},
      {parts + Arguments{"--scene", "furnace"}, "of another scene"},
      {{folder / "whole.csv"}, "it is not a shard of transillum"},
      {parts + Arguments{"--out", parts[0]}, "part1.tsh: a shard is written with --shard"}};
  for (const auto& [arguments, expected] : refusals) {
    SCOPED_TRACE(expected);
    const ProgramResult result =
        run_program(Arguments{"merge", "--out", folder / "none.csv"} + arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr(expected));
  }
  EXPECT_THAT(folder.names(), Not(::testing::Contains("none.csv")));
}

TEST(CliRuns, WrongCallsOfShardsAreRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& out, const Arguments& options,
                           const std::string& expected) {
    expect_refused(solve(folder / out, options), expected);
  };
  refused("a.csv", {"--shard", "1/2"}, "requires --out FILE.tsh");
  refused("a.tsh", {}, "a shard is written with --shard K/N");
  refused("a.tsh", {"--shard", "3/2"}, "\"3/2\" is not a share");
  refused("a.tsh", {"--shard", "1/2", "--stats", folder / "s.json"},
          "--stats: not used with --shard; `merge` takes it");
  refused("a.tsh", {"--shard", "1/2", "--accuracy", "1%"}, "accuracy");
  refused("a.tsh", {"--shard", "1/2", "--scheme", "semi-iterative"}, "semi-iterative");
  EXPECT_THAT(folder.names(), ElementsAre());
}

TEST(CliRuns, AStudyGoesOnAfterItsPoints) {
  const TemporaryFolder folder;
  const Arguments study{"study",     "cornell-box", "-m",           "16..64",        "--sampling",
                        "fibonacci", "--no-cache",  "--checkpoint", folder / "s.tck"};
  expect_success(study + Arguments{"--out", folder / "a.csv"});
  const ProgramResult again =
      expect_success(study + Arguments{"--resume", "--out", folder / "b.csv"});
  EXPECT_THAT(again.err, HasSubstr("resumes after 3 points"));
  EXPECT_EQ(read_file(folder / "a.csv"), read_file(folder / "b.csv"));
  const ProgramResult other =
      run_program(study + Arguments{"--resume", "--rotations", "2", "--out", folder / "c.csv"});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("rotations is 1 there and 2 here"));
}

}  // namespace
}  // namespace transillum::testing
