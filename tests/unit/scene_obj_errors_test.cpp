// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Errors of the OBJ and MTL readers: each malformed file gives one line with file, line and reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_test_support.h"
#include "support/canceled.h"

namespace transillum::scene_obj_errors_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string white = "newmtl white\nKd .7 .7 .7\n";

struct Row {
  const char* name;
  std::string obj;
  std::string mtl;
  std::vector<std::string> expected;  ///< parts of the message
};

std::vector<Row> obj_rows() {
  return {
      {"Empty", "", "", {"s.obj: no vertices"}},
      {"OnlyComments", "# nothing\n\n", "", {"s.obj: no vertices"}},
      {"NoFaces", square, "", {"s.obj: no faces"}},
      {"Html", "<html>\n<body>hello</body>\n", "", {"s.obj: no vertices", "is it an OBJ file?"}},
      {"Binary", std::string("v 0 0 0\n\0\1\2", 11), "", {"s.obj: a binary file"}},
      {"NotANumber", "v 0 0 0\nv 1 x 0\n", "", {"s.obj:2: vertex 2: `x` is not a number"}},
      {"HalfANumber", "v 0 0 1.5abc\n", "", {"s.obj:1: vertex 1: `1.5abc` is not a number"}},
      {"CommaNumber", "v 0,5 0 1\n", "", {"s.obj:1: vertex 1: `0,5` is not a number"}},
      {"Nan", "\n\nv 0 nan 0\n", "", {"s.obj:3: vertex 1: `nan` is not a finite"}},
      {"Infinity", "v 0 0 -inf\n", "", {"s.obj:1: vertex 1: `-inf` is not a finite"}},
      {"Overflow", "v 0 0 1e999\n", "", {"s.obj:1: vertex 1: `1e999` is not a finite"}},
      {"TooLarge", "v 0 0 1e200\n", "", {"s.obj:1: vertex 1: `1e200`"}},
      {"TwoCoordinates", "v 0 0\n", "", {"s.obj:1: vertex 1: three coordinates are required"}},
      {"IndexTooLarge",
       square + "f 1 2 3\nf 1 2 5\n",
       "",
       {"s.obj:6: face 1: vertex index 5 is out of range; there are 4 vertices"}},
      {"IndexZero", square + "f 0 1 2\n", "", {"s.obj:5: face 0: vertex index 0 is out of range"}},
      {"IndexTooNegative",
       square + "f -5 -1 -2\n",
       "",
       {"s.obj:5: face 0: vertex index -5 is out of range"}},
      {"IndexBeyondInt",
       square + "f 1 2 4294967297\n",
       "",
       {"s.obj:5: face 0: vertex index 4294967297 is out of range"}},
      {"IndexBeyondAll",
       square + "f 1 2 99999999999999999999999999\n",
       "",
       {"s.obj:5: face 0: vertex index 9999999999"}},
      {"CornerGarbage", square + "f 1 2 three\n", "", {"s.obj:5: face 0: `three` is not a corner"}},
      {"CornerSlashes",
       square + "f 1/1/1/1 2 3\n",
       "",
       {"s.obj:5: face 0: `1/1/1/1` is not a corner"}},
      {"CornerOnlySlash", square + "f / 2 3\n", "", {"s.obj:5: face 0: `/` is not a corner"}},
      {"CornerWithFormFeed", square + "f 1 2 3\f9\n", "", {"s.obj:5: face 0: vertex index 9"}},
      {"ContinuedLine", square + "f 1 2 \\\n 3 9\n", "", {"s.obj:5: face 0: vertex index 9"}},
      {"NoArea",
       "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n",
       "",
       {"s.obj:4: face 0: no area; the scene has no patches"}},
      {"TwoCorners",
       square + "f 1 2\n",
       "",
       {"s.obj:5: face 0: 2 corners, but at least 3 are required; the scene has no patches"}},
      {"ManyWithoutArea",
       square + "f 1\nf 1 2 1\n",
       "",
       {"s.obj:5: face 0: 1 corner, but at least 3 are required, and no other face has an area"}},
  };
}

std::vector<Row> mtl_rows() {
  const std::string lib = "mtllib s.mtl\n";
  return {
      {"MtlIsAFolder", "mtllib .\n" + square + "f 1 2 3\n", "", {"not a regular file"}},
      {"ReflectanceNegative",
       lib + square + "usemtl white\nf 1 2 3\n",
       "\nnewmtl white\nKd .5 .5 -.1\n",
       {"s.mtl:2: material `white`: blue reflectance rho (Kd) is -0.1"}},
      {"ReflectanceNan",
       lib + square + "usemtl white\nf 1 2 3\n",
       "newmtl white\nKd .5 nan .1\n",
       {"s.mtl:1: material `white`: green reflectance rho (Kd) is nan"}},
      {"ExitanceNegative",
       lib + square + "usemtl lamp\nf 1 2 3\n",
       "newmtl lamp\nKd .5 .5 .5\nKe 1 -2 3\n",
       {"s.mtl:1: material `lamp`: green exitance E (Ke) is -2"}},
      {"ExitanceInfinite",
       lib + square + "usemtl lamp\nf 1 2 3\n",
       "newmtl lamp\nKd .5 .5 .5\nKe 1 2 1e400\n",
       {"blue exitance E (Ke) is inf"}},
      {"ExitanceTooLarge",
       lib + square + "usemtl lamp\nf 1 2 3\n",
       "newmtl lamp\nKd .5 .5 .5\nKe 1 2 1e171\n",
       {"blue exitance E (Ke) is 1e+171, but must be >= 0 and at most 1e+170"}},
      {"ExitanceTooSmall",
       lib + square + "usemtl lamp\nf 1 2 3\n",
       "newmtl lamp\nKd .5 .5 .5\nKe 1e-171 0 0\n",
       {"s.obj: the largest exitance E is 1e-171, but must be 0 or at least 1e-170"}},
      {"KdGarbage",
       lib + square + "usemtl w\nf 1 2 3\n",
       "newmtl w\nKd spectral file.rfl\n",
       {"s.mtl:2: material `w`: Kd requires three numbers"}},
      {"KdWord",
       lib + square + "usemtl w\nf 1 2 3\n",
       "newmtl w\nKd .5 half .5\n",
       {"s.mtl:2: material `w`: Kd `half` is not a number"}},
      {"KdBeforeNewmtl",
       lib + square + "f 1 2 3\n",
       "Kd .5 .5 .5\n",
       {"s.mtl:1: Kd comes before any newmtl"}},
  };
}

class ObjErrors : public ::testing::TestWithParam<Row> {};

TEST_P(ObjErrors, NamePlaceAndReason) {
  const Row& row = GetParam();
  const test::TemporaryFolder folder;
  const std::string file = folder.write("s.obj", row.obj);
  if (!row.mtl.empty()) {
    folder.write("s.mtl", row.mtl);
  }
  const std::string message = test::refusal([&] { load_scene(file); });
  EXPECT_THAT(message, StartsWith(folder.path().string() + "/"));
  for (const std::string& part : row.expected) {
    EXPECT_THAT(message, HasSubstr(part));
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

INSTANTIATE_TEST_SUITE_P(Obj, ObjErrors, ::testing::ValuesIn(obj_rows()),
                         [](const auto& row) { return row.param.name; });
INSTANTIATE_TEST_SUITE_P(Mtl, ObjErrors, ::testing::ValuesIn(mtl_rows()),
                         [](const auto& row) { return row.param.name; });

TEST(ObjFile, MissingIsReported) {
  EXPECT_EQ(test::refusal([] { load_scene("nowhere/gone.obj"); }),
            "nowhere/gone.obj: no such file");
}

TEST(ObjFile, OtherFormatIsReported) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("s.step", "solid\n");
  EXPECT_THAT(test::refusal([&] { load_scene(file); }),
              HasSubstr(file + ": not a scene file; scene files end in .obj, "));
}

TEST(ObjFile, FolderIsReported) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "d.obj");
  EXPECT_THAT(test::refusal([&] { load_scene((folder.path() / "d.obj").string()); }),
              HasSubstr("d.obj: not a regular file"));
}

TEST(ObjFile, TwoGigabytesAreRefusedUnread) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("s.obj", "v 0 0 0\n");
  std::filesystem::resize_file(file, std::uintmax_t{2} << 30);  // a sparse file: uses no disk space
  EXPECT_THAT(test::refusal([&] { load_scene(file); }),
              HasSubstr("s.obj: file has 2147483648 bytes; the limit is 1073741824"));
}

TEST(ObjFile, FaceWithManyCornersNeitherHangsNorCrashes) {
  const test::TemporaryFolder folder;
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf";
  for (int i = 0; i < 300'000; ++i) {
    text += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
  }
  EXPECT_THAT(test::refusal([&] { load_scene(folder.write("s.obj", text + "\n")); }),
              HasSubstr("s.obj:4: face 0: the outline crosses itself and cannot be split; "
                        "the scene has no patches"));
}

TEST(ObjFile, LongLineOfGarbageNeitherHangsNorCrashes) {
  const test::TemporaryFolder folder;
  const std::string garbage(8'000'000, '/');
  const std::string message =
      test::refusal([&] { load_scene(folder.write("s.obj", "v 0 0 0\nf " + garbage)); });
  EXPECT_THAT(message, HasSubstr("s.obj:2: face 0: `//////"));
  EXPECT_LT(message.size(), 400u);
}

TEST(ObjFile, ReadingStopsWhenCanceled) {
  const test::TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 10'000; ++i) {
    text += "v 0 0 0\n";
  }
  EXPECT_THROW(load_scene(folder.write("s.obj", text), {}, {}, testing::canceled()), Canceled);
}

}  // namespace
}  // namespace transillum::scene_obj_errors_test
