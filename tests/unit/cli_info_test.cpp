// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum info`, and `--orient`: closed and open scenes, faces seen from behind, overlaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::HasSubstr;

TEST(CliInfo, ReportsCountsClosednessAndReversedFaces) {
  const ProgramResult closed = expect_success({"info", "furnace"});
  EXPECT_THAT(closed.out, ::testing::ContainsRegex("faces +12\n"));
  EXPECT_THAT(closed.out, ::testing::ContainsRegex("closed +yes"));
  EXPECT_THAT(closed.out, ::testing::ContainsRegex("seen from behind +no face"));

  const TemporaryFolder folder;
  write_text(folder / "one.mtl", "newmtl gray\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
  write_text(folder / "one.obj",
             "mtllib one.mtl\nusemtl gray\n"
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
             "f 1 2 3 4\nf 5 6 7 8\n");  // both face up
  const ProgramResult open = expect_success({"info", folder / "one.obj"});
  EXPECT_THAT(open.out, ::testing::ContainsRegex("closed +no"));
  EXPECT_THAT(open.out,
              ::testing::ContainsRegex(
                  "seen from behind +100 % of what light meets are backs\n"
                  " +material \"gray\": 100 % of what light meets of it, 100 % of all\n"));
  EXPECT_THAT(open.out, HasSubstr("--orient auto"));
  const ProgramResult exact =
      run_program({"info", folder / "one.obj", "--directions", "64", "--threads", "1"});
  EXPECT_THAT(exact.out, ::testing::ContainsRegex("along directions +1 face seen from behind\n"
                                                  " +material \"gray\": 1 face, [0-9]+ %"));
}

/// The outer sides of a room are not open to anything.
TEST(CliInfo, ReportsASealedRoomWithTwoSidedFacesAsClosed) {
  const ProgramResult sealed = expect_success({"info", "cornell-box", "--two-sided", "-m", "8"});
  EXPECT_THAT(sealed.out, ::testing::ContainsRegex("closed +yes"));
  EXPECT_THAT(sealed.out, ::testing::ContainsRegex("along directions +0 % of the projected area"));
  EXPECT_THAT(run_program({"info", "cornell-box:open=1", "--two-sided"}).out,
              ::testing::ContainsRegex("closed +no, [0-9]+ % of the rays"));
  EXPECT_THAT(run_program({"solve", "cornell-box", "--two-sided", "-m", "8"}).out,
              HasSubstr("0 % of the projected area sees no patch, outer sides of two-sided faces"));
  EXPECT_THAT(run_program({"solve", "cornell-box:open=1", "-m", "8"}).out,
              ::testing::AllOf(
                  ::testing::Not(HasSubstr("closure defect")),
                  ::testing::ContainsRegex("open +[0-9.]+ % of the light escapes; [0-9.]+ % of the "
                                           "projected area sees no patch\n")));
}

/// The six faces of a cube with a lamp as its ceiling; the text of the faces to turn is reversed.
std::string room_obj(const std::vector<int>& turned) {
  const std::vector<std::vector<int>> faces{{1, 2, 3, 4}, {1, 5, 6, 2}, {2, 6, 7, 3},
                                            {3, 7, 8, 4}, {4, 8, 5, 1}, {5, 8, 7, 6}};
  std::string text =
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  for (int f = 0; f < 6; ++f) {
    auto outline = faces[static_cast<std::size_t>(f)];
    if (std::find(turned.begin(), turned.end(), f) != turned.end()) {
      std::reverse(outline.begin(), outline.end());
    }
    text += f == 5 ? "usemtl lamp\nf" : "usemtl a\nf";
    for (const int p : outline) {
      text += " " + std::to_string(p);
    }
    text += "\n";
  }
  return text;
}

TEST(CliOrient, SolvesTurnedRoomsLikeTheOriginal) {
  const TemporaryFolder folder;
  write_text(folder / "m.mtl", "newmtl a\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
  const auto solve_room = [&](const std::vector<int>& turned, const std::string& orient) {
    write_text(folder / "room.obj", room_obj(turned));
    return run_program(
        {"solve", folder / "room.obj", "-m", "64", "--orient", orient, "--out", "-"});
  };
  const ProgramResult original = solve_room({}, "keep");
  EXPECT_EQ(original.status, 0) << original.err;
  EXPECT_THAT(original.err, ::testing::Not(HasSubstr("--orient")));
  EXPECT_THAT(solve_room({}, "auto").err, HasSubstr("no face is turned"));
  for (const std::vector<int>& turned :
       {std::vector<int>{0, 1, 2, 3, 4, 5}, std::vector<int>{2}, std::vector<int>{5}}) {
    const ProgramResult kept = solve_room(turned, "keep");
    EXPECT_THAT(kept.err,
                ::testing::ContainsRegex("warning: [0-9]+ % of what light meets are backs"));
    EXPECT_THAT(kept.err, HasSubstr("--orient auto"));
    EXPECT_NE(kept.out, original.out);
    const ProgramResult repaired = solve_room(turned, "auto");
    EXPECT_EQ(repaired.status, 0) << repaired.err;
    EXPECT_EQ(repaired.out, original.out);
    EXPECT_THAT(repaired.err, HasSubstr(std::to_string(turned.size()) + " turned"));
  }
  expect_refused({"solve", folder / "room.obj", "--orient", "inward"},
                 "\"inward\" is neither keep nor auto");
}

/// Points of a box, and its six faces, counter-clockwise seen from outside.
std::string box_obj(double low, double high, int first_vertex) {
  std::ostringstream text;
  for (int k = 0; k < 8; ++k) {
    text << "v " << (k % 2 == 0 ? low : high) << ' ' << (k / 2 % 2 == 0 ? low : high) << ' '
         << (k / 4 == 0 ? low : high) << '\n';
  }
  for (const auto& face :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    text << 'f';
    for (const int k : face) {
      text << ' ' << first_vertex + k;
    }
    text << '\n';
  }
  return text.str();
}

/// A triangle whose material is metallic by default.
constexpr const char* metal = R"({"asset": {"version": "2.0"}, "scene": 0,
"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
"materials": [{"name": "steel", "pbrMetallicRoughness": {}}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

TEST(CliInfo, SuggestsAReflectanceForAMetal) {
  const TemporaryFolder folder;
  write_text(folder / "metal.gltf", metal);
  const ProgramResult info = run_program({"info", folder / "metal.gltf"});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("reflectance; rho = 0"));
  EXPECT_THAT(info.out, HasSubstr("(try --reflectance NAME=R)"));
  EXPECT_THAT(run_program({"info", folder / "metal.gltf", "--reflectance", "steel=0.5"}).out,
              HasSubstr("rho max            0.5"));
}

/// A hollow model is treated as a room and turned inward; the sky then meets only its backs.
TEST(CliOrient, SaysWhereASkyLightsNoFace) {
  const TemporaryFolder folder;
  write_text(folder / "shells.obj", box_obj(-1, 1, 1) + box_obj(-.5, .5, 9));
  const auto solve = [&](const Arguments& more) {
    return run_program(
        Arguments{"solve", folder / "shells.obj", "-m", "32", "--sky", "1", "--out", "-"} + more);
  };
  EXPECT_THAT(solve({}).err, ::testing::Not(HasSubstr("the sky lights no face")));
  const ProgramResult turned = solve({"--orient", "auto"});
  EXPECT_EQ(turned.status, 0);
  EXPECT_THAT(turned.out, HasSubstr("0,0,4,0,0,0,0.5,0.5,0.5,0,0,0,")) << "B is 0";
  EXPECT_THAT(turned.err, HasSubstr("warning: the sky lights no face"));
  EXPECT_THAT(turned.err, HasSubstr("(try --two-sided, or --orient auto or keep)"));
  const ProgramResult two_sided = solve({"--orient", "auto", "--two-sided"});
  EXPECT_THAT(two_sided.err, ::testing::Not(HasSubstr("the sky lights no face")));
}

/// Light of a face that is removed was lost silently.
TEST(CliInfo, SaysThatAChangedFaceIsRemoved) {
  const TemporaryFolder folder;
  write_text(folder / "boxes.obj", box_obj(0, 4, 1) + box_obj(1, 2, 9));
  for (const auto& [face, is_removed] : {std::pair{"face:8", true}, std::pair{"face:2", false}}) {
    const ProgramResult solved =
        run_program({"solve", folder / "boxes.obj", "--solids", "union", "--sky", "1", "-m", "16",
                     "--emission", std::string(face) + "=10"});
    EXPECT_EQ(solved.status, 0) << solved.err;
    EXPECT_EQ(solved.err.find("warning: " + std::string(face) + " is changed, but removed") !=
                  std::string::npos,
              is_removed)
        << solved.err;
  }
}

/// A terrain whose faces point down. B was 0 silently.
TEST(CliOrient, SaysThatTheSunLightsNoFaceThatIsTurnedAway) {
  const TemporaryFolder folder;
  write_text(folder / "terrain.obj",
             "v 0 0 0\nv 2 0 0\nv 4 0 0\nv 0 2 0\nv 2 2 1\nv 4 2 0\nf 4 5 2 1\nf 5 6 3 2\n");
  for (const char* orient : {"auto", "keep"}) {
    const ProgramResult solved =
        run_program({"solve", folder / "terrain.obj", "-m", "32", "--sun-direction", "0.2,0.3,0.9",
                     "--sun-irradiance", "800", "--orient", orient, "--out", "-"});
    EXPECT_EQ(solved.status, 0) << solved.err;
    EXPECT_THAT(solved.err, HasSubstr("warning: the sky lights no face")) << orient;
  }
}

/// In a rolled sheet, one turn sees mostly the back of the next, whichever side is lit.
TEST(CliOrient, SaysWhatIsStillSeenFromBehind) {
  const TemporaryFolder folder;
  std::ostringstream text;
  text << "mtllib m.mtl\nusemtl sheet\n";
  constexpr int strips = 24;
  for (int k = 0; k <= strips; ++k) {
    const double angle = k * 0.7853981633974483, r = 1 + 0.1 * k;
    for (const int z : {0, 20}) {
      text << "v " << r * std::cos(angle) << ' ' << r * std::sin(angle) << ' ' << z << '\n';
    }
  }
  for (int k = 0; k < strips; ++k) {
    text << (k == 8   ? "usemtl lamp\n"
             : k == 9 ? "usemtl sheet\n"
                      : "")
         << "f " << 2 * k + 1 << ' ' << 2 * k + 3 << ' ' << 2 * k + 4 << ' ' << 2 * k + 2 << '\n';
  }
  write_text(folder / "m.mtl", "newmtl sheet\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n");
  write_text(folder / "roll.obj", text.str());
  const auto solve = [&](const Arguments& more) {
    return run_program(Arguments{"solve", folder / "roll.obj", "-m", "16", "--orient", "auto"} +
                       more);
  };
  const ProgramResult rolled = solve({});
  EXPECT_EQ(rolled.status, 0) << rolled.err;
  EXPECT_THAT(rolled.err, HasSubstr("orientation: no face is turned"));
  EXPECT_THAT(rolled.err,
              ::testing::ContainsRegex("warning: [0-9.]+ % of what light meets are backs of faces, "
                                       "which absorb it, also after turning faces \\([0-9.]+ % of "
                                       "material \"sheet\"\\) \\(try --two-sided\\)"));
  EXPECT_THAT(solve({"--two-sided"}).err, ::testing::Not(HasSubstr("backs of faces")));
}

/// `scene` writes both sides of a face that becomes two-sided.
TEST(CliOrient, WritesOrientedScenes) {
  const TemporaryFolder folder;
  write_text(folder / "m.mtl", "newmtl a\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
  write_text(folder / "room.obj", room_obj({2}) +
                                      "usemtl a\nv .2 .2 .5\nv .8 .2 .5\nv .8 .8 .5\n"
                                      "f 9 10 11\n");
  expect_success(
      {"scene", folder / "room.obj", "--orient", "auto", "--out", folder / "oriented.obj"});
  const std::string text = read_file(folder / "oriented.obj");
  EXPECT_THAT(text, HasSubstr("f 2 6 7 3\n"));
  EXPECT_THAT(text, HasSubstr("f 9 10 11\nf 11 10 9\n"));
}

TEST(CliInfo, ReportsOverlappingCoplanarFaces) {
  EXPECT_THAT(run_program({"info", "boards"}).out, ::testing::Not(HasSubstr("coplanar overlap")));
  const TemporaryFolder folder;
  write_text(folder / "two.obj",
             "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\n"
             "f 1 2 3 4\nf 5 6 7 8\n");
  const ProgramResult two = expect_success({"info", folder / "two.obj"});
  EXPECT_THAT(two.out, ::testing::ContainsRegex(
                           "coplanar overlap +1 pair of patches:\n +face [01] +overlaps face "
                           "[01], 1 m2"));
}

/// A ceiling whose B was the mean over the part that its lamp covers, too.
TEST(CliInfo, SolvesWarnOfFacesThatOthersCoverInPart) {
  const std::string scene = TRANSILLUM_DATA_DIR "/scenes/lamp-in-ceiling.obj";
  const ProgramResult partly = expect_success({"solve", scene, "-m", "8"});
  EXPECT_THAT(partly.err, HasSubstr("warning: face 1 (white) loses 7.6 % of its light, because "
                                    "face 6 (lamp) in the same plane covers parts of its patches"));
  // 0.5 m divides the sides of the ceiling and of the lamp.
  EXPECT_EQ(expect_success({"solve", scene, "-m", "8", "-q", "--max-patch-area", "0.25"}).err, "");
}

}  // namespace
}  // namespace transillum::testing
