// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Options that would do nothing are refused; the same options are accepted where they have an
// effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program_call.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;

using Call = Arguments;

const Call by_directions{"solve", "furnace", "-q", "-m", "8"};
const Call by_hemicubes{"solve", "furnace", "-q", "--engine", "hemicube"};
const Call transfers{"transfers", "furnace", "--direction", "1,2,3"};
const Call map{"map", "furnace", "--direction", "1,2,3"};
const Call factors{"factors", "furnace"};
const Call study{"study", "furnace", "-q", "--no-cache", "-m", "8", "--sampling", "fibonacci"};
const Call by_pairs{"solve", "furnace", "-q", "--engine", "pairs"};
const Call study_hemicubes{"study", "furnace", "-q", "--no-cache", "--engines", "hemicube:16"};

/// A call, and options of which the last is not used.
struct Unused {
  Call call, options;
  std::string expected;
};

const Unused unused[] = {
    {by_directions, {"--resolution", "64"}, "--resolution: used only with engine zbuffer, painter"},
    {by_directions, {"--order", "newell"}, "--order: used only with engine painter"},
    {by_directions,
     {"--engine", "zbuffer", "--order", "bsp"},
     "--order: used only with engine painter"},
    {by_directions, {"--burn-in", "2"}, "--burn-in: used only with scheme semi-iterative"},
    {by_directions, {"--seed", "2"}, "--seed: used only with sampling random"},
    {by_directions, {"--seed", "1"}, "--seed: used only with"},
    {by_directions, {"--replicas", "2", "--rotate", "3", "--seed", "2"}, "--seed: used only with"},
    {by_directions,
     {"--scheme", "semi-iterative", "--sampling", "hammersley", "--seed", "2"},
     "--seed: used only with"},
    {by_hemicubes, {"--sampling", "fibonacci"}, "--sampling: not used with engine hemicube"},
    {by_hemicubes, {"--one-way"}, "--one-way: not used with engine hemicube"},
    {by_hemicubes, {"-m", "64"}, "--directions: not used with engine hemicube"},
    {by_hemicubes, {"--rotate", "2"}, "--rotate: not used with engine hemicube"},
    {by_hemicubes, {"--seed", "2"}, "--seed: used only with"},
    {by_pairs, {"-m", "64"}, "--directions: not used with engine hemicube or pairs"},
    {by_pairs, {"--resolution", "64"}, "--resolution: used only with"},
    {by_hemicubes, {"--points", "8"}, "--points: used only with engine pairs"},
    {by_directions,
     {"--first-shot", "none", "--points", "8"},
     "--points: used only with engine pairs and with a first shot"},
    {factors, {"--points", "8"}, "--points: used only with engine pairs"},
    {factors, {"--engine", "rays", "--points", "8"}, "--points: not used with engine rays"},
    {transfers, {"--resolution", "64"}, "--resolution: used only with"},
    {transfers, {"--order", "newell"}, "--order: used only with"},
    {map, {"--out", "m.svg", "--resolution", "64"}, "--resolution: used only with"},
    {map, {"--out", "m.svg", "--order", "newell"}, "--order: used only with"},
    {map, {"--out", "m.svg", "--receiver", "0", "--step", "3"}, "--step: used only with"},
    {map, {"--out", "m.svg", "--engine", "rays", "--step", "3"}, "--step: used only with"},
    {map, {"--out", "m.svg", "--difference"}, "--difference: used only with"},
    {map, {"--out", "m.json", "--size", "300"}, "--size: used only with .svg, .pdf and .png"},
    {factors, {"--rays", "10"}, "--rays: used only with engine rays"},
    {factors, {"--resolution", "10"}, "--resolution: used only with"},
    {factors, {"--seed", "2"}, "--seed: used only with"},
    {factors, {"--engine", "rays", "-m", "8"}, "--directions: not used with engine rays"},
    {factors, {"--engine", "rays", "--sampling", "random"}, "--sampling: not used with"},
    {factors, {"--engine", "rays", "--rotate", "2"}, "--rotate: not used with engine rays"},
    {factors, {"--engine", "rays", "--resolution", "8"}, "--resolution: not used with"},
    {factors, {"--engine", "rays", "--memory", "1G"}, "--memory: not used with engine rays"},
    {factors, {"--engine", "hemicube", "-m", "8"}, "--directions: not used with engine hemicube"},
    {factors, {"--engine", "hemicube", "--sampling", "random"}, "--sampling: not used with"},
    {factors, {"--engine", "hemicube", "--seed", "2"}, "--seed: used only with"},
    {{"directions", "-m", "4"}, {"--seed", "2"}, "--seed: used only with sampling random, sobol"},
    {{"bounds"}, {"--seed", "2"}, "--seed: used only with sampling"},
    {{"bounds"}, {"--two-sided"}, "--two-sided: used only with a SCENE"},
    {{"bounds"}, {"--max-patch-area", "1"}, "--max-patch-area: used only with a SCENE"},
    {{"bounds"}, {"-m", "64"}, "--directions: used only with a SCENE or --reflectance"},
    {{"bounds"}, {"--tolerance", "0.1"}, "--tolerance: used only with a SCENE or --reflectance"},
    {study, {"--seed", "2"}, "--seed: used only with"},
    {study, {"--resolution", "64"}, "--resolution: used only with"},
    {study, {"--order", "newell"}, "--order: used only with"},
    {study, {"--engines", "zbuffer:64", "--resolution", "32"}, "every engine has its own"},
    {study, {"--against", "seconds"}, "--against: used only with --plot"},
    {study_hemicubes, {"--one-way"}, "--one-way: not used with engine hemicube"},
    {study_hemicubes, {"--sampling", "random"}, "--sampling: not used with engine hemicube"},
    {study_hemicubes, {"--rotations", "2"}, "--rotations: not used with engine hemicube"},
};

TEST(CliUnusedOptions, AreRefused) {
  const TemporaryFolder folder;
  for (const Unused& one : unused) {
    expect_refused(one.call + one.options, one.expected, folder.path().string());
  }
  EXPECT_THAT(folder.names(), ::testing::IsEmpty());
}

TEST(CliUnusedOptions, AreAcceptedWhereTheyHaveAnEffect) {
  const Call calls[] = {
      by_directions + Call{"--engine", "rays", "--resolution", "64", "--seed", "2"},
      by_directions + Call{"--engine", "painter", "--order", "newell", "--resolution", "64"},
      by_directions + Call{"--sampling", "sobol", "--seed", "2", "--one-way"},
      by_directions + Call{"--replicas", "2", "--seed", "2"},
      by_directions +
          Call{"--scheme", "semi-iterative", "--iterations", "9", "--burn-in", "2", "--seed", "2"},
      by_directions + Call{"--points", "8"},
      by_hemicubes + Call{"--resolution", "16", "--iterations", "3", "--scheme", "fixed"},
      factors + Call{"--engine", "zbuffer", "-m", "8", "--resolution", "64"},
      factors + Call{"--engine", "rays", "--rays", "10", "--seed", "2"},
      by_pairs + Call{"--points", "16", "--iterations", "3", "--scheme", "fixed"},
      factors + Call{"--engine", "pairs", "--points", "16"},
      factors + Call{"--engine", "hemicube", "--resolution", "16"},
      map + Call{"--out", "m.svg", "--out", "m.json", "--size", "300"},
      {"directions", "-m", "4", "--sampling", "random", "--seed", "2"},
      {"bounds", "--reflectance", "0.5", "-m", "64", "--tolerance", "0.1"},
      study + Call{"--rotations", "2", "--seed", "2"},
      study + Call{"--engines", "fast,zbuffer:64,painter", "--resolution", "32", "--order", "bsp"},
  };
  const TemporaryFolder folder;
  for (const Call& arguments : calls) {
    expect_success(arguments, folder.path().string());
  }
}

TEST(CliUnusedOptions, ZbufferFormFactorsDependOnTheResolution) {
  const auto with = [](const std::string& resolution) {
    return run_program(factors + Call{"--engine", "zbuffer", "-m", "8", "--resolution", resolution})
        .out;
  };
  EXPECT_NE(with("16"), with("64"));
}

}  // namespace
}  // namespace transillum::testing
