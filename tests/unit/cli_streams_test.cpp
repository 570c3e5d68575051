// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Standard output and standard error that are closed, full or pipes without a reader: messages may
// be lost, results and exit status may not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string unwritable[] = {"/dev/full", closed_stream, pipe_without_reader};

TEST(CliStreams, ASolveSavesItsResultsWithoutStderr) {
  const TemporaryFolder folder;
  // The solve is long enough for lines of progress, at most one per second, also under sanitizers.
  const std::vector<std::string> call{
      "solve", "sphere-flake:levels=1", "-m", "300", "--threads", "1", "--out"};
  const auto solve = [&](const std::string& name, const std::string& err) {
    auto arguments = call;
    arguments.push_back(folder / name);
    return run_program(arguments, {}, err);
  };
  ASSERT_EQ(solve("a.csv", {}).status, 0);
  const std::string expected = read_file(folder / "a.csv");
  for (const std::string& err : unwritable) {
    SCOPED_TRACE(err);
    EXPECT_EQ(solve("b.csv", err).status, 0);
    EXPECT_TRUE(read_file(folder / "b.csv") == expected);
    std::filesystem::remove(folder / "b.csv");
  }
}

TEST(CliStreams, TheExitStatusIsTheSameWithoutStderr) {
  const TemporaryFolder folder;
  write_text(folder / "repaired.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n");
  const std::vector<std::string> calls[] = {
      {"solve", "no-such-scene.obj"},
      {"solve", "furnace", "--no-such-option"},
      {"info", "no-such-scene.obj"},
      {"study", "furnace", "--directions", "8", "--sampling", "fibonacci", "--no-cache", "--out",
       folder / "s.csv"},
      {"solve", folder / "repaired.obj", "-m", "8"},
      {"map", folder / "repaired.obj", "--direction", "0,0,1", "--out", folder / "m.svg"},
      {"scene", folder / "repaired.obj", "--out", folder / "r.obj"},
      {"factors", folder / "repaired.obj", "-m", "8"},
      {"transfers", folder / "repaired.obj", "--direction", "0,0,1"},
      {"solve", "furnace", "-m", "9", "--memory", "1", "--scheme", "conjugate-gradients"},
      {"bounds", "--reflectance", "2"},
      {"directions", "-m", "4"},
      {}};
  for (const auto& arguments : calls) {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    const ProgramResult expected = run_program(arguments);
    EXPECT_LE(expected.status, 2);
    for (const std::string& err : unwritable) {
      SCOPED_TRACE(err);
      EXPECT_EQ(run_program(arguments, {}, err).status, expected.status);
    }
  }
}

/// Commands that print results; the last is longer than any buffer.
const std::vector<std::string> printing[] = {{"info", "furnace"},
                                             {"solve", "furnace", "-m", "8", "-q"},
                                             {"bounds"},
                                             {"directions", "-m", "4", "--stats"},
                                             {"--help"},
                                             {"--version"},
                                             {"solve", "--help"},
                                             {"transfers", "furnace", "--direction", "1,2,3"},
                                             {"factors", "furnace", "-m", "8"},
                                             {"directions", "-m", "10000"}};

TEST(CliStreams, APipeWithoutAReaderEndsThemSilently) {
  for (const auto& arguments : printing) {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    const ProgramResult result = run_program(arguments, pipe_without_reader);
    EXPECT_EQ(result.status, 0);
    // If the machine is busy, a line of progress may come.
    EXPECT_THAT(result.err, ::testing::Not(HasSubstr("transillum:")));
  }
  const Arguments named{"directions", "-m", "10000", "--out", "/dev/stdout"};
  const ProgramResult result = run_program(named, pipe_without_reader);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
}

/// The program reports another failure, whether it comes before the closed pipe or after it.
TEST(CliStreams, APipeWithoutAReaderHidesNoOtherFailure) {
  const TemporaryFolder folder;
  const std::string full = folder / "full.csv";
  std::filesystem::create_symlink("/dev/full", full);
  for (const bool before : {false, true}) {
    const Arguments out =
        before ? Arguments{"--out", full, "--out", "-"} : Arguments{"--out", "-", "--out", full};
    const ProgramResult result =
        run_program(Arguments{"solve", "furnace", "-m", "8", "-q"} + out, pipe_without_reader);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("full.csv: cannot be written"));
  }
}

TEST(CliStreams, UnwritableStandardOutputIsOneErrorWithItsReason) {
  const std::pair<std::string, std::string> targets[] = {{"/dev/full", "No space left on device"},
                                                         {closed_stream, "Bad file descriptor"}};
  for (const auto& [target, reason] : targets) {
    for (const auto& arguments : printing) {
      SCOPED_TRACE(target + ::testing::PrintToString(arguments));
      const ProgramResult result = run_program(arguments, target);
      EXPECT_EQ(result.status, 1);
      EXPECT_EQ(result.err, "transillum: standard output: cannot be written: " + reason + "\n");
    }
  }
}

/// A file must not get the number of a closed stream: messages would be written into it.
TEST(CliStreams, MessagesDoNotGetIntoFilesIfStreamsAreClosed) {
  const TemporaryFolder folder;
  const std::vector<std::string> call{"solve", "furnace", "-m", "8", "--out"};
  const auto with = [&](const std::string& file) {
    auto arguments = call;
    arguments.push_back(folder / file);
    return arguments;
  };
  expect_success(with("a.csv"));
  ASSERT_EQ(run_program(with("b.csv"), closed_stream, closed_stream).status, 0);
  EXPECT_EQ(read_file(folder / "a.csv"), read_file(folder / "b.csv"));
  EXPECT_THAT(folder.names(), ElementsAre("a.csv", "b.csv"));
}

TEST(CliStreams, AnOutputFileThatIsStandardOutputIsAppendedTo) {
  const TemporaryFolder folder;
  const std::string log = folder / "log";
  const std::string table = run_program({"directions", "-m", "4"}).out;
  for (const std::string name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    SCOPED_TRACE(name);
    write_text(log, "as it was\n");
    EXPECT_EQ(run_program({"directions", "-m", "4", "--out", name}, log).status, 0);
    EXPECT_EQ(read_file(log), "as it was\n" + table);
  }
  EXPECT_THAT(folder.names(), ElementsAre("log"));
  EXPECT_EQ(run_program({"directions", "-m", "4", "--out", "/dev/stdout"}).out, table);

  const ProgramResult closed =
      run_program({"directions", "-m", "4", "--out", "/dev/stdout"}, closed_stream);
  EXPECT_EQ(closed.status, 2);
  EXPECT_THAT(closed.err, HasSubstr("/dev/stdout: cannot be written: Bad file descriptor"));
}

}  // namespace
}  // namespace transillum::testing
