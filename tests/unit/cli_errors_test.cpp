// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Invalid arguments and scenes: exit status 2, one line on stderr, and no output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<Refusal> invalid_calls{
    {{}, "no command given"},
    {{"solv"}, "did you mean \"solve\"?"},
    {{"factor"}, "did you mean \"factors\"?"},
    {{"factors"}, "SCENE is required"},
    {{"factors", "furnace", "--rays", "0"}, "--rays: \"0\""},
    {{"factors", "furnace", "--engine", "ray"}, "rays"},
    {{"factors", "furnace", "--out", "/no/such/folder/f.csv"}, "/no/such/folder"},
    {{"--versoin"}, "did you mean \"--version\"?"},
    {{"--bogus"}, "unknown option \"--bogus\""},
    {{"solve"}, "SCENE is required"},
    {{"solve", "furnace", "extra"}, "unexpected argument \"extra\""},
    {{"solve", "furnace", "--iteration", "3"}, "did you mean \"--iterations\"?"},
    {{"solve", "furnace", "-m"}, "--directions"},
    {{"solve", "furnace", "-m", "0"}, "--directions: \"0\""},
    {{"solve", "furnace", "-m", "-5"}, "--directions: \"-5\""},
    {{"solve", "furnace", "-m", "16777217"}, "from 1 to 16777216"},
    {{"solve", "furnace", "-m", "99999999999999999999"}, "--directions"},
    {{"solve", "furnace", "-m", "10x"}, "--directions: \"10x\""},
    {{"solve", "furnace", "-m", "1e3"}, "--directions"},
    {{"solve", "furnace", "--sampling", "fibonaci"}, "fibonacci"},
    {{"solve", "furnace", "--seed", "-1"}, "--seed"},
    {{"solve", "furnace", "--rotate", "x"}, "--rotate"},
    {{"solve", "furnace", "--seed", "18446744073709551616"}, "--seed"},
    {{"solve", "furnace", "--engine", "magic"}, "local"},
    {{"solve", "furnace", "--lines", "10"}, "unknown option \"--lines\""},
    {{"solve", "furnace", "--engine", "zbuffer", "--resolution", "0"}, "--resolution: \"0\""},
    {{"transfers", "furnace", "--resolution", "16385"}, "from 1 to 16384"},
    {{"map", "furnace", "--direction", "1,0,0", "--engine", "fast", "--out", "f.png"}, "no map"},
    {{"map", "furnace", "--direction", "1,0,0", "--engine", "fast", "--out", "f.png"}, "or rays\n"},
    {{"map", "furnace", "--direction", "1,0,0", "--engine", "corrected", "--out", "f.png"},
     "or rays (the viewer can show it)"},
    {{"map", "furnace", "--resolution", "1025"}, "from 1 to 1024"},
    {{"solve", "furnace", "--engine", "painter", "--order", "depth"}, "bsp, newell"},
    {{"transfers", "furnace", "--direction", "1,2,3", "--engine", "pairs"}, "no directions"},
    {{"solve", "furnace", "--engine", "pairs", "--points", "0"}, "from 1 to 1024"},
    {{"factors", "furnace", "--engine", "pairs", "--points", "1025"}, "from 1 to 1024"},
    {{"solve", "furnace", "--engine", "pairs", "--scheme", "growing"}, "no directions"},
    {{"study", "furnace", "--engines", "pairs:2000"}, "from 1 to 1024"},
    {{"factors", "furnace", "--engine", "hemicube", "--resolution", "31"}, "even"},
    {{"solve", "furnace", "--engine", "hemicube", "--resolution", "4096"}, "from 2 to 2048"},
    {{"solve", "furnace", "--engine", "hemicube", "--replicas", "4"}, "no directions"},
    {{"solve", "furnace", "--iterations", "3", "--tolerance", "1e-3"},
     "--tolerance: not used with a given number of iterations"},
    {{"solve", "furnace", "--iterations", "0"}, "--iterations"},
    {{"solve", "furnace", "--tolerance", "nan"}, "--tolerance"},
    {{"solve", "furnace", "--tolerance", "1"}, "--tolerance"},
    {{"solve", "furnace", "--normalize", "columns"}, "none, rows, symmetric"},
    {{"solve", "furnace", "--first-shot", "maybe"}, "none, auto or a number"},
    {{"solve", "furnace", "--scheme", "fast"}, "fixed, growing, semi-iterative"},
    {{"solve", "furnace", "--scheme", "semi-iterative", "--burn-in", "9", "--iterations", "9"},
     "burn-in: 9 of 9"},
    {{"solve", "furnace", "--replicas", "9", "-m", "8"}, "replicas: 9"},
    {{"solve", "furnace", "--max-patch-area", "0"}, "--max-patch-area"},
    {{"solve", "furnace", "--max-patch-area", "inf"}, "--max-patch-area"},
    {{"solve", "furnace", "--memory", "2Q"}, "--memory: \"2Q\""},
    {{"solve", "furnace", "--memory", "-1"}, "--memory"},
    {{"solve", "furnace", "--memory", "99999999999T"}, "--memory"},
    {{"solve", "furnace", "--memory", "nan"}, "--memory"},
    {{"solve", "furnace", "--threads", "0"}, "--threads"},
    {{"solve", "furnace", "--threads", "100000"}, "--threads"},
    {{"solve", "furnace", "--out", "a.txt"},
     "must end in .csv, .vtp, .ply, .glb or .gltf, the name of a picture in .png"},
    {{"solve", "furnace", "--out", "/no/such/folder/a.csv"}, "/no/such/folder"},
    {{"solve", "furnace", "--out", "a.csv", "--out", "./a.csv"}, "given twice"},
    {{"solve", "furnace", "--stats", "/no/such/folder/a.json"}, "/no/such/folder"},
    {{"solve", "furnace", "--stats", "a.csv"},
     "a.csv: the name of a statistics file must end in .json"},
    {{"solve", "no-such-scene.obj"}, "no-such-scene.obj"},
    {{"solve", "cornel-box"}, "cornell-box"},
    {{"solve", "rooms:m=3"}, "rooms"},
    {{"solve", ""}, "SCENE: the value is empty"},
    {{"info", "no-such-scene.obj"}, "no-such-scene.obj"},
    {{"scene", "furnace"}, "--out is required"},
    {{"scene", "furnace", "--out", "a.stl"}, ".obj"},
    {{"transfers", "furnace"}, "--direction is required"},
    {{"transfers", "furnace", "--direction", "0,0,0"}, "not all 0"},
    {{"transfers", "furnace", "--direction", "1,2"}, "three finite numbers"},
    {{"transfers", "furnace", "--direction", "1,2,3,4"}, "three finite numbers"},
    {{"transfers", "furnace", "--direction", "1,,3"}, "three finite numbers"},
    {{"transfers", "furnace", "--direction", "nan,0,1"}, "three finite numbers"},
    {{"transfers", "furnace", "--direction", "1e999,0,1"}, "three finite numbers"},
    {{"transfers", "furnace", "--direction", "-inf,0,1"}, "three finite numbers"},
    {{"map", "furnace"}, "is required"},
    {{"map", "furnace", "--direction", "0,0,1"}, "--out is required"},
    {{"map", "furnace", "--out", "m.svg"}, "--direction is required"},
    {{"map", "furnace", "--direction", "0,0,1", "--out", "m.eps"},
     ".svg, .pdf, .png, .vtp or .json"},
    {{"map", "furnace", "--direction", "0,0,0", "--out", "m.svg"}, "not all 0"},
    {{"map", "furnace", "--direction", "0,0,1", "--receiver", "77", "--out", "m.svg"},
     "no patch 77; patches are numbered 0 to 11"},
    {{"map", "furnace", "--direction", "0,0,1", "--receiver", "-1", "--out", "m.svg"},
     "--receiver"},
    {{"map", "furnace", "--direction", "1,2,3", "--step", "13", "--out", "m.svg"},
     "--step: no step 13; the steps of this direction are 0 to 12"},
    {{"map", "furnace", "--direction", "0,0,1", "--step", "-1", "--out", "m.svg"}, "--step"},
    {{"map", "furnace", "--direction", "0,0,1", "--size", "10", "--out", "m.svg"}, "--size"},
    {{"map", "furnace", "--direction", "0,0,1", "--size", "5cm", "--out", "m.pdf"},
     "--size: 5cm is too small for m.pdf: its title and legend take 12.5cm"},
    {{"map", "furnace", "--direction", "0,0,1", "--engine", "zbuffer", "--size", "15cm", "--out",
      "m.svg"},
     "--size: 15cm is too small for m.svg: its title and legend take 15.9cm"},
    {{"map", "furnace", "--direction", "0,0,1", "--size", "0cm", "--out", "m.pdf"},
     "--size: \"0\""},
    {{"map", "furnace", "--direction", "0,0,1", "--out", "/no/such/folder/m.svg"},
     "/no/such/folder"},
    {{"directions", "-m", "0"}, "--directions"},
    {{"directions", "-m", "4", "--sampling", "sobl"}, "sampling"},
    {{"directions", "--scene", "furnace"}, "--stats"},
    {{"directions", "-m", "2000000", "--stats"}, "--stats"},
    {{"directions", "--stats", "d.txt"}, ".json"},
    {{"directions", "--stats", "--scene", "nowhere.obj"}, "nowhere.obj"},
    {{"bounds", "--reflectance", "1"}, "--reflectance"},
    {{"bounds", "--accuracy", "0"}, "--accuracy"},
    {{"bounds", "--size-ratio", "nan"}, "--size-ratio"},
    {{"bounds", "--out", "b.txt"}, ".json"},
    {{"solve", "furnace", "--tolerance", "0"}, "\"0\" is not greater than 0 and less than 1"},
    {{"solve", "furnace", "--first-shot", "-1"}, "--first-shot: \"-1\" is not none, auto or"},
    {{"study", "furnace", "--first-shot", "-1"}, "--first-shot: \"-1\" is not none, auto or"},
    {{"solve", "furnace", "-m", "1", "-m", "2"}, "--directions: given 2 times, but it has one"},
    {{"solve", "furnace", "furnace"}, "unexpected argument"},
};

TEST(CliErrors, InvalidArgumentsGiveOneLineAndStatus2) { expect_all_refused({}, invalid_calls); }

TEST(CliErrors, InvalidScenesAreRefusedAndOutputFilesKept) {
  const TemporaryFolder folder;
  const std::string result = folder / "result.csv";
  const std::string scenes[] = {
      "",                                        // no vertices
      "v 0 0 0\nv 1 0 0\nv 0 1 0\n",             // no faces
      "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",  // not finite
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",    // no such vertex
  };
  for (const std::string& text : scenes) {
    write_text(folder / "bad.obj", text);
    write_text(result, "as it was");
    expect_refused({"solve", folder / "bad.obj", "--out", result}, "bad.obj");
    EXPECT_EQ(read_file(result), "as it was");
    EXPECT_THAT(folder.names(), ::testing::ElementsAre("bad.obj", "result.csv"));
  }
}

/// A failed solve names the option that may help.
void expect_hint(const std::vector<std::string>& arguments, int status, const std::string& text,
                 const std::string& hint) {
  SCOPED_TRACE(::testing::PrintToString(arguments));
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, status);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(line_count(result.err), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr(text));
  EXPECT_THAT(result.err, HasSubstr(hint));
}

TEST(CliErrors, HintsNameTheOption) {
  expect_hint(
      {"solve", "furnace", "-q", "-m", "9", "--memory", "1", "--scheme", "conjugate-gradients"}, 1,
      "the scheme conjugate-gradients requires kept form factors", " (try a larger --memory)");
  expect_hint({"solve", "furnace", "-q", "-m", "9", "--memory", "1", "--normalize", "symmetric"}, 1,
              "the symmetric normalization requires kept form factors", " (try a larger --memory)");
  expect_hint({"factors", "furnace", "-m", "9", "--memory", "1"}, 1,
              "the form factors exceed the memory limit", " (try a larger --memory)");
  expect_hint({"factors", "furnace", "--engine", "hemicube", "--memory", "1"}, 1,
              "the form factors exceed the memory limit", " (try a larger --memory)");
  expect_hint({"solve", "furnace", "--engine", "pairs", "--memory", "1", "-q"}, 1,
              "the form factors exceed the memory limit", " (try a larger --memory)");
  expect_hint({"transfers", "furnace", "--direction", "1,2,3", "--engine", "hemicube"}, 2,
              "has no directions", " (try solve, factors or study)");
}

TEST(CliErrors, HintsForDivergenceNameDirectionsAndNormalization) {
  const TemporaryFolder folder;
  const std::string scene = folder / "bright.obj";
  expect_success({"scene", "furnace", "--out", scene});
  write_text(folder / "bright.mtl", "newmtl glowing\nKd 0.99 0.99 0.99\nKe 1 1 1\n");
  expect_hint({"solve", scene, "-q", "-m", "1"}, 1, "does not converge for M = 1",
              " (try more directions with -m, or --normalize rows)");
}

TEST(CliErrors, SceneFileIsNotOverwritten) {
  const TemporaryFolder folder;
  const std::string scene = folder / "furnace.vtp";
  expect_success({"solve", "furnace", "-m", "8", "-q", "--out", scene});
  const std::string before = read_file(scene);
  expect_refused({"solve", scene, "--out", scene}, "would overwrite the input file");
  EXPECT_EQ(read_file(scene), before);
}

TEST(CliErrors, ControlCharactersDoNotBreakTheLine) {
  expect_refused({"solve", "two\nlines\x1b[31m.obj"}, "two");
}

}  // namespace
}  // namespace transillum::testing
