// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "support/program_call.h"
#include "support/wait_until.h"

namespace transillum::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A solve of many minutes on a scene that loads quickly, with directions that are computed quickly
/// even under sanitizers.
std::vector<std::string> long_solve(const TemporaryFolder& folder) {
  return {"solve", "rooms",          "-m",      "1000000",        "--max-patch-area", "0.2",
          "--out", folder / "a.csv", "--stats", folder / "a.json"};
}

/// Part of a progress line, which is written during the passes.
const char* const passes_made = "passes/s";

/// Programs inherit ignored signals: this program may have been started in the background.
class CliInterruption : public ::testing::Test {
 protected:
  CliInterruption() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      before_.emplace_back(signal, ::signal(signal, SIG_DFL));
    }
  }
  void TearDown() override {
    for (const auto& [signal, disposition] : before_) {
      ::signal(signal, disposition);
    }
  }

 private:
  std::vector<std::pair<int, sighandler_t>> before_;
};

TEST_F(CliInterruption, SavesResultsSoFarAndExitsWith130) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    RunningProgram program(long_solve(folder));
    ASSERT_TRUE(program.reports(passes_made)) << program.err_so_far();
    program.send(signal);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted; the results so far are saved"));
    EXPECT_THAT(result.err, ContainsRegex("warning: interrupted in the first iteration, after "
                                          "[0-9]+ passes: B lacks light that is reflected"));
    EXPECT_THAT(folder.names(), ElementsAre("a.csv", "a.json"));
    const auto json = read_json(folder / "a.json");
    EXPECT_FALSE(json.at("complete"));
    EXPECT_EQ(json.at("iterations"), 0);
    EXPECT_TRUE(json.at("energy_defect").is_null());
    EXPECT_EQ(line_count(read_file(folder / "a.csv")), 1 + json.at("patches").get<std::size_t>());
  }
}

/// After `nohup`, closing the terminal changes nothing; a script may ignore Ctrl-C likewise.
TEST_F(CliInterruption, IgnoredSignalsStayIgnored) {
  // Sanitizers would complain about a library that is loaded before their own.
  const std::string with_catching_library =
      "; export ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD='" TRANSILLUM_CATCHING_LIBRARY "'";
  for (const std::string& environment : {std::string(), with_catching_library}) {
    const TemporaryFolder folder;
    RunningProgram program(long_solve(folder), {}, {}, {}, "trap '' INT HUP" + environment);
    ASSERT_TRUE(program.reports(passes_made)) << program.err_so_far();
    EXPECT_TRUE(program.catches(SIGTERM));
    EXPECT_FALSE(program.catches(SIGINT)) << environment;
    EXPECT_FALSE(program.catches(SIGHUP)) << environment;
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().status, 130);
  }
}

// Measuring so many random directions takes a minute or so.
TEST_F(CliInterruption, BoundsReportWhatIsUnderWay) {
  RunningProgram program(
      {"bounds", "--sampling", "random", "--reflectance", "0.5", "-m", "16777216"});
  ASSERT_TRUE(program.reports("quadrature error")) << program.err_so_far();
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("quadrature error, under way for "));
}

// A pass of engine global takes minutes on large scenes; nothing was shown before the first ended.
TEST_F(CliInterruption, ReportsThatTheFirstPassIsUnderWay) {
  RunningProgram program({"solve", "sphere-flake", "--engine", "global", "--two-sided", "-m", "2"});
  const std::string expected = "iteration 1, pass 0/2, 0 %, next pass under way for ";
  ASSERT_TRUE(program.reports("pass ")) << program.err_so_far();
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr(expected));
}

TEST_F(CliInterruption, WritesNothingBeforeTheFirstPass) {
  const TemporaryFolder folder;
  RunningProgram program({"solve", "sphere-flake:levels=3", "--out", folder / "a.csv"});
  ASSERT_TRUE(wait_until([&] { return program.catches(SIGINT) || program.ended(); }));
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_THAT(folder.names(), ::testing::IsEmpty());
}

/// B requires the complete matrix.
TEST_F(CliInterruption, EnginesWithoutDirectionsSaveNothingAndReportWhy) {
  struct Case {
    std::vector<std::string> options;
    const char *progress, *message;
  };
  for (const Case& of : {Case{{"--engine", "hemicube", "--resolution", "1024"},
                              "hemicubes",
                              "% of the hemicubes were drawn, but B requires all of them"},
                         Case{{"--engine", "pairs", "--points", "64"},
                              "pairs/s",
                              "% of the pairs were computed, but B requires all of them"}}) {
    const TemporaryFolder folder;
    RunningProgram program(Arguments{"solve", "sphere-flake:levels=1", "--out", folder / "a.csv"} +
                           of.options);
    ASSERT_TRUE(program.reports(of.progress)) << program.err_so_far();
    program.send(SIGINT);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_THAT(result.err, HasSubstr(of.message));
    EXPECT_THAT(folder.names(), ::testing::IsEmpty());
  }
}

}  // namespace
}  // namespace transillum::testing
