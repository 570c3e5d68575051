// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum shading`, and the sun of `solve`: tables, times, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/program_call.h"

namespace transillum::cli_shading_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A roof named roof, and a wall below it that faces south.
std::string house_obj() {
  return "v 0 0 3\nv 4 0 3\nv 4 4 3\nv 0 4 3\nv 0 0 0\nv 4 0 0\nv 4 0 3\nv 0 0 3\n"
         "g roof\nf 1 2 3 4\ng south wall\nf 5 6 7 8\n";
}

std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      rows.back().push_back(cell);
    }
  }
  return rows;
}

class CliShading : public ::testing::Test {
 protected:
  CliShading() { write_text(file_, house_obj()); }
  Arguments day(const std::string& from, const std::string& to) const {
    return {"shading", file_, "--up", "0,0,1", "--from", from, "--to", to};
  }

  TemporaryFolder folder_;
  std::string file_ = folder_ / "house.obj";
};

TEST_F(CliShading, HasARowPerStepOfAYearInTheMiddleOfTheStep) {
  const auto rows = rows_of(expect_success(day("2026-01-01+01:00", "2026-12-31+01:00") +
                                           Arguments{"--site", "52.5,13.4", "--by", "group"})
                                .out);
  ASSERT_EQ(rows.size(), 8761U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"time", "roof", "south wall"}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"2026-01-01 00:30", "0", "0"}));
  EXPECT_EQ(rows[12], (std::vector<std::string>{"2026-01-01 11:30", "1", "1"}));
  EXPECT_EQ(rows.back()[0], "2026-12-31 23:30");
  // In summer the sun rises behind the wall.
  EXPECT_EQ(rows[1 + 24 * 171 + 5], (std::vector<std::string>{"2026-06-21 05:30", "1", "0"}));
}

TEST_F(CliShading, StepsOfTenMinutesAndPolarDays) {
  const auto night = rows_of(expect_success(day("2026-12-21Z", "2026-12-21Z") +
                                            Arguments{"--site", "78.2,15.6", "--step", "10m"})
                                 .out);
  const auto bright = rows_of(expect_success(day("2026-06-21Z", "2026-06-21Z") +
                                             Arguments{"--site", "78.2,15.6", "--step", "10m"})
                                  .out);
  ASSERT_EQ(night.size(), 145U);
  for (std::size_t k = 1; k < night.size(); ++k) {
    EXPECT_EQ(night[k][1], "0");
    EXPECT_EQ(bright[k][1], "1");
  }
  EXPECT_EQ(night[1][0], "2026-12-21 00:05");
}

TEST_F(CliShading, WritesFractionsOfTheSky) {
  const std::string out = folder_ / "s.csv", sky = folder_ / "sky.csv";
  expect_success(day("2026-06-21Z", "2026-06-21Z") +
                 Arguments{"--site", "52.5,13.4", "--out", out, "--sky-out", sky, "-m", "256"});
  const auto rows = rows_of(read_file(sky));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_NEAR(std::stod(rows[1][1]), 1, 1e-9);
  EXPECT_NEAR(std::stod(rows[2][1]), 0.5, 0.01);
}

void expect_wrong_call(const Arguments& arguments, const std::string& message) {
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr(message));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(CliShading, RefusesTimesWithoutZoneAndScenesWithoutVertical) {
  const Arguments site{"--site", "52.5,13.4"};
  expect_wrong_call(day("2026-06-21", "2026-06-21Z") + site, "it has no zone");
  expect_wrong_call(day("2026-06-21Z", "2026-06-20Z") + site, "366 days");
  expect_wrong_call(day("2026-06-21Z", "2026-06-21Z"), "requires --site");
  expect_wrong_call(
      Arguments{"shading", file_, "--from", "2026-06-21Z", "--to", "2026-06-21Z"} + site,
      "vertical");
  expect_wrong_call(day("2026-06-21Z", "2026-06-21Z") + site + Arguments{"--step", "7m"}, "--step");
  const Arguments solve{"solve", file_, "-m", "16"};
  expect_wrong_call(solve + Arguments{"--sun", "180,40,900"}, "vertical");
  expect_wrong_call(solve + site + Arguments{"--time", "2026-06-21T14:00", "--up", "0,0,1"},
                    "it has no zone");
  expect_wrong_call(solve + Arguments{"--sun-irradiance", "900"}, "sun");
}

TEST_F(CliShading, SolvesWithTheSunByAnglesOrPlaceAndAtNight) {
  const auto h = [&](const Arguments& sun) {
    const auto rows = rows_of(
        expect_success(Arguments{"solve", file_, "-m", "16", "--out", "-", "-q"} + sun).out);
    return std::pair(std::stod(rows.at(1).at(12)), std::stod(rows.at(2).at(12)));
  };
  const auto [roof, wall] = h({"--sun", "180,30,1000", "--up", "0,0,1"});
  EXPECT_NEAR(roof, 500, 1e-9);
  EXPECT_NEAR(wall, 1000 * std::sqrt(0.75), 1e-9);
  EXPECT_EQ(h({"--sun-direction", "0,0,1", "--sun-irradiance", "1000"}).first, 1000);
  const Arguments nrel{"--site", "39.742476,-105.1786", "--sun-irradiance", "1000", "--up",
                       "0,0,1"};
  EXPECT_NEAR(h(nrel + Arguments{"--time", "2003-10-17T12:30:30-07:00"}).first,
              1000 * std::sin(39.872046 * std::acos(-1) / 180), 0.05);
  EXPECT_EQ(h(nrel + Arguments{"--time", "2003-10-17T23:30:30-07:00"}).first, 0);
}

}  // namespace
}  // namespace transillum::cli_shading_test
