// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve of several processes is kept in a checkpoint of the usual format, from which any number
// of processes continues to the same bits.
#include <gmock/gmock.h>
#include <signal.h>

#include "mpi_call.h"
#include "support/wait_until.h"

namespace transillum {
namespace {

using testing::operator+;
using testing::read_file;
using testing::run_alone;
using testing::run_mpi;
using testing::RunningProgram;
using testing::TemporaryFolder;
using Words = std::vector<std::string>;

testing::ProgramResult run_in(int processes, const Words& words) {
  return processes == 1 ? run_alone(words) : run_mpi(processes, words);
}

/// Interrupts a solve in `first` processes once it has been saved, and continues it in others.
void expect_same_after_resuming(const Words& scheme, int first, const std::vector<int>& then) {
  const TemporaryFolder folder;
  const auto command = [&](const Words& more) {
    return Words{"solve", "cornell-box", "-q"} + scheme + more;
  };
  const auto whole = run_alone(command({"--out", folder / "whole.csv"}));
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::string checkpoint = folder / "run.ckpt";
  {
    RunningProgram run(
        testing::mpi_command(first, command({"--checkpoint", checkpoint, "--checkpoint-every",
                                             "0.001", "--out", folder / "cut.csv"})));
    ASSERT_TRUE(testing::wait_until([&] {
      return std::filesystem::exists(checkpoint) || run.ended();
    })) << run.err_so_far();
    run.send(SIGKILL);
    run.wait();
  }
  for (const int processes : then) {
    SCOPED_TRACE(processes);
    const std::string copy = folder / "copy.ckpt";
    std::filesystem::copy_file(checkpoint, copy, std::filesystem::copy_options::overwrite_existing);
    const auto resumed = run_in(
        processes, command({"--checkpoint", copy, "--resume", "--out", folder / "resumed.csv"}));
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_THAT(resumed.err, ::testing::HasSubstr("resumes after"));
    EXPECT_TRUE(read_file(folder / "resumed.csv") == read_file(folder / "whole.csv"));
  }
}

TEST(MpiCheckpoint, GoesOnInAnotherNumberOfProcesses) {
  expect_same_after_resuming({"-m", "600"}, 3, {3, 2, 1});
}

TEST(MpiCheckpoint, OneWayAndReplicas) {
  expect_same_after_resuming({"-m", "600", "--one-way", "--replicas", "3"}, 2, {3, 1});
}

TEST(MpiCheckpoint, SemiIterative) {
  expect_same_after_resuming({"-m", "64", "--scheme", "semi-iterative", "--iterations", "20"}, 2,
                             {3});
}

}  // namespace
}  // namespace transillum
