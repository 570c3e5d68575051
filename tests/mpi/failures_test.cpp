// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// transillum-mpi with bad input, interrupted, and with a process that is killed; and the commands
// that only the first process runs.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sstream>

#include "mpi_call.h"
#include "support/sanitizers.h"
#include "support/wait_until.h"

namespace transillum {
namespace {

using ::testing::HasSubstr;
using testing::mpi_command;
using testing::operator+;
using testing::read_file;
using testing::run_mpi;
using testing::RunningProgram;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using testing::wait_until;
using Words = std::vector<std::string>;

/// Lines that the program has printed; lines of mpirun begin otherwise.
Words messages(const std::string& err) {
  Words lines;
  std::istringstream text(err);
  for (std::string line; std::getline(text, line);) {
    if (line.find("transillum: ") != std::string::npos) {
      lines.push_back(line);
    }
  }
  return lines;
}

std::vector<pid_t> children_of(pid_t pid) {
  const std::string number = std::to_string(pid);
  std::istringstream list(read_file("/proc/" + number + "/task/" + number + "/children"));
  return {std::istream_iterator<pid_t>(list), {}};
}

/// Seconds of processor time that a process has used.
double cpu_seconds(pid_t pid) {
  const std::string stat = read_file("/proc/" + std::to_string(pid) + "/stat");
  std::istringstream fields(stat.substr(std::min(stat.size(), stat.rfind(')') + 2)));
  std::string skipped;
  for (int k = 0; k < 11; ++k) {
    fields >> skipped;
  }
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// A solve that would take minutes.
Words long_solve(const std::string& out) {
  return {"solve", "sphere-flake:levels=2", "-m", "16384", "--sampling", "hammersley", "--out",
          out};
}

bool shows_passes(const RunningProgram& run) {
  const std::string err = run.err_so_far(), label = "iteration 1, pass ";
  const std::size_t last = err.rfind(label);
  return last != std::string::npos && err.size() > last + label.size() &&
         err[last + label.size()] != '0';
}

TEST(Failures, BadInputIsOneMessage) {
  for (const Words& words :
       {Words{"solve", "cornell-box", "--directionz", "4"}, Words{"solve", "no-such-file.obj"},
        Words{"solve"}, Words{"sovle"}, Words{"solve", "cornell-box", "-m", "0"},
        Words{"solve", "cornell-box", "-m", "4", "--out", "/no/folder.csv"}}) {
    const auto run = run_mpi(3, words);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(messages(run.err), ::testing::SizeIs(1)) << run.err;
    EXPECT_EQ(run.out, "");
  }
}

TEST(Failures, AreThoseOfTheProgramAlone) {
  const Words words{"solve", "cornell-box", "--scheme", "conjugate-gradients", "--memory", "1k"};
  const auto run = run_mpi(3, words);
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("exceed the memory limit (try a larger --memory)"));
  EXPECT_THAT(messages(run.err), ::testing::SizeIs(1)) << run.err;
}

TEST(Failures, TheFirstProcessRunsOtherCommands) {
  const Words words{"bounds", "cornell-box", "-m", "64"};
  const auto shared = run_mpi(3, words), alone = testing::run_alone(words);
  EXPECT_EQ(shared.status, 0) << shared.err;
  EXPECT_EQ(shared.out, alone.out);
  const auto help = run_mpi(3, {"solve", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.out, testing::run_alone({"solve", "--help"}).out);
  // -q: mpirun of Open MPI 5 loses parts of standard output while a process writes messages, too.
  const Words by_pairs{"solve", "cornell-box", "--engine", "pairs", "--out", "-", "-q"};
  const auto pairs = run_mpi(2, by_pairs);
  EXPECT_EQ(pairs.status, 0) << pairs.err;
  EXPECT_EQ(pairs.out, testing::run_alone(by_pairs).out);
}

TEST(Failures, WaitingProcessesLeaveTheirCores) {
  const TemporaryFolder folder;
  // Engine pairs runs only in the first process, and takes long.
  RunningProgram run(mpi_command(
      2, {"solve", "sphere-flake:levels=2", "--engine", "pairs", "-q", "--out", folder / "b.csv"}));
  std::vector<pid_t> ranks;
  ASSERT_TRUE(wait_until([&] {
    ranks = children_of(run.pid());
    return ranks.size() == 2 && std::max(cpu_seconds(ranks[0]), cpu_seconds(ranks[1])) > 2;
  }));
  EXPECT_LT(std::min(cpu_seconds(ranks[0]), cpu_seconds(ranks[1])), 1);
  run.send(SIGTERM);
  run.wait();
}

TEST(Failures, InterruptionSavesTheEstimate) {
  // Seconds from mpirun's SIGTERM to its SIGKILL; one second is too short on a busy machine.
  const char* patience = testing::has_thread_sanitizer ? "60" : "3";
  ASSERT_EQ(::setenv("OMPI_MCA_odls_base_sigkill_timeout", patience, 1), 0);
  // mpirun of Open MPI 5 passes on no more text once it ends the processes.
  const bool passes_on_last_messages =
      testing::run_program({TRANSILLUM_MPIRUN, "--version"}).out.find("(Open MPI) 5.") ==
      std::string::npos;
  for (const int signal : {SIGUSR1, SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    RunningProgram run(mpi_command(3, long_solve(folder / "b.csv")));
    ASSERT_TRUE(wait_until([&] { return shows_passes(run); })) << run.err_so_far();
    run.send(signal);
    const auto result = run.wait();
    // Other signals end mpirun itself.
    EXPECT_EQ(result.status, signal == SIGUSR1 ? 130 : 1) << result.err;
    if (signal == SIGUSR1 || passes_on_last_messages) {
      EXPECT_THAT(result.err, HasSubstr("transillum: interrupted; the results so far are saved"));
    }
    EXPECT_THAT(read_file(folder / "b.csv"), StartsWith("face,patch,"));
    EXPECT_EQ(folder.names(), Words{"b.csv"});
  }
}

TEST(Failures, AKilledProcessEndsTheOthers) {
  const TemporaryFolder folder;
  RunningProgram run(mpi_command(3, long_solve(folder / "b.csv")));
  ASSERT_TRUE(wait_until([&] { return shows_passes(run); })) << run.err_so_far();
  const std::vector<pid_t> ranks = children_of(run.pid());
  ASSERT_EQ(ranks.size(), 3u);
  ::kill(ranks[1], SIGKILL);
  const auto result = run.wait();
  EXPECT_EQ(result.status, 137) << result.err;
  // Open MPI 4 and 5 break this line at different words.
  EXPECT_THAT(result.err, ::testing::ContainsRegex("exited on[ \n]signal 9"));
  EXPECT_EQ(folder.names(), Words{});
  EXPECT_TRUE(wait_until([&] { return ::kill(ranks[0], 0) != 0 && ::kill(ranks[2], 0) != 0; }));
}

TEST(Failures, NeedNoRoot) {
  if (::geteuid() != 0) {
    EXPECT_EQ(run_mpi(3, {"solve", "cornell-box", "-m", "16", "--out", "-", "-q"}).status, 0);
    return;
  }
  const Words nobody_runs{"setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups"};
  if (testing::run_program(nobody_runs + Words{"test", "-x", TRANSILLUM_MPI_PROGRAM}).status != 0) {
    GTEST_SKIP() << "others than root cannot reach " << TRANSILLUM_MPI_PROGRAM;
  }
  const TemporaryFolder folder;
  constexpr int nobody = 65534;
  ASSERT_EQ(::chown(folder.path().c_str(), nobody, nobody), 0);
  const Words command =
      mpi_command(3, {"solve", "cornell-box", "-m", "16", "--out", folder / "b.csv", "-q"});
  const auto run =
      testing::run_program(Words{"-u", "OMPI_ALLOW_RUN_AS_ROOT", "HOME=" + folder.path().string()} +
                               nobody_runs + command,
                           {}, {}, folder.path());
  EXPECT_EQ(run.status, 0) << run.err;
  struct stat file = {};
  ASSERT_EQ(::stat((folder / "b.csv").c_str(), &file), 0);
  EXPECT_EQ(file.st_uid, static_cast<uid_t>(nobody));
}

}  // namespace
}  // namespace transillum
