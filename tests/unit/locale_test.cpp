// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A decimal comma in the process's locale changes neither input nor output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>

#include "base/json_text.h"
#include "base/text_file.h"
#include "io/drawing/line_chart.h"
#include "io/results/study_csv.h"
#include "support/comma_locale.h"
#include "support/program_call.h"
#include "support/refusal.h"
#include "transillum/files.h"
#include "transillum/map_files.h"
#include "transillum/solve_session.h"
#include "transillum/visibility_map.h"

namespace transillum::testing::locale_test {
namespace {

using test::CommaLocale;
using test::refusal;
using ::testing::HasSubstr;

/// A room with numbers that a reader of decimal commas would cut short.
const char* const obj =
    "mtllib room.mtl\nusemtl lamp\nv 0.25 0 0\nv 1.5 0.125 0\nv 0 1.75 0\nv 0 0 0.875\n"
    "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
const char* const mtl = "newmtl lamp\nKd 0.25 0.5 0.75\nKe 1.5 2.5 0.5\n";

LineChart chart() {
  LineChart chart;
  chart.title = "0.5";
  chart.x = {.title = "x", .low = 0.5, .high = 2.5, .ticks = {{0.75, "0.75"}, {1.25, "1.25"}}};
  chart.y = {.title = "y", .low = 0.5, .high = 2.5, .ticks = {{0.75, "0.75"}, {1.25, "1.25"}}};
  chart.series.resize(1);
  chart.series[0].points = {{0.625, 0.875}, {2.125, 1.375}};
  return chart;
}

Study study() {
  Study study;
  study.points.resize(1);
  study.points[0].passes = 16;
  study.points[0].rms_error = 0.125;
  return study;
}

/// Reads a scene and a result, and writes every kind of file; returns names and contents. Times in
/// statistics are taken from `solution`.
std::map<std::string, std::string> files_written(const Solution& solution) {
  const TemporaryFolder folder;
  write_text(folder / "room.obj", obj);
  write_text(folder / "room.mtl", mtl);
  const auto path = [&](const char* name) { return std::filesystem::path(folder / name); };
  SceneDescription description = describe_scene(folder / "room.obj");
  description.name = "room";  // instead of the path, which differs from call to call
  write_obj(path("copy.obj"), description);
  const Scene scene(description);
  for (const char* name : {"r.vtp", "r.csv", "r.ply", "r.gltf", "r.glb"}) {
    write_result(path(name), solution);
  }
  write_result(path("again.csv"), read_result(path("r.vtp")));
  write_statistics(path("s.json"), RunOptions{}, solution);
  const BspTree tree(scene);
  const VisibilityMap map =
      map_from_below(record_local_map(scene, tree, normalized({0.3, 0.2, 0.9})));
  for (const char* name : {"m.svg", "m.png", "m.vtp", "m.json"}) {
    write_map(path(name), scene, map);
  }
  write_charts(path("c.svg"), {chart()});
  write_file_whole(path("study.csv"),
                   [](std::ostream& out) { write_study_csv(out, {StudySeries{}}, study()); });
  write_file_whole(path("d.csv"), [](std::ostream& out) {
    write_directions_csv(out, std::vector<DirectionSample>{{}});
  });
  std::map<std::string, std::string> contents;
  for (const std::string& name : folder.names()) {
    // Cairo numbers the surfaces of a process.
    contents[name] = std::regex_replace(read_file(folder / name), std::regex("surface[0-9]+"), "");
  }
  return contents;
}

/// Calls `check` in the locale C and in one with a decimal comma.
void expect_with_and_without_comma(const std::function<void()>& check) {
  check();
  const CommaLocale locale;
  if (!locale.problem().empty()) {
    GTEST_SKIP() << locale.problem();
  }
  check();
}

TEST(Locale, NumbersBeyondTheRangeOfDouble) {
  const auto check = [] {
    const std::pair<const char*, double> cases[] = {
        {"1.5", 1.5},
        {"-0.25e1", -2.5},
        {"1.5e400", HUGE_VAL},
        {"-1.5e400", -HUGE_VAL},
        {"1.5e-400", 0},
        {"0.00001e310", 1e305},
        {"0.1e310", HUGE_VAL},
        {"12345.6e-400", 0},
        {"1e99999999999999999999", HUGE_VAL},
        {"1e-99999999999999999999", 0},
        {"0e99999999999999999999", 0},
        {"4.9e-324", 4.9e-324},
    };
    for (const auto& [text, value] : cases) {
      EXPECT_EQ(parse_number(text), value) << text;
    }
    EXPECT_TRUE(std::signbit(*parse_number("-1.5e-400")));
    EXPECT_EQ(parse_number(std::string(400, '7') + ".5"), HUGE_VAL);
    EXPECT_EQ(parse_number("." + std::string(400, '0') + "1"), 0);
    EXPECT_EQ(parse_number("1,5"), std::nullopt);
  };
  expect_with_and_without_comma(check);
}

TEST(Locale, FilesAreTheSameWithADecimalComma) {
  const auto scene = load_scene("stars:n=2");
  const Solution solution = solve(scene, SolveOptions{.directions = 16});
  const auto expected = files_written(solution);
  ASSERT_GE(expected.size(), 16U);
  expect_with_and_without_comma([&] {
    const auto written = files_written(solution);
    for (const auto& [name, content] : expected) {
      EXPECT_TRUE(written.at(name) == content) << name;
    }
  });
}

TEST(Locale, ErrorsAndParametersAreTheSameWithADecimalComma) {
  const test::TemporaryFolder folder;
  const std::string far = folder.write("far.obj", "v 0 0 0\nv 1.5e400 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto check = [&] {
    EXPECT_THAT(refusal([&] { (void)describe_scene(far); }),
                HasSubstr("far.obj:2: vertex 2: `1.5e400` is not a finite coordinate"));
    EXPECT_THAT(refusal([] { check_json("[1.5e400]", "a.json"); }), HasSubstr("`1.5e400`"));
    EXPECT_EQ(refusal([] { check_json("[1.5]", "a.json"); }), "");
  };
  expect_with_and_without_comma(check);
}

TEST(Locale, TheProgramWritesTheSameWithADecimalComma) {
  const auto solution = [] {
    return expect_success({"solve", "furnace", "-q", "-m", "16", "--tolerance", "0.5e-3",
                           "--max-patch-area", "0.25", "--out", "-"})
        .out;
  };
  const std::string expected = solution();
  expect_with_and_without_comma([&] { EXPECT_EQ(solution(), expected); });
}

}  // namespace
}  // namespace transillum::testing::locale_test
