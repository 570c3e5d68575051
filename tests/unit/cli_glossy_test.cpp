// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `solve --glossy` as a program: the options that it cannot be combined with, its files and
// messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Arguments shining{"solve", "cornell-box", "-q", "-m", "24", "--lobe", "white=0.2,8"};

TEST(CliGlossy, IsRefusedInOneLineWhereItIsNotAvailable) {
  expect_all_refused(
      shining + Arguments{"--glossy"},
      {
          {{"--engine", "hemicube"}, "which have no directions"},
          {{"--engine", "pairs"}, "which have no directions"},
          {{"--one-way"}, "not available with one-way passes"},
          {{"--basis", "linear"}, "not available with a linear basis"},
          {{"--normalize", "symmetric"}, "not available with symmetric normalization"},
          {{"--scheme", "growing"}, "another scheme than fixed"},
          {{"--scheme", "semi-iterative"}, "another scheme than fixed"},
          {{"--scheme", "conjugate-gradients"}, "another scheme than fixed"},
          {{"--factors", "f.npz"}, "--factors: not used with --glossy"},
          {{"--by", "material"}, "--by: not used with --glossy"},
          {{"--series", "s.pvd"}, "--series: not used with --glossy"},
          {{"--checkpoint", "c.tck"}, "--checkpoint: not used with --glossy"},
          {{"--eye", "1,2"}, "three finite numbers X,Y,Z"},
          {{"--eye", "1,2,3"}, "--eye: used only with a .csv, .vtp, .ply, .png, .exr or .pfm file"},
          {{"--lobe", "white=0.5"}, "is not NAME=SHARE,EXPONENT"},
          {{"--lobe", "white=0.5,-1"}, "the exponent of the lobe (Ns) is -1"},
      });
  expect_refused(shining + Arguments{"--eye", "1,2,3"}, "--eye: used only with --glossy");
}

TEST(CliGlossy, WorksWithTheOtherOptions) {
  const Arguments options[] = {{"--normalize", "rows"},
                               {"--memory", "1k", "--iterations", "3"},
                               {"--sky", "1"},
                               {"--two-sided"},
                               {"--engine", "local"},
                               {"--engine", "zbuffer"},
                               {"--engine", "rays"},
                               {"--max-patch-area", "0.1"},
                               {"--sampling", "fibonacci"},
                               {"--rotate", "3"},
                               {"--replicas", "2"},
                               {"--first-shot", "0"}};
  for (const Arguments& option : options) {
    SCOPED_TRACE(::testing::PrintToString(option));
    expect_success(shining + Arguments{"--glossy"} + option);
  }
}

TEST(CliGlossy, ReachesAnAccuracy) {
  TemporaryFolder folder;
  const Arguments glossy{"solve",    "cornell-box", "--lobe",         "white=0.2,8",
                         "--glossy", "--stats",     folder / "s.json"};
  const ProgramResult result =
      run_program(glossy + Arguments{"--accuracy", "10%", "--tolerance", "1e-4"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("10 % asked, reached"));
  const auto json = read_json(folder / "s.json");
  EXPECT_EQ(json["accuracy"]["reached"], true);
  EXPECT_GT(json["glossy"]["patches"], 0);
  // Without one, the number of directions is not chosen by an accuracy.
  expect_success(glossy + Arguments{"-q", "--iterations", "1"});
  EXPECT_TRUE(read_json(folder / "s.json")["accuracy"].is_null());
}

TEST(CliGlossy, FilesHaveTheRadianceTowardAnEye) {
  TemporaryFolder folder;
  expect_success(shining + Arguments{"--glossy", "--eye", "0.3,0.3,0.1", "--out", folder / "r.csv",
                                     "--out", folder / "r.ply", "--out", folder / "r.vtp",
                                     "--stats", folder / "s.json"});
  EXPECT_THAT(read_file(folder / "r.csv"),
              HasSubstr(",rho_lobe_r,rho_lobe_g,rho_lobe_b,L_r,L_g,L_b\n"));
  EXPECT_THAT(read_file(folder / "r.ply"), HasSubstr("property double L_b\nend_header"));
  const auto json = read_json(folder / "s.json");
  EXPECT_EQ(json["options"]["glossy"], true);
  EXPECT_GT(json["glossy"]["patches"], 10);
  EXPECT_GT(json["glossy"]["transfer_bytes"], 0);
  EXPECT_LE(json["glossy"]["sum_defect"], 1e-13);
  EXPECT_NEAR(json["energy_balance"], 1, 0.05);
}

TEST(CliGlossy, DrawsAPictureFromAnEye) {
  TemporaryFolder folder;
  Arguments picture = shining;
  picture[0] = "picture";
  picture = picture + Arguments{"--eye", "-0.1,0.3,-0.5", "--target", "0.3,0.2,0.3", "--camera-up",
                                "0,1,0", "--size",        "24x18",    "--out"};
  expect_success(picture + Arguments{folder / "glossy.pfm", "--glossy"});
  expect_success(picture + Arguments{folder / "diffuse.pfm"});
  EXPECT_NE(read_file(folder / "glossy.pfm"), read_file(folder / "diffuse.pfm"));
  expect_refused(shining + Arguments{"--out", folder / "r.png"}, "a picture requires --eye X,Y,Z");
  expect_refused(shining + Arguments{"--target", "1,2,3", "--out", folder / "r.ply"},
                 "--target: used only with a .png, .exr or .pfm file");
}

TEST(CliGlossy, SaysWhatItDoesWithLobes) {
  const Arguments loud{"solve", "cornell-box", "-m", "16", "--lobe", "white=0.5,100"};
  EXPECT_THAT(run_program(loud).err, HasSubstr("lobes of materials are omitted (--glossy"));
  EXPECT_THAT(run_program(loud + Arguments{"-q"}).err, Not(HasSubstr("lobes")));
  // A metal, as materials of glTF are by default, is black.
  EXPECT_THAT(run_program(loud + Arguments{"--reflectance", "white=0"}).err,
              HasSubstr("white reflects nothing else: try --reflectance 'white=0.5'"));
  const ProgramResult glossy = run_program(loud + Arguments{"--glossy"});
  EXPECT_THAT(glossy.err, HasSubstr("too narrow for 16 passes"));
  EXPECT_THAT(glossy.err, HasSubstr("more than a surface can"));
  EXPECT_THAT(glossy.out, HasSubstr("sums over directions off by"));
  const ProgramResult none =
      run_program({"solve", "cornell-box", "-m", "16", "-q", "--glossy", "--out", "-"});
  EXPECT_THAT(none.err, HasSubstr("no material has a lobe"));
  EXPECT_EQ(none.out, run_program({"solve", "cornell-box", "-m", "16", "-q", "--out", "-"}).out);
}

/// Lobes that no set of directions resolves, and that reflect more than a surface can.
TEST(CliGlossy, SolvesWithAwkwardLobes) {
  TemporaryFolder folder;
  for (const char* lobe :
       {"white=3,1000000", "white=0.5,0", "white=1,96.078431", "white=1e-12,1e9"}) {
    SCOPED_TRACE(lobe);
    expect_success({"solve", "cornell-box", "-q", "-m", "24", "--lobe", lobe, "--glossy", "--stats",
                    folder / "s.json"});
    const auto json = read_json(folder / "s.json");
    EXPECT_EQ(json["converged"], true);
    EXPECT_LE(json["glossy"]["sum_defect"], 1e-13);
    EXPECT_LE(json["energy_defect"], 1e-12);
  }
}

/// A lobe that is omitted changes no bit.
TEST(CliGlossy, DiffuseSolvesIgnoreLobes) {
  const Arguments plain{"solve", "cornell-box", "-q", "-m", "24", "--out", "-"};
  EXPECT_EQ(run_program(shining + Arguments{"--out", "-"}).out, run_program(plain).out);
}

/// The solve of an OBJ with its MTL has the same bits.
TEST(CliGlossy, LobesAreWrittenAndRead) {
  TemporaryFolder folder;
  const std::string file = folder / "s.obj";
  expect_success({"scene", "cornell-box", "--lobe", "white=0.2,8", "--lobe", "red=0.1,0.2,0.3,2.5",
                  "--out", file});
  EXPECT_THAT(read_file(folder / "s.mtl"), HasSubstr("Ks 0.1 0.2 0.3\nNs 2.5\n"));
  const Arguments rest{"-q", "-m", "24", "--glossy", "--out", "-"};
  EXPECT_EQ(run_program(Arguments{"solve", file} + rest).out,
            run_program(Arguments{"solve", "cornell-box", "--lobe", "white=0.2,8", "--lobe",
                                  "red=0.1,0.2,0.3,2.5"} +
                        rest)
                .out);
}

}  // namespace
}  // namespace transillum::testing
