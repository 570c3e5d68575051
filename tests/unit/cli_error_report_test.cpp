// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `solve --error-report` and `--total` as a program: their files, lines and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const Arguments measured_box{"solve", "cornell-box", "-m", "64"};

TEST(CliErrorReport, RefusesInOneLineWhatItCannotMeasure) {
  expect_all_refused(
      measured_box,
      {
          {{"--error-report", "e.txt"}, "must end in .html or .json"},
          {{"--error-report", "-"}, "name a file"},
          {{"--error-report", "no-folder/e.json"}, "no-folder"},
          {{"--error-report", "e.json", "--engine", "hemicube"}, "engine hemicube"},
          {{"--error-report", "e.json", "--scheme", "semi-iterative"}, "scheme semi-iterative"},
          {{"--error-report", "e.json", "--stats", "e.json"}, "given twice"},
          {{"--error-report", "e.json", "--shard", "1/2", "-o", "a.tsh"}, "with shards"},
      });
}

// A scene without lobes is solved as without --glossy, as in the window.
TEST(CliErrorReport, RefusesOnlyLobesThatTakePart) {
  const TemporaryFolder folder;
  const Arguments glossy{"--glossy", "--accuracy", "50%", "--total"};
  for (const Arguments& options :
       {glossy, Arguments{"--glossy", "-m", "8", "--error-report", folder / "errors.json"}}) {
    expect_refused(Arguments{"solve", "gallery"} + options, "not available with lobes");
    const ProgramResult solved = expect_success(Arguments{"solve", "cornell-box"} + options);
    EXPECT_THAT(solved.err, HasSubstr("--glossy changes nothing"));
    EXPECT_THAT(solved.out, HasSubstr("error in all"));
  }
}

TEST(CliErrorReport, AddsUpTheFourErrorsOfEachSurface) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      measured_box + Arguments{"--replicas", "4", "--error-report", folder / "errors.json"});
  EXPECT_THAT(result.out, ContainsRegex("error in all +red: [0-9.]+ % = [0-9.]+ % directions"));
  EXPECT_THAT(result.out, ContainsRegex("next step +divide red: 30 patches, .* % to .* %"));
  const auto json = read_json(folder / "errors.json");
  double largest = 0;
  for (const auto& surface : json["surfaces"]) {
    const auto& errors = surface["errors"];
    const double sum = errors["directions"].get<double>() + errors["patches"].get<double>() +
                       errors["iterations"].get<double>() + errors["method"].get<double>();
    EXPECT_NEAR(errors["total"].get<double>(), sum, 1e-12);
    largest = std::max(largest, sum);
  }
  EXPECT_NEAR(json["total"].get<double>(), largest, 1e-12);
  EXPECT_EQ(json["measurements"]["replicas_added"], false);
  EXPECT_EQ(json["steps"][0]["kind"], "divide-surface");
}

TEST(CliErrorReport, WritesAPageThatLoadsNothing) {
  const TemporaryFolder folder;
  expect_success(measured_box + Arguments{"-q", "--error-report", folder / "errors.html"});
  const std::string page = read_file(folder / "errors.html");
  EXPECT_THAT(page, HasSubstr("How wrong is it? cornell-box"));
  EXPECT_THAT(page, HasSubstr("<li>divide red: 30 patches"));
  EXPECT_THAT(page, HasSubstr("the solve was repeated"));
  for (const char* outside : {"<script", "http", "src=", "@import"}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
}

TEST(CliTotal, RefusesInOneLineWhatItCannotDo) {
  expect_all_refused(
      {"solve", "cornell-box", "--total"},
      {
          {{"-m", "64"}, "used only with an accuracy"},
          {{"--accuracy", "20%", "--accuracy-of", "rms"}, "an error of surfaces"},
          {{"--accuracy", "20%", "--seconds", "5"}, "no time limit"},
          {{"--accuracy", "20%", "--refine-by", "jump", "--patches", "60"}, "no rounds"},
          {{"--accuracy", "20%", "--series", "a.pvd"}, "an accuracy"},
          {{"--accuracy", "20%", "--shard", "1/2", "-o", "a.tsh"}, "with shards"},
      });
}

TEST(CliTotal, DividesPatchesUntilTheSumIsAsAsked) {
  const TemporaryFolder folder;
  const ProgramResult result =
      expect_success({"solve", "cornell-box", "--accuracy", "25%", "--total", "--out",
                      folder / "box.csv", "--error-report", folder / "errors.json"});
  EXPECT_THAT(result.err, ContainsRegex("stage 1: 27 patches, [0-9]+ passes, .* % of red"));
  EXPECT_THAT(result.err, ContainsRegex("total error +25 % asked, reached; [0-9] stages"));
  const auto json = read_json(folder / "errors.json");
  EXPECT_LE(json["total"].get<double>(), 0.25);
  EXPECT_EQ(line_count(read_file(folder / "box.csv")), json["patches"].get<std::size_t>() + 1);
}

TEST(CliTotal, SaysWhyItEnds) {
  const ProgramResult result =
      expect_success({"solve", "cornell-box", "--accuracy", "10%", "--total", "--patches", "60"});
  EXPECT_THAT(result.out,
              ContainsRegex("total error +10 % asked, not reached with at most 60 patches"));
}

}  // namespace
}  // namespace transillum::testing
