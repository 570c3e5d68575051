// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `solve --basis linear` as a program: the options that it cannot be combined with, its files,
// shards and checkpoints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program_call.h"
#include "support/refusal.h"
#include "transillum/files.h"
#include "transillum/form_factor_solve.h"
#include "transillum/linear_basis.h"

namespace transillum::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const Arguments linear_box{"solve", "cornell-box", "-q", "--basis", "linear"};

TEST(CliLinearBasis, IsRefusedInOneLineWhereItIsNotAvailable) {
  expect_all_refused(
      linear_box + Arguments{"-m", "8"},
      {
          {{"--engine", "global"}, "engine global does not have"},
          {{"--engine", "zbuffer"}, "engine zbuffer does not have"},
          {{"--engine", "painter"}, "engine painter does not have"},
          {{"--engine", "rays"}, "engine rays does not have"},
          {{"--engine", "corrected"}, "engine corrected does not have"},
          {{"--engine", "hemicube"}, "engine hemicube does not have"},
          {{"--scheme", "semi-iterative"}, "not available with the semi-iterative scheme"},
      });
  expect_refused({"solve", "furnace", "--basis", "quadratic"}, "choose one of constant, linear");
}

TEST(CliLinearBasis, WorksWithTheOtherOptions) {
  const Arguments options[] = {{"--one-way"},
                               {"--normalize", "rows"},
                               {"--normalize", "symmetric"},
                               {"--scheme", "growing"},
                               {"--scheme", "conjugate-gradients"},
                               {"--replicas", "4"},
                               {"--memory", "1M", "--iterations", "3"},
                               {"--sky", "1"},
                               {"--two-sided"},
                               {"--engine", "local"},
                               {"--by", "material"},
                               {"--engine", "exact"},
                               {"--first-shot", "0"},
                               {"--first-shot", "auto"}};
  for (const Arguments& option : options) {
    SCOPED_TRACE(::testing::PrintToString(option));
    expect_success(linear_box + Arguments{"-m", "16"} + option);
  }
  for (const Arguments& option : {Arguments{"-m", "16"}, Arguments{"--engine", "pairs"}}) {
    const ProgramResult table = expect_success(linear_box + option + Arguments{"--by", "material"});
    EXPECT_THAT(table.out, HasSubstr("absorbed, W"));
    EXPECT_THAT(table.out, HasSubstr("power, W"));
  }
  expect_success(linear_box + Arguments{"--accuracy", "10%"});
}

TEST(CliLinearBasis, PairsHaveFunctionsToo) {
  const TemporaryFolder folder;
  const Arguments pairs = linear_box + Arguments{"--engine", "pairs"};
  for (const Arguments& option :
       {Arguments{}, Arguments{"--points", "8"}, Arguments{"--accuracy", "1%"},
        Arguments{"--iterations", "3"}, Arguments{"--threads", "2"}}) {
    SCOPED_TRACE(::testing::PrintToString(option));
    expect_success(pairs + option + Arguments{"--out", folder / "r.vtp"});
    EXPECT_EQ(read_result(folder / "r.vtp").linear_terms.size(), 27U);
  }
  for (const Arguments& option : {Arguments{"--normalize", "rows"}, Arguments{"--replicas", "4"},
                                  Arguments{"--scheme", "growing"}, Arguments{"--sky", "1"}}) {
    SCOPED_TRACE(::testing::PrintToString(option));
    const ProgramResult result = run_program(pairs + option);
    EXPECT_EQ(result.status, 2);
    // A warning may stand before it: the sky lights nothing in a closed box.
    EXPECT_THAT(result.err, ContainsRegex("transillum: engine pairs has no directions[^\n]*\n$"));
  }
  // Beside passes, in a study: both are compared with linear passes.
  const ProgramResult study =
      expect_success({"study", "cornell-box", "-m", "256", "--engines", "fast,pairs", "--basis",
                      "constant,linear", "--no-cache", "-q", "--out", "-"});
  EXPECT_THAT(study.out, HasSubstr("pairs/linear"));
}

/// Form factors of passes and of pairs, by way of a file.
TEST(CliLinearBasis, StoredFormFactorsHaveMoments) {
  const TemporaryFolder folder;
  for (const Arguments& method : {Arguments{"-m", "64"}, Arguments{"--engine", "pairs"}}) {
    expect_success(
        linear_box + method +
        Arguments{"--first-shot", "none", "--tolerance", "1e-12", "--out", folder / "direct.vtp"});
    const Solution direct = read_result(folder / "direct.vtp");
    for (const char* name : {"f.npz", "f.mtx"}) {
      expect_success(
          Arguments{"factors", "cornell-box", "--basis", "linear", "--out", folder / name} +
          method);
      expect_success(linear_box + Arguments{"--factors", folder / name, "--tolerance", "1e-12",
                                            "--out", folder / "stored.vtp"});
      const Solution stored = read_result(folder / "stored.vtp");
      ASSERT_EQ(stored.linear_terms.size(), direct.linear_terms.size());
      for (std::size_t i = 0; i < direct.linear_terms.size(); ++i) {
        EXPECT_NEAR(max_abs(stored.radiosity[i] - direct.radiosity[i]), 0, 1e-10) << name;
        EXPECT_NEAR(max_abs(stored.linear_terms[i].first - direct.linear_terms[i].first), 0, 1e-10);
        EXPECT_NEAR(max_abs(stored.linear_terms[i].second - direct.linear_terms[i].second), 0,
                    1e-10);
      }
      // Constant functions do not read the moments.
      expect_success({"solve", "cornell-box", "-q", "--factors", folder / name});
    }
  }
  expect_success({"factors", "cornell-box", "-m", "8", "--out", folder / "constant.npz"});
  expect_refused(linear_box + Arguments{"--factors", folder / "constant.npz"},
                 "no moments for linear functions");
  const Arguments factors{"factors", "cornell-box", "--basis", "linear", "-m", "8", "--out"};
  expect_refused(factors + Arguments{folder / "f.vf"}, "a .vf file cannot hold");
  expect_refused(factors + Arguments{folder / "g.npz", "--engine", "zbuffer"},
                 "engine zbuffer does not have");
  expect_success(factors + Arguments{folder / "f.csv", "--drop", "1e-3"});
  EXPECT_THAT(read_file(folder / "f.csv"), HasSubstr("i,j,F,F01,F02,F10,F11,F12,F20,F21,F22\n"));
}

TEST(CliLinearBasis, GivenFormFactorsWithoutMomentsAreRefused) {
  const auto scene = load_scene("furnace");
  SolveOptions options;
  options.basis = Basis::linear;
  EXPECT_THAT(test::refusal([&] {
                (void)solve_with_form_factors(scene, pair_form_factors(*scene, {}), options);
              }),
              HasSubstr("no moments for linear functions"));
}

/// The value of column `name` in the first line of a CSV text.
double column(const std::string& csv, const std::string& name) {
  std::istringstream lines(csv);
  std::string header, values;
  std::getline(lines, header);
  std::getline(lines, values);
  std::istringstream names(header), cells(values);
  for (std::string cell, entry; std::getline(names, entry, ',');) {
    std::getline(cells, cell, ',');
    if (entry == name) {
      return std::stod(cell);
    }
  }
  ADD_FAILURE() << "no column " << name;
  return 0;
}

TEST(CliLinearBasis, FilesHoldTheFunctionsBitForBit) {
  const TemporaryFolder folder;
  Arguments call = linear_box + Arguments{"-m", "16", "--stats", folder / "r.json"};
  for (const char* ending : {"csv", "vtp", "ply", "glb", "gltf"}) {
    call = call + Arguments{"--out", folder / (std::string("r.") + ending)};
  }
  expect_success(call);
  const Solution solution = read_result(folder / "r.vtp");
  ASSERT_EQ(solution.linear_terms.size(), solution.radiosity.size());
  const std::string csv = read_file(folder / "r.csv");
  EXPECT_EQ(column(csv, "B_r"), solution.radiosity[0].r);
  EXPECT_EQ(column(csv, "B1_r"), solution.linear_terms[0].first.r);
  EXPECT_EQ(column(csv, "B2_b"), solution.linear_terms[0].second.b);
  const LinearBasis basis = linear_basis(*solution.scene, 0);
  EXPECT_EQ(column(csv, "c_x"), basis.center.x);
  EXPECT_EQ(column(csv, "g2_z"), basis.gradient[1].z);
  std::ostringstream again;
  write_result_csv(again, solution);
  EXPECT_EQ(again.str(), csv);
  EXPECT_THAT(read_file(folder / "r.ply"), HasSubstr("property uchar blue\nproperty double B_r"));
  // B at corners: patches share no corners.
  const std::string vtp = read_file(folder / "r.vtp");
  EXPECT_THAT(vtp.substr(0, 20'000), HasSubstr("B_corner"));
  std::size_t corners = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    corners += solution.scene->outline(i).size();
  }
  EXPECT_THAT(vtp, HasSubstr("NumberOfPoints=\"" + std::to_string(corners) + "\""));
  const auto statistics = read_json(folder / "r.json");
  EXPECT_EQ(statistics["options"]["basis"], "linear");
  EXPECT_LE(statistics["closure_defect_moments"], 1e-10);
  EXPECT_GE(statistics["negative_corners"], 0);
}

/// Columns B and H, whose range is >= 0, were once silently below it: H down to -0.038.
TEST(CliLinearBasis, WarnsOfMeansBelowZero) {
  const auto warning = ::testing::HasSubstr("warning: the mean of B or H is below 0 on 3 patches");
  EXPECT_THAT(run_program({"solve", "rooms", "-m", "8", "--basis", "linear"}).err, warning);
  EXPECT_THAT(run_program({"solve", "rooms", "-m", "16", "--basis", "linear"}).err,
              ::testing::Not(::testing::HasSubstr("below 0")));
}

TEST(CliLinearBasis, ShardsCheckpointsAndThreadsGiveTheSameBits) {
  const TemporaryFolder folder;
  const Arguments solve = linear_box + Arguments{"-m", "60", "--max-patch-area", "0.3"};
  const auto expect_ok = [](const Arguments& arguments) { expect_success(arguments); };
  expect_ok(solve + Arguments{"--out", folder / "whole.csv", "--threads", "1"});
  const std::string whole = read_file(folder / "whole.csv");
  expect_ok(solve + Arguments{"--out", folder / "threads.csv", "--threads", "3"});
  EXPECT_TRUE(read_file(folder / "threads.csv") == whole);
  for (const char* share : {"1", "2"}) {
    expect_ok(solve + Arguments{"--shard", std::string(share) + "/2", "--out",
                                folder / (std::string(share) + ".tsh")});
  }
  expect_ok({"merge", folder / "1.tsh", folder / "2.tsh", "--out", folder / "merged.csv", "-q"});
  EXPECT_TRUE(read_file(folder / "merged.csv") == whole);
  expect_ok(solve + Arguments{"--checkpoint", folder / "c.tck", "--out", folder / "a.csv"});
  expect_ok(solve +
            Arguments{"--checkpoint", folder / "c.tck", "--resume", "--out", folder / "b.csv"});
  EXPECT_TRUE(read_file(folder / "b.csv") == whole);
  // A checkpoint of the other basis is refused, after the note of the number of patches.
  const ProgramResult other = run_program({"solve", "cornell-box", "-m", "60", "--max-patch-area",
                                           "0.3", "--checkpoint", folder / "c.tck", "--resume"});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("basis is \"linear\" there and \"constant\" here"));
}

TEST(CliLinearBasis, CompareMeasuresFunctionsOfDifferentPatches) {
  const TemporaryFolder folder;
  const auto solve = [&](const std::string& basis, const std::string& area,
                         const std::string& name) {
    expect_success({"solve", "cornell-box", "-q", "-m", "64", "--first-shot", "none", "--basis",
                    basis, "--max-patch-area", area, "--out", folder / name});
  };
  solve("constant", "0.01", "fine.vtp");
  solve("constant", "0.3", "constant.vtp");
  solve("linear", "0.3", "linear.vtp");
  const auto error = [&](const std::string& name) {
    const ProgramResult result =
        expect_success({"compare", folder / "fine.vtp", folder / name, "--functions"});
    const std::string label = "L2 of functions";
    const std::size_t at = result.out.find(label);
    return at == std::string::npos ? -1.0 : std::stod(result.out.substr(at + label.size()));
  };
  EXPECT_EQ(error("fine.vtp"), 0);
  EXPECT_GT(error("linear.vtp"), 0.005);
  EXPECT_LT(error("linear.vtp"), 0.85 * error("constant.vtp"));
}

TEST(CliLinearBasis, StudiesMeasureFunctions) {
  const ProgramResult result =
      expect_success({"study", "furnace", "--max-patch-area", "0.5", "-m", "16,64", "--sampling",
                      "antipodal", "--basis", "constant,linear", "--no-cache", "-q", "--out", "-"});
  EXPECT_THAT(result.out, HasSubstr("antipodal/constant,"));
  EXPECT_THAT(result.out, HasSubstr("antipodal/linear,"));
  EXPECT_EQ(line_count(result.out), 5U);
}

}  // namespace
}  // namespace transillum::testing
