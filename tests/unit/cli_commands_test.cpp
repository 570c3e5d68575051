// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Every command of the program `transillum`, run as a process: help, output files and reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program_call.h"
#include "transillum/bsp_tree.h"
#include "transillum/directions.h"

namespace transillum::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// The rows of CSV text below its header.
std::vector<std::vector<double>> numbers(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  const auto lines = lines_of(csv);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    rows.emplace_back();
    std::istringstream cells(lines[k]);
    for (std::string cell; std::getline(cells, cell, ',');) {
      rows.back().push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
  return rows;
}

TEST(CliHelp, EveryCommandHasHelpWithAnExample) {
  const ProgramResult all = expect_success({"--help"});
  EXPECT_EQ(all.err, "");
  for (const char* word :
       {"solve", "transfers", "map", "directions", "info", "sphere-flake", "rooms"}) {
    EXPECT_THAT(all.out, HasSubstr(word));
  }
  for (const char* command :
       {"scene", "solve", "transfers", "map", "factors", "directions", "bounds", "study", "compare",
        "info", "merge", "picture", "shading"}) {
    const ProgramResult result = run_program({command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.out, HasSubstr("Example: transillum " + std::string(command)));
    EXPECT_EQ(run_program({"help", command}).out, result.out);
    for (const std::string& line : lines_of(result.out)) {
      EXPECT_LE(line.size(), 100U) << line;
    }
  }
  EXPECT_THAT(run_program({"solve", "--help"}).out, HasSubstr("(default 1024)"));
}

TEST(CliHelp, VersionIsOneLine) {
  const ProgramResult result = expect_success({"--version"});
  EXPECT_THAT(result.out, ::testing::MatchesRegex("transillum [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

/// Every command would wait until these libraries are loaded
/// (decisions/0082-charts-without-vtk.md).
TEST(CliHelp, TheProgramLoadsNeitherVtkNorMpi) {
  RunningProgram listing({}, {}, {}, {}, "export LD_TRACE_LOADED_OBJECTS=1");
  const std::string libraries = listing.wait().out;
  EXPECT_THAT(libraries, HasSubstr("libembree"));
  EXPECT_THAT(libraries, Not(HasSubstr("vtk")));
  EXPECT_THAT(libraries, Not(HasSubstr("libmpi")));
}

TEST(CliSolve, WarnsWhereTheDirectionsAreTooFew) {
  const ProgramResult dark = expect_success({"solve", "cornell-box", "-m", "1"});
  EXPECT_THAT(dark.err, HasSubstr("warning: no patch receives light from another"));
  const ProgramResult slow =
      expect_success({"solve", "furnace", "-m", "1", "--sampling", "fibonacci", "--engine", "rays",
                      "--iterations", "50"});
  EXPECT_THAT(slow.err, HasSubstr("warning: the changes decrease by a factor of only"));
  for (const char* scene : {"cornell-box", "furnace", "stars"}) {
    EXPECT_THAT(run_program({"solve", scene, "-m", "64", "-q"}).err, "") << scene;
  }
}

TEST(CliSolve, WritesEveryFormatAndNoOtherFiles) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      {"solve", "furnace", "-m", "16", "--out", folder / "a.csv", "--out", folder / "a.vtp",
       "--out", folder / "a.ply", "-o", folder / "a.glb", "--stats", folder / "a.json"});
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("closure defect"));
  EXPECT_THAT(folder.names(), ElementsAre("a.csv", "a.glb", "a.json", "a.ply", "a.vtp"));
  EXPECT_EQ(lines_of(read_file(folder / "a.csv")).front(),
            "face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b,H_r,H_g,H_b,F_sum,sky,group,"
            "material");
}

TEST(CliSolve, FurnaceHasRadiosityTwo) {
  const TemporaryFolder folder;
  expect_success({"solve", "furnace", "-m", "16", "--normalize", "rows", "--tolerance", "1e-12",
                  "--quiet", "--out", folder / "a.csv"});
  for (const auto& row : numbers(read_file(folder / "a.csv"))) {
    ASSERT_EQ(row.size(), 19U);
    EXPECT_NEAR(row[9], 2, 1e-10);
  }
}

TEST(CliSolve, PrintsTheSummaryWithoutAnOutputFile) {
  const ProgramResult result = expect_success({"solve", "furnace", "-m", "8"});
  EXPECT_THAT(result.out, HasSubstr("energy defect"));
  EXPECT_EQ(result.err, "");
}

TEST(CliSolve, ResultsDoNotDependOnThreadsAndMemory) {
  const TemporaryFolder folder;
  const auto solve = [&](const std::string& name, const Arguments& more) {
    expect_success(Arguments{"solve", "boards", "-m", "32", "--max-patch-area", "0.5", "--out",
                             folder / name} +
                   more);
    return read_file(folder / name);
  };
  const std::string one = solve("1.csv", {"--threads", "1"});
  EXPECT_GT(line_count(one), 10U);
  EXPECT_EQ(solve("2.csv", {"--threads", "2"}), one);
  EXPECT_EQ(solve("7.csv", {"--threads", "7"}), one);
  // Without stored form factors, the order of summation differs: the results are equal up to
  // rounding.
  const auto stored = numbers(one), recomputed = numbers(solve("0.csv", {"--memory", "0"}));
  ASSERT_EQ(stored.size(), recomputed.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    for (std::size_t k = 9; k < 12; ++k) {
      EXPECT_NEAR(stored[i][k], recomputed[i][k], 1e-5 * stored[i][k]);
    }
  }
}

TEST(CliSolve, ReportsTheFirstShot) {
  const TemporaryFolder folder;
  for (const auto& [ratio, sources] : {std::pair{"none", 0}, {"auto", 16}, {"1e9", 0}, {"0", 16}}) {
    const ProgramResult result = expect_success(
        {"solve", "stars:n=2", "-m", "8", "--first-shot", ratio, "--stats", folder / "s.json"});
    const bool reported =
        result.out.find("first shot         16 patches, 100 %") != std::string::npos;
    EXPECT_EQ(reported, sources > 0) << result.out;
    const auto json = read_json(folder / "s.json");
    EXPECT_EQ(json.at("first_shot").at("sources"), sources);
    EXPECT_EQ(json.at("first_shot").at("power_share"), sources > 0 ? 1.0 : 0.0);
    EXPECT_EQ(json.at("options").at("first-shot").is_null(), std::string(ratio) == "none");
    EXPECT_TRUE(json.at("seconds").at("first_shot").is_number());
  }
}

TEST(CliSolve, StatisticsHaveTheDocumentedKeys) {
  const TemporaryFolder folder;
  expect_success({"solve", "cornell-box", "-m", "16", "--iterations", "4", "--threads", "1",
                  "--stats", folder / "s.json"});
  const auto json = read_json(folder / "s.json");
  for (const char* name : {"patches", "fragments", "directions", "passes", "iterations", "threads",
                           "transfers", "closure_defect_max", "energy_defect"}) {
    EXPECT_TRUE(json.at(name).is_number()) << name;
  }
  EXPECT_EQ(json.at("passes"), 16);
  EXPECT_EQ(json.at("directions"), 32);
  EXPECT_EQ(json.at("iterations"), 4);
  EXPECT_EQ(json.at("threads"), 1);
  EXPECT_EQ(json.at("change").size(), 4U);
  EXPECT_EQ(json.at("contraction").size(), 4U);
  for (const char* phase : {"load", "bsp", "transfers", "iterate", "total"}) {
    EXPECT_GE(json.at("seconds").at(phase).get<double>(), 0) << phase;
  }
  EXPECT_EQ(json.at("options").at("sampling"), "antipodal");
  EXPECT_TRUE(json.at("options").at("tolerance").is_null());
  EXPECT_TRUE(json.at("complete"));
}

TEST(CliSolve, DefaultDirectionsDependOnWhatAPassServes) {
  const TemporaryFolder folder;
  const auto result = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"solve", "furnace", "-m", "24", "-q", "--out", folder / "b.csv"});
    expect_success(options);
    return read_file(folder / "b.csv");
  };
  EXPECT_EQ(result({}), result({"--sampling", "antipodal"}));
  EXPECT_NE(result({}), result({"--sampling", "fibonacci"}));
  EXPECT_EQ(result({"--one-way"}), result({"--one-way", "--sampling", "fibonacci"}));
}

TEST(CliSolve, OneWayUsesHalfTheDirections) {
  const TemporaryFolder folder;
  expect_success({"solve", "furnace", "-m", "16", "--one-way", "--sampling", "hammersley",
                  "--stats", folder / "s.json"});
  const auto json = read_json(folder / "s.json");
  EXPECT_EQ(json.at("directions"), 16);
  EXPECT_EQ(json.at("options").at("sampling"), "hammersley");
}

TEST(CliSolve, StatisticsHaveTheCostOfFaces) {
  const TemporaryFolder folder;
  expect_success({"solve", "cornell-box", "-m", "64", "-q", "--stats", folder / "fast.json"});
  const auto costs = read_json(folder / "fast.json").at("costs");
  EXPECT_EQ(costs.at("passes"), 1);
  EXPECT_GT(costs.at("candidates"), costs.at("queries"));
  ASSERT_EQ(costs.at("faces").size(), 10U);
  std::int64_t queries = 0;
  for (const auto& face : costs.at("faces")) {
    EXPECT_EQ(face.at("reason"), "many-candidates");
    queries += face.at("queries").get<std::int64_t>();
  }
  EXPECT_GT(queries, 0);
  EXPECT_LE(queries, costs.at("queries"));
  EXPECT_FALSE(costs.at("faces").at(0).at("material").get<std::string>().empty());
  expect_success({"solve", "cornell-box", "-m", "64", "-q", "--engine", "zbuffer", "--stats",
                  folder / "zbuffer.json"});
  EXPECT_TRUE(read_json(folder / "zbuffer.json").at("costs").is_null());
}

TEST(CliSolve, RotationChangesOnlyTheError) {
  const TemporaryFolder folder;
  for (const char* seed : {"1", "2"}) {
    expect_success({"solve", "cornell-box", "-m", "300", "--rotate", seed, "--out",
                    folder / "b.csv", "--stats", folder / "s.json"});
    const auto json = read_json(folder / "s.json");
    EXPECT_EQ(json.at("options").at("rotate"), std::stoi(seed));
    write_text(folder / seed, read_file(folder / "b.csv"));
  }
  const auto a = numbers(read_file(folder / "1")), b = numbers(read_file(folder / "2"));
  EXPECT_NE(a, b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i][9], b[i][9], 0.1 * b[i][9] + 0.1);
  }
}

TEST(CliSolve, TwoSidedFacesGiveTwoPatchesEach) {
  const TemporaryFolder folder;
  expect_success({"solve", "furnace", "-m", "4", "--two-sided", "--out", folder / "a.csv"});
  const auto rows = numbers(read_file(folder / "a.csv"));
  ASSERT_EQ(rows.size() % 2, 0U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t face = i / 2;
    EXPECT_EQ(rows[i][0], static_cast<double>(face));
    EXPECT_EQ(rows[i][1], static_cast<double>(i));
  }
}

TEST(CliScene, WrittenSceneHasTheSameSolution) {
  const TemporaryFolder folder;
  expect_success({"scene", "cornell-box", "--out", folder / "box.obj"});
  EXPECT_THAT(folder.names(), ElementsAre("box.mtl", "box.obj"));
  const auto solve = [&](const std::string& scene, const std::string& name) {
    expect_success({"solve", scene, "-m", "16", "--out", folder / name});
    return read_file(folder / name);
  };
  EXPECT_EQ(solve(folder / "box.obj", "file.csv"), solve("cornell-box", "built-in.csv"));
}

TEST(CliTransfers, RowsOfAReceiverSumToItsProjectedArea) {
  const TemporaryFolder folder;
  expect_success({"solve", "cornell-box", "-m", "1", "--out", folder / "b.csv"});
  const ProgramResult result = expect_success({"transfers", "cornell-box", "--direction", "0,3,0"});
  EXPECT_EQ(lines_of(result.out).front(), "receiver,source,area");
  const auto patches = numbers(read_file(folder / "b.csv"));
  std::map<int, double> sums;
  for (const auto& row : numbers(result.out)) {
    EXPECT_GT(row[2], 0);
    sums[static_cast<int>(row[0])] += row[2];
  }
  // The normals of the floor and of the tops of the blocks are the direction, so their projected
  // areas are their areas: together a whole floor.
  double upward = 0;
  for (const auto& [receiver, sum] : sums) {
    const double area = patches.at(static_cast<std::size_t>(receiver))[2];
    EXPECT_LE(sum, area * (1 + 1e-10));
    if (std::abs(sum - area) < 1e-10 * area) {
      upward += area;
    }
  }
  EXPECT_NEAR(upward, 0.556 * 0.5592, 1e-12);
}

TEST(CliTransfers, DoNotDependOnLengthAndFormOfTheDirection) {
  const auto transfers = [](const std::string& direction) {
    return expect_success({"transfers", "furnace", "--direction", direction}).out;
  };
  const std::string out = transfers("-.5,1,2");
  EXPECT_EQ(transfers("-1,2,4"), out);
  EXPECT_EQ(transfers("-1e300,2e300,4e300").size() > 20, true);
  EXPECT_EQ(transfers("+1e-310,0,0"), transfers("1,0,0"));
}

TEST(CliMap, WritesEveryFormatAndNoOtherFiles) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      {"map", "cornell-box", "--direction", "-1,2,3", "--out", folder / "a.svg", "--out",
       folder / "a.png", "--size", "300", "-o", folder / "a.vtp", "--out", folder / "a.json"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(folder.names(), ElementsAre("a.json", "a.png", "a.svg", "a.vtp"));
  EXPECT_THAT(read_file(folder / "a.svg"), HasSubstr("Visibility map of cornell-box"));
}

/// The areas in the map of a receiver are its transfers.
TEST(CliMap, OfAReceiverHasTheAreasOfItsTransfers) {
  const TemporaryFolder folder;
  const auto run = [&](const char* command, const Arguments& more) {
    return expect_success(Arguments{command, "rooms", "--direction", "0.4,-0.2,-1"} + more).out;
  };
  std::map<int, std::map<int, double>> transfers;
  for (const auto& row : numbers(run("transfers", {"--engine", "local"}))) {
    if (row[1] >= 0) {
      transfers[static_cast<int>(row[0])][static_cast<int>(row[1])] = row[2];
    }
  }
  ASSERT_FALSE(transfers.empty());
  const auto& [receiver, seen] = *transfers.begin();
  run("map", {"--receiver", std::to_string(receiver), "--out", folder / "m.json"});
  std::map<int, double> areas;
  const auto json = read_json(folder / "m.json");
  EXPECT_EQ(json.at("receiver").at("patch"), receiver);
  for (const auto& polygon : json.at("polygons")) {
    if (polygon.at("facing") == "back") {
      areas[polygon.at("patch")] += polygon.at("area").get<double>();
    }
  }
  EXPECT_EQ(areas.size(), seen.size());
  for (const auto& [source, area] : seen) {
    EXPECT_NEAR(areas[source], area, 1e-12);
  }
}

TEST(CliMap, AfterAllStepsIsTheWholeMapAndAfterNoneEmpty) {
  const TemporaryFolder folder;
  const auto map = [&](const std::vector<std::string>& step) {
    const std::string file = folder / "m.svg";
    expect_success(Arguments{"map", "boards", "--direction", "1,2,3", "-o", file} + step);
    return read_file(file);
  };
  const std::string whole = map({});
  std::string last;
  int changes = 0;
  // The step with the last fragment shows the same picture as the map without the option.
  const auto scene = load_scene("boards");
  const int steps = static_cast<int>(BspTree(*scene).fragments().size());
  for (int k = 0; k <= steps; ++k) {
    const std::string text = map({"--step", std::to_string(k)});
    changes += text != last;
    last = text;
  }
  EXPECT_EQ(last, whole);
  EXPECT_GT(changes, steps / 2);
  EXPECT_THAT(map({"--step", "0"}), HasSubstr("edge-on"));
}

TEST(CliMap, ReportsWhyAMapIsEmpty) {
  const TemporaryFolder folder;
  const ProgramResult result = expect_success(
      {"map", "furnace", "--direction", "1,0,0", "--receiver", "0", "--out", folder / "m.svg"});
  EXPECT_THAT(result.err, ::testing::AnyOf(HasSubstr("edge-on"), HasSubstr("back-facing")));
  EXPECT_EQ(line_count(result.err), 1U);
  EXPECT_THAT(folder.names(), ElementsAre("m.svg"));
}

TEST(CliTransfers, TakesANumberOfThreads) {
  const Arguments call{"transfers", "cornell-box", "--direction", "1,2,3"};
  const ProgramResult one = expect_success(call + Arguments{"--threads", "1"});
  EXPECT_EQ(one.out, run_program(call).out);
  EXPECT_THAT(run_program(call + Arguments{"--threads", "0"}).err, HasSubstr("--threads"));
}

TEST(CliTransfers, RaysEstimateTheSameAreas) {
  const auto total = [](const Arguments& more) {
    const ProgramResult result =
        expect_success(Arguments{"transfers", "cornell-box", "--direction", "1,2,3"} + more);
    double sum = 0;
    for (const auto& row : numbers(result.out)) {
      sum += row[2];
    }
    return sum;
  };
  const double exact = total({"--engine", "local"});
  EXPECT_NEAR(total({"--engine", "rays", "--resolution", "1024"}), exact, 2e-3 * exact);
  EXPECT_NE(total({"--engine", "rays"}), total({"--engine", "rays", "--resolution", "64"}));
}

TEST(CliFactors, PassesAndRaysGiveTheSameMatrix) {
  const TemporaryFolder folder;
  const auto factors = [&](const Arguments& more) {
    expect_success(Arguments{"factors", "furnace", "--out", folder / "f.csv"} + more);
    EXPECT_EQ(lines_of(read_file(folder / "f.csv")).front(), "i,j,F");
    return numbers(read_file(folder / "f.csv"));
  };
  const auto passes = factors({"-m", "4000"});
  std::map<std::pair<double, double>, double> matrix;
  std::map<double, double> sums;
  for (const auto& row : passes) {
    ASSERT_EQ(row.size(), 3U);
    EXPECT_GT(row[2], 0);
    matrix[{row[0], row[1]}] = row[2];
    sums[row[0]] += row[2];
  }
  EXPECT_TRUE(std::is_sorted(passes.begin(), passes.end()));
  EXPECT_EQ(sums.size(), 12U);
  for (const auto& [i, sum] : sums) {
    EXPECT_NEAR(sum, 1, 1e-3) << i;
  }
  const auto rays = factors({"--engine", "rays", "--rays", "20000", "--seed", "3"});
  EXPECT_TRUE(std::is_sorted(rays.begin(), rays.end()));
  for (const auto& row : rays) {
    EXPECT_NEAR(row[2], (matrix[{row[0], row[1]}]), 0.01);
  }
  EXPECT_EQ(factors({"--engine", "rays", "--rays", "20000", "--seed", "3", "--threads", "1"}),
            rays);
  const auto pairs = factors({"--engine", "pairs", "--points", "64"});
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  for (const auto& row : pairs) {
    EXPECT_NEAR(row[2], (matrix[{row[0], row[1]}]), 1e-3);
  }
  const auto hemicubes = factors({"--engine", "hemicube", "--resolution", "128"});
  EXPECT_TRUE(std::is_sorted(hemicubes.begin(), hemicubes.end()));
  // From the centers of such large patches the visible areas differ, but rows still sum to 1.
  sums.clear();
  for (const auto& row : hemicubes) {
    sums[row[0]] += row[2];
  }
  for (const auto& [i, sum] : sums) {
    EXPECT_NEAR(sum, 1, 1e-12) << i;
  }
}

TEST(CliSolve, PairsAndHemicubesReplacePasses) {
  struct Engine {
    const char *name, *option, *number, *progress;
  };
  for (const Engine& engine :
       {Engine{"pairs", "points", "8", "351, by 8 points where something is between"},
        Engine{"hemicube", "resolution", "32", "27 of 3072 pixels each"}}) {
    SCOPED_TRACE(engine.name);
    const TemporaryFolder folder;
    const ProgramResult result =
        expect_success({"solve", "cornell-box", "--engine", engine.name,
                        std::string("--") + engine.option, engine.number, "--out", folder / "b.csv",
                        "--out", folder / "b.vtp", "--stats", folder / "s.json"});
    EXPECT_THAT(result.err, HasSubstr(engine.progress));
    EXPECT_THAT(folder.names(), ElementsAre("b.csv", "b.vtp", "s.json"));
    EXPECT_EQ(read_json(folder / "s.json").at("options").at(engine.option).dump(), engine.number);
  }
}

TEST(CliFactors, FailWithoutAFileIfTheMemoryIsTooSmall) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"factors", "furnace", "-m", "8", "--memory", "10", "--out", folder / "f.csv"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("--memory"));
  EXPECT_EQ(folder.names().size(), 0U);
}

TEST(CliDirections, ArePointsOnTheUnitSphere) {
  const TemporaryFolder folder;
  for (const std::string& sampling : names_of<Sampling>()) {
    expect_success({"directions", "--sampling", sampling, "-m", "32", "--out", folder / "d.csv"});
    const std::string csv = read_file(folder / "d.csv");
    EXPECT_EQ(lines_of(csv).front(), "u,v,x,y,z");
    const auto rows = numbers(csv);
    ASSERT_EQ(rows.size(), 32U);
    for (const auto& r : rows) {
      EXPECT_NEAR(std::hypot(r[2], r[3], r[4]), 1, 1e-15);
      EXPECT_NEAR(r[4], 1 - 2 * r[1], 1e-15);
    }
    EXPECT_EQ(run_program({"directions", "--sampling", sampling, "-m", "32"}).out, csv);
  }
}

TEST(CliDirections, RotateAppliesOneRotationToTheSet) {
  const auto rows = [](const Arguments& more) {
    return numbers(run_program(Arguments{"directions", "-m", "9"} + more).out);
  };
  const auto original = rows({}), rotated = rows({"--rotate", "3"});
  ASSERT_EQ(rotated.size(), 9U);
  EXPECT_NE(rotated[1], original[1]);
  EXPECT_NE(rotated[1], rows({"--rotate", "4"})[1]);
  const auto cosine = [](const auto& a, const auto& b) {
    return a[2] * b[2] + a[3] * b[3] + a[4] * b[4];
  };
  EXPECT_NEAR(cosine(rotated[1], rotated[7]), cosine(original[1], original[7]), 1e-15);
}

TEST(CliDirections, StatsReportDiscrepanciesAndErrors) {
  const ProgramResult text =
      expect_success({"directions", "-m", "64", "--sampling", "fibonacci", "--stats"});
  EXPECT_THAT(text.out, ::testing::ContainsRegex("star discrepancy +3.617e-02 "));
  EXPECT_THAT(text.out, ::testing::ContainsRegex("cap discrepancy +7.289e-02 .*exact"));
  EXPECT_THAT(text.out, ::testing::ContainsRegex("two-way .* RMS, .* largest\n"));
  EXPECT_THAT(text.out, ::testing::Not(HasSubstr("u,v,x")));
  const ProgramResult even = run_program({"directions", "-m", "64", "--stats"});
  EXPECT_THAT(even.out, ::testing::ContainsRegex("directions +64, antipodal\n"));
  EXPECT_THAT(even.out,
              ::testing::ContainsRegex("cap discrepancy .*\n .* with the opposites, exact"));

  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"directions", "-m", "300", "--sampling", "hammersley", "--stats",
                         folder / "d.json", "--scene", "furnace", "--out", folder / "d.csv"})
                .out,
            "");
  const auto json = read_json(folder / "d.json");
  EXPECT_EQ(json.at("directions"), 300);
  EXPECT_LE(json.at("star_discrepancy").at("value"), json.at("star_discrepancy").at("bound"));
  EXPECT_FALSE(json.at("cap_discrepancy").at("exact"));
  EXPECT_FALSE(json.at("cap_discrepancy").at("two_way_exact"));
  EXPECT_GT(json.at("cap_discrepancy").at("two_way"), 0);
  EXPECT_GT(json.at("star_discrepancy").at("two_way"), 0);
  const auto& one_way = json.at("eps").at("one_way");
  EXPECT_EQ(one_way.at("patches").size(), 12U);
  double largest = 0;
  for (const double e : one_way.at("patches")) {
    largest = std::max(largest, std::abs(e));
  }
  EXPECT_EQ(one_way.at("max"), largest);
  EXPECT_EQ(numbers(read_file(folder / "d.csv")).size(), 300U);
}

TEST(CliBounds, PrintsTheThreeTables) {
  const ProgramResult result = expect_success({"bounds", "--sampling", "fibonacci"});
  const auto row = [](const char* pattern) { return ::testing::ContainsRegex(pattern); };
  EXPECT_THAT(result.out, row("0.2 +5 +5 +1\n"));
  EXPECT_THAT(result.out, row("0.9 +272 +272 +12\n"));
  EXPECT_THAT(result.out, row("0.6 +5700 +5855 +88\n"));
  EXPECT_THAT(result.out, row("0.6 +1.80e\\+07 +1.76e\\+07 +8.08e\\+06\n"));

  const ProgramResult antipodal = run_program({"bounds"});
  EXPECT_THAT(antipodal.out, row("0.9 +272 +272 +9\n"));
  EXPECT_THAT(antipodal.out, row("0.6 +5700 +5855 +59\n"));
  EXPECT_THAT(antipodal.out, row("0.6 +1.80e\\+07 +1.76e\\+07 +-\n"));

  // The paper's values are printed only for the paper's accuracy and size ratio.
  const ProgramResult other =
      run_program({"bounds", "--sampling", "fibonacci", "--reflectance", "0.6", "--accuracy",
                   "0.02", "--size-ratio", "9", "-m", "256"});
  EXPECT_THAT(other.out, row("0.6 +37 +37 "));
  EXPECT_THAT(other.out, row("0.6 +- +[0-9]+ +[0-9]+\n"));
  EXPECT_THAT(other.out, row("contraction per iteration .* 0.670312 +0.60"));
  EXPECT_THAT(other.out, HasSubstr("Directions for 2 %"));
}

TEST(CliBounds, UsesReflectanceAndSizeOfAScene) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"bounds", "furnace", "--out", folder / "b.json"}).out, "");
  const auto json = read_json(folder / "b.json");
  EXPECT_EQ(json.at("scene").at("rho_max"), 0.5);
  EXPECT_EQ(json.at("size_ratio"), json.at("scene").at("size_ratio"));
  ASSERT_EQ(json.at("tables").size(), 1U);
  EXPECT_EQ(json.at("tables")[0].at("converges").at("formula"), 24);
  EXPECT_EQ(json.at("tables")[0].at("homogeneous").at("formula"), 3777);
  EXPECT_NEAR(json.at("prediction").at("contraction").at("bound"), 0.5 * (1 + 2. / 1024 * 17),
              1e-12);
}

TEST(CliBounds, EstimatesDirectionsFromASolveRun) {
  const TemporaryFolder folder;
  write_text(folder / "run.json",
             R"({"scene": "rooms", "passes": 400, "options": {"sampling": "random"},
                 "error_estimate": {"replicas": 4, "rms": 0.02}})");
  const ProgramResult result = expect_success({"bounds", "furnace", "--run", folder / "run.json"});
  EXPECT_THAT(result.out, HasSubstr("rooms: 2 % RMS error of B with 400 passes, random"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("M = 1600 +for 1 %"));

  expect_success(
      {"solve", "furnace", "-m", "64", "--replicas", "4", "--stats", folder / "solved.json"});
  const ProgramResult solved =
      run_program({"bounds", "furnace", "--run", folder / "solved.json", "--accuracy", "0.0001"});
  EXPECT_THAT(solved.out, ::testing::ContainsRegex("furnace: .* 64 passes, antipodal"));

  write_text(folder / "plain.json",
             R"({"passes": 400, "options": {"sampling": "random"}, "error_estimate": null})");
  std::string deep;
  deep.resize(2'000'000, '[');
  write_text(folder / "deep.json", deep);
  const std::string files[] = {folder / "plain.json", folder / "none.json", folder / "deep.json",
                               "/dev/zero"};
  for (const std::string& file : files) {
    expect_refused({"bounds", "--run", file}, file);
  }
  for (const char* text :
       {"", "{", "[]", "{}", R"({"options": 3})", R"({"options": {"sampling": "x"}, "passes": 4})",
        R"({"options": {"sampling": "random"}, "passes": 4,
                               "error_estimate": {"replicas": 4, "rms": 0}})"}) {
    write_text(folder / "bad.json", text);
    SCOPED_TRACE(text);
    expect_refused({"bounds", "--run", folder / "bad.json"}, "bad.json");
  }
}

}  // namespace
}  // namespace transillum::testing
