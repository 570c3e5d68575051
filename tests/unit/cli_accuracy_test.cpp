// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum solve --accuracy` and `--seconds`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program_call.h"
#include "transillum/files.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;

TEST(CliAccuracy, ChoosesPassesAndReportsWhatItReached) {
  const TemporaryFolder folder;
  const ProgramResult result =
      expect_success({"solve", "rooms", "--accuracy", "0.5%", "--first-shot", "none", "--stats",
                      folder / "s.json"});
  EXPECT_THAT(result.out, HasSubstr("0.5 % asked, reached: error of the worst surface, "));
  const auto json = read_json(folder / "s.json");
  const auto& accuracy = json.at("accuracy");
  EXPECT_TRUE(accuracy.at("reached"));
  EXPECT_EQ(accuracy.at("asked"), 0.005);
  EXPECT_LE(accuracy.at("error").get<double>(), 0.005);
  EXPECT_EQ(accuracy.at("error"), json.at("error_estimate").at("by_surface").at("limit"));
  EXPECT_EQ(accuracy.at("stages").back().at("directions"), json.at("passes"));
  EXPECT_LE(json.at("error_estimate").at("rms_lowest"), json.at("error_estimate").at("rms"));
}

/// A lamp of 5 mm has a million times the B of the walls. Both solves once ended after one
/// iteration, with B of the walls 64 % and 51 % too small.
TEST(CliAccuracy, IsNotMeasuredByASmallLamp) {
  const TemporaryFolder folder;
  const std::string lamp = std::string(TRANSILLUM_DATA_DIR) + "/corpus/small-lamp.obj";
  const auto walls = [&](const std::vector<std::string>& options) {
    expect_success(Arguments{"solve", lamp, "-q", "--out", folder / "b.vtp"} + options);
    std::vector<Rgb> b = read_result(folder / "b.vtp").radiosity;
    b.resize(6);
    return b;
  };
  const std::vector<Rgb> truth = walls({"--engine", "pairs", "--tolerance", "1e-9"});
  const std::vector<Rgb> plain = walls({}), accurate = walls({"--accuracy", "0.1%"});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(plain[i].r / truth[i].r, 1, 0.01) << i;
    EXPECT_NEAR(accurate[i].r / truth[i].r, 1, 0.003) << i;
  }
}

/// The first shot is made automatically, unless the option is given.
TEST(CliAccuracy, ShootsLampsFirst) {
  const TemporaryFolder folder;
  const ProgramResult shot = expect_success({"solve", "cornell-box", "--max-patch-area", "0.03",
                                             "--accuracy", "0.01", "--stats", folder / "s.json"});
  const auto json = read_json(folder / "s.json");
  EXPECT_EQ(json.at("options").at("first-shot"), "auto");
  EXPECT_GT(json.at("first_shot").at("sources"), 0);
  EXPECT_EQ(json.at("light_directions"), 0);
}

TEST(CliAccuracy, EndsWithTheTime) {
  const ProgramResult result = expect_success({"solve", "furnace", "--seconds", "0.2"});
  EXPECT_THAT(result.out,
              HasSubstr("within the time given, time is up: error of the worst surface, "));
}

TEST(CliAccuracy, SaysWhyItEnds) {
  const TemporaryFolder folder;
  const auto ends = [&](std::vector<std::string> arguments, const char* obstacle,
                        const char* text) {
    arguments.insert(arguments.begin(), "solve");
    arguments.insert(arguments.end(), {"--stats", folder / "s.json"});
    EXPECT_THAT(expect_success(arguments).out, HasSubstr(text));
    EXPECT_EQ(read_json(folder / "s.json").at("accuracy").at("obstacle"), obstacle);
  };
  ends({"furnace", "--seconds", "60", "--most-passes", "40"}, "passes",
       "within the time given, ended with at most 40 passes");
  ends({"furnace", "--seconds", "0.2"}, "seconds", "time is up");
  ends({"cornell-box", "--accuracy", "0.001%", "--most-passes", "100", "--first-shot", "none"},
       "passes", "not reached with at most 100 passes");
  ends({"cornell-box", "--accuracy", "0.000001%", "--first-shot", "0"}, "first-shot",
       "not reached because the first shot is less accurate than asked");
}

TEST(CliAccuracy, OfEnginePairsTakesPoints) {
  const ProgramResult result =
      expect_success({"solve", "boards", "--engine", "pairs", "--accuracy", "0.1%"});
  EXPECT_THAT(result.out, HasSubstr("0.1 % asked, reached: estimated error"));
}

TEST(CliAccuracy, WarnsWhereItCannotBeTrusted) {
  const ProgramResult result = expect_success({"solve", "stars", "-m", "64", "--replicas", "4",
                                               "--max-patch-area", "1", "--first-shot", "none"});
  EXPECT_THAT(result.err, HasSubstr("the error estimate cannot be trusted"));
  EXPECT_THAT(result.err, HasSubstr("--first-shot 0"));
}

TEST(CliAccuracy, CountsPatchesWhoseErrorsCannotBeTrusted) {
  const TemporaryFolder folder;
  const ProgramResult result =
      expect_success({"solve", "stars", "-m", "512", "--replicas", "4", "--first-shot", "none",
                      "--stats", folder / "s.json"});
  const auto json = read_json(folder / "s.json");
  const auto& count = json.at("error_estimate").at("uncertain_patches");
  EXPECT_GT(count, 0);
  EXPECT_THAT(result.err, HasSubstr("standard errors of " + count.dump() + " patches cannot be"));
}

TEST(CliAccuracy, RefusesWhatItCannotKeep) {
  expect_all_refused(
      {"solve", "furnace", "-q"},
      {
          {{"--accuracy", "0"}, "--accuracy: \"0\" is not a percentage"},
          {{"--accuracy", "100%"}, "--accuracy: \"100%\" is not"},
          {{"--accuracy", "1 percent"}, "--accuracy: \"1 percent\" is not"},
          {{"--accuracy", "1%", "-m", "64"}, "--directions: not used with an accuracy"},
          {{"--accuracy", "1%", "--replicas", "8"}, "--replicas: not used with an accuracy"},
          {{"--accuracy", "1%", "--iterations", "3"}, "number of iterations"},
          {{"--accuracy", "1%", "--scheme", "growing"}, "growing"},
          {{"--accuracy", "1%", "--engine", "painter"}, "engine painter"},
          {{"--accuracy", "1%", "--engine", "hemicube"}, "accuracy"},
          {{"--accuracy", "1%", "--accuracy-of", "patch:99999"}, "there is no patch 99999"},
          {{"--accuracy", "1%", "--accuracy-of", "best"},
           "--accuracy-of: \"best\" is not surfaces"},
          {{"-m", "8", "--accuracy-of", "max"}, "--accuracy-of: used only with an accuracy"},
          {{"--seconds", "0"}, "--seconds: \"0\" is not greater than 0"},
          {{"--seconds", "nan"}, "--seconds"},
      });
}

}  // namespace
}  // namespace transillum::testing
