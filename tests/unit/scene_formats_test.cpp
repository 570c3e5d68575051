// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// PLY, STL, OFF, View3D and Radiance: the same unit cube in each of them, in all their variants,
// and the message for each refused file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <numbers>

#include "scene_test_support.h"

namespace transillum::scene_formats_test {
namespace {

using test::cube_corners;
using test::cube_squares;
using test::expect_cube;
using test::read_scene;
using test::scene_refusal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// PLY -----------------------------------------------------------------------------------------

template <class Number>
void put(std::string& bytes, Number number, bool big) {
  std::string raw(sizeof(Number), '\0');
  std::memcpy(raw.data(), &number, sizeof(Number));
  bytes += big != (std::endian::native == std::endian::big) ? std::string(raw.rbegin(), raw.rend())
                                                            : raw;
}

std::string ply(const std::string& form) {
  std::string text = "ply\nformat " + form +
                     " 1.0\ncomment a cube\nelement vertex 8\nproperty double x\nproperty float y\n"
                     "property short z\nelement edge 1\nproperty uint a\nelement face 6\n"
                     "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                     "property list uchar ushort vertex_indices\nend_header\n";
  const bool ascii = form == "ascii", big = form == "binary_big_endian";
  const auto add = [&](auto number) {
    if (ascii) {
      text += std::to_string(number) + " ";
    } else {
      put(text, number, big);
    }
  };
  for (const Vec3& p : cube_corners) {
    add(p.x);
    add(static_cast<float>(p.y));
    add(static_cast<std::int16_t>(p.z));
  }
  add(std::uint32_t{7});
  for (const auto& square : cube_squares) {
    add(std::uint8_t{255});
    add(std::uint8_t{0});
    add(std::uint8_t{188});
    add(static_cast<std::uint8_t>(square.size()));
    for (const int c : square) {
      add(static_cast<std::uint16_t>(c));
    }
  }
  return text;
}

TEST(SceneFormats, PlyIsReadInAllItsForms) {
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const SceneDescription d = read_scene("cube.ply", ply(form));
    expect_cube(d);
    ASSERT_THAT(d.materials, SizeIs(1)) << form;
    // 255 is 1, which is lowered; 188 of 255 is a half in linear light.
    EXPECT_NEAR(d.materials[0].reflectance.r, 0.98, 1e-12);
    EXPECT_EQ(d.materials[0].reflectance.g, 0);
    EXPECT_NEAR(d.materials[0].reflectance.b, 0.5, 0.01);
    EXPECT_THAT(d.notes, SizeIs(0));
  }
}

TEST(SceneFormats, PlyTakesColorsOfVerticesAndTheProgramsOwnProperties) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\n";
  const SceneDescription colored =
      read_scene("a.ply", head +
                              "property float red\nproperty float green\nproperty float blue\n"
                              "element face 1\nproperty list uchar int vertex_index\nend_header\n"
                              "0 0 0 .75 0 0 1 0 0 0 .75 0 0 1 0 0 0 .75 3 0 1 2\n");
  EXPECT_EQ(colored.materials[0].reflectance, (Rgb{0.25, 0.25, 0.25}));
  const SceneDescription own = read_scene(
      "b.ply", head +
                   "element face 1\nproperty list uchar int vertex_index\nproperty double E_r\n"
                   "property double E_g\nproperty double E_b\nproperty double rho_r\n"
                   "property double rho_g\nproperty double rho_b\nend_header\n"
                   "0 0 0 1 0 0 0 1 0 3 0 1 2 7 8 9 .5 .25 .125\n");
  EXPECT_EQ(own.materials[0].exitance, (Rgb{7, 8, 9}));
  EXPECT_EQ(own.materials[0].reflectance, (Rgb{0.5, 0.25, 0.125}));
  const SceneDescription plain =
      read_scene("c.ply",
                 head +
                     "element face 1\nproperty list uchar int vertex_index\nend_header\n"
                     "0 0 0 1 0 0 0 1 0 3 0 1 2\n",
                 {.default_reflectance = 0.25});
  EXPECT_EQ(plain.materials[0].reflectance, (Rgb{0.25, 0.25, 0.25}));
  EXPECT_THAT(plain.notes, ElementsAre(HasSubstr("1 of 1 faces have no color; rho = 0.25")));
}

TEST(SceneFormats, PlyIgnoresWhatFollowsOnALineAndUnknownLinesOfTheHeader) {
  const SceneDescription d =
      read_scene("a.ply",
                 "ply\nformat ascii 1.0\nCreated by hand\nelement vertex 3\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 2\n"
                 "property list uchar int vertex_index\nend_header\n"
                 "0 0 0 1\n1 0 0 1\n0 1 0\n3 0 1 2 9 1 1\n3 2 1 0\n");
  EXPECT_THAT(d.outline(1), ElementsAre(2, 1, 0));
  EXPECT_THAT(d.notes, ::testing::Contains(HasSubstr("a.ply:3: `Created` is not a keyword")));
}

TEST(SceneFormats, PlyRefusesWhatIsBroken) {
  const std::string good = ply("ascii");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return scene_refusal("a.ply", text);
  };
  EXPECT_EQ(scene_refusal("a.ply", "solid\n"),
            "a.ply:1: is not a PLY file: its first line must be `ply`");
  EXPECT_EQ(
      with("element vertex 8", "element vertex 9999999999"),
      "a.ply:4: an element must have a name and a count of at most 555, the size of the file");
  EXPECT_THAT(with("list uchar", "list float"), HasSubstr("a.ply:14: a property must be"));
  EXPECT_EQ(with("ascii", "utf-8"),
            "a.ply:2: format `utf-8` is not ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(with("4 0 3 2 1", "4 0 3 2 8"), "a.ply: face 0: vertex 8 does not exist; there are 8");
  EXPECT_EQ(with("4 0 3 2 1", "4 0 3 x 1"), "a.ply: face 0: `x` is not a number");
  EXPECT_EQ(with("4 0 3 2 1", "250 0 3 2 1").find("a.ply: face 0: a list of 250 numbers"), 0U);
  const std::string binary = ply("binary_little_endian");
  EXPECT_THAT(scene_refusal("a.ply", binary.substr(0, binary.size() - 3)),
              HasSubstr("a.ply: face 5: a list of 4 numbers does not fit into the file"));
  EXPECT_THAT(scene_refusal("a.ply", binary.substr(0, binary.size() - 90)),
              HasSubstr("the file ends before it"));
  EXPECT_THAT(scene_refusal("a.ply", good.substr(0, 100)), HasSubstr("the header has no end"));
}

/// A triangle with these three numbers of each color in the form that the program writes.
std::string ply_of_values(const std::string& names, const std::string& values) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_index\n";
  for (const char channel : {'0', '1', '2'}) {
    const char* const letters[] = {"_r", "_g", "_b"};
    const char* const whole[] = {"red", "green", "blue"};
    const int c = channel - '0';
    text += "property double " + (names.empty() ? whole[c] : names + letters[c]) + "\n";
  }
  return text + "end_header\n0 0 0 1 0 0 0 1 0 3 0 1 2 " + values + "\n";
}

// When it was rounded to 1/1024, 0.9999 became 1, which was lowered to 0.98: B was 50 instead of
// 10,000.
TEST(SceneFormats, NumbersGivenAsReflectanceKeepAllTheirDigits) {
  const auto rho_of = [](const std::string& name, const std::string& text) {
    return read_scene(name, text).materials[0].reflectance;
  };
  const Rgb digits{0.9999, 0.123456789012345, 1e-9};
  EXPECT_EQ(rho_of("a.ply", ply_of_values("rho", "0.9999 0.123456789012345 1e-9")), digits);
  EXPECT_EQ(rho_of("a.ply", ply_of_values("", "0.9999 0.123456789012345 1e-9")), digits);
  EXPECT_EQ(rho_of("a.off",
                   "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.9999 "
                   "0.123456789012345 1e-9\n"),
            digits);
  // Colors in bytes were rounded too: 1 of 255 became 0.
  EXPECT_NEAR(rho_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 1 1\n").r,
              1 / 255.0 / 12.92, 1e-12);
}

TEST(SceneFormats, NumbersAboveOneAreLoweredWithAWarning) {
  EXPECT_THAT(read_scene("a.ply", ply_of_values("rho", "1.5 0.5 0.5")).notes,
              ElementsAre(HasSubstr("a.ply: face 0: reflectance rho 1.5 0.5 0.5 is lowered to "
                                    "0.98")));
  EXPECT_THAT(read_scene("a.ply", ply_of_values("", "1.5 0.5 0.5")).notes,
              ElementsAre(HasSubstr("rho 1.5 0.5 0.5 is lowered to 0.98")));
  EXPECT_THAT(read_scene("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 254.5 1 1\n").notes,
              ElementsAre(HasSubstr("a.off:6: reflectance rho 254.5 1 1 is lowered to 0.98")));
  EXPECT_THAT(read_scene("a.rad",
                         "void plastic w 0 0 5 1.5 .5 .5 0 0\nw polygon p 0 0 9 0 0 0 1 0 0 0 "
                         "1 0\n")
                  .notes,
              ElementsAre(HasSubstr("a.rad:1: material `w`: reflectance rho 1.5 0.5 0.5 is "
                                    "lowered to 0.98")));
  EXPECT_EQ(scene_refusal("a.ply", ply_of_values("rho", "-1 0 0")),
            "a.ply: face 0: rho -1 is not a finite number of at least 0");
}

const std::string strips_head =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
    "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n";

TEST(SceneFormats, PlyStripsOfTrianglesAreRead) {
  const std::string points = "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 5 5 5\n";
  const SceneDescription d =
      read_scene("a.ply", strips_head + "end_header\n" + points + "9 0 1 2 3 4 -1 2 3 4\n");
  ASSERT_EQ(d.face_count(), 4U);
  const Scene scene(d);
  for (PatchId i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(scene.patch(i).area, 0.5);
    EXPECT_DOUBLE_EQ(scene.patch(i).normal.z, 1);
  }
  EXPECT_THAT(d.outline(1), ElementsAre(2, 1, 3));
  EXPECT_THAT(scene_refusal("a.ply", strips_head + "end_header\n" + points + "3 0 1 -2\n"),
              HasSubstr("a.ply: tristrips 0: vertex -2 does not exist"));
  EXPECT_THAT(scene_refusal("a.ply", strips_head + "end_header\n" + points + "3 0 1 6\n"),
              HasSubstr("vertex 6 does not exist; there are 6"));
}

// STL -----------------------------------------------------------------------------------------

std::string text_stl() {
  std::string text = "solid cube\n";
  for (const auto& s : cube_squares) {
    for (const auto& t : {std::array{s[0], s[1], s[2]}, {s[0], s[2], s[3]}}) {
      text += " facet normal 0 0 0\n  outer loop\n";
      for (const int c : t) {
        const Vec3& p = cube_corners[static_cast<std::size_t>(c)];
        text += "   vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                std::to_string(p.z) + "\n";
      }
      text += "  endloop\n endfacet\n";
    }
  }
  return text + "endsolid cube\n";
}

std::string binary_stl(const std::string& header) {
  std::string bytes = header + std::string(80 - header.size(), ' ');
  put(bytes, std::uint32_t{12}, false);
  for (const auto& s : cube_squares) {
    for (const auto& t : {std::array{s[0], s[1], s[2]}, {s[0], s[2], s[3]}}) {
      bytes += std::string(12, '\0');
      for (const int c : t) {
        const Vec3& p = cube_corners[static_cast<std::size_t>(c)];
        for (const double v : {p.x, p.y, p.z}) {
          put(bytes, static_cast<float>(v), false);
        }
      }
      bytes += std::string(2, '\0');
    }
  }
  return bytes;
}

TEST(SceneFormats, StlIsReadAsTextAndBinaryAndJoined) {
  for (const std::string& text : {text_stl(), binary_stl("made by a test"), binary_stl("solid")}) {
    const SceneDescription d = read_scene("cube.stl", text);
    expect_cube(d);
    EXPECT_THAT(d.notes, ElementsAre(HasSubstr("12 of 12 faces have no color (STL has none)"),
                                     HasSubstr("12 faces joined to 6")));
    EXPECT_EQ(read_scene("cube.stl", text, {.join = false}).face_count(), 12U);
  }
  EXPECT_THAT(read_scene("cube.stl", text_stl()).groups, ElementsAre("cube"));
}

TEST(SceneFormats, StlInCapitalsIsText) {
  std::string text = text_stl();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const SceneDescription d = read_scene("cube.stl", text);
  expect_cube(d);
  EXPECT_THAT(d.groups, ElementsAre("CUBE"));
}

TEST(SceneFormats, StlRefusesWhatIsBroken) {
  EXPECT_EQ(scene_refusal("a.stl", "x"), "a.stl: is not an STL file: it has no 84 bytes");
  EXPECT_THAT(scene_refusal("a.stl", binary_stl("").substr(0, 300)),
              HasSubstr("12 triangles take 684 bytes, the file has 300"));
  std::string text = text_stl();
  text.replace(text.find("endloop"), 7, "endlop");
  EXPECT_EQ(scene_refusal("a.stl", text), "a.stl:7: `endlop` is not a line of an STL file");
  text = text_stl();
  text.replace(text.find("vertex"), 8, "normal 0");
  EXPECT_THAT(scene_refusal("a.stl", text), HasSubstr("a.stl:4: `normal` is not a line"));
  EXPECT_EQ(scene_refusal("a.stl", text_stl().substr(0, 80)),
            "a.stl: the file ends within a facet");
  EXPECT_EQ(scene_refusal("a.stl", "solid\nendsolid\n"), "a.stl: has no triangles");
}

// OFF -----------------------------------------------------------------------------------------

std::string off(const std::string& head, const std::string& color) {
  std::string text = head;
  for (const Vec3& p : cube_corners) {
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const auto& s : cube_squares) {
    text += "4";
    for (const int c : s) {
      text += " " + std::to_string(c);
    }
    text += color + "\n";
  }
  return text;
}

TEST(SceneFormats, OffIsReadWithAndWithoutColors) {
  for (const std::string head : {"OFF\n8 6 12\n", "OFF 8 6 0\n",
                                 "# a cube\nOFF\n\n8 6 0 # counts\n", "8 6 12\n", "OFF8 6 12\n"}) {
    expect_cube(read_scene("cube.off", off(head, "")));
  }
  const SceneDescription whole = read_scene("cube.off", off("OFF\n8 6 12\n", " 0 188 0 255"));
  EXPECT_NEAR(whole.materials[0].reflectance.g, 0.5, 0.01);
  const SceneDescription fraction = read_scene("cube.off", off("OFF\n8 6 12\n", " 0.5 0.25 0.0"));
  EXPECT_EQ(fraction.materials[0].reflectance, (Rgb{0.5, 0.25, 0}));
}

TEST(SceneFormats, OffRefusesWhatIsBroken) {
  EXPECT_EQ(scene_refusal("a.off", "OFF\n8 6 0\n0 0 0\n"),
            "a.off:3: the file ends before vertex 1 of 8");
  EXPECT_THAT(scene_refusal("a.off", off("OFF\n8 6 12\n", " 0 0 256")), HasSubstr("color 256"));
  EXPECT_THAT(scene_refusal("a.off", "OFF\n99999 1 0\n"),
              HasSubstr("`99999` is not a number of lines"));
  EXPECT_THAT(scene_refusal("a.off", "OFF BINARY\n"), HasSubstr("is a binary OFF file"));
  EXPECT_THAT(scene_refusal("a.off", "4OFF\n1 1 1\n"), HasSubstr("`4OFF`"));
  EXPECT_EQ(scene_refusal("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"),
            "a.off:4: face 0: vertex `1` does not exist; there are 1");
}

// View3D --------------------------------------------------------------------------------------

const std::string view3d =
    "T a room with a window\nC encl=1 list=0\nF 3\n! # x y z\n"
    "V 1 0 0 0 ! floor\nV 2 4 0 0\nV 3 4 3 0\nV 4 0 3 0\nV 5 0 0 2\nV 6 4 0 2\nV 7 4 3 2\n"
    "V 8 0 3 2\nV 9 1 0 1\nV 10 2 0 1\nV 11 2 0 1.5\nV 12 1 0 1.5\n"
    "! # v1 v2 v3 v4 base cmb emit name\n"
    "S 1 1 2 3 4 0 0 0.9 floor\nS 2 8 7 6 5 0 0 0.8 ceiling\nS 3 5 6 2 1 0 0 0.9 south\n"
    "S 4 12 11 10 9 3 0 0.25 window\nS 5 4 3 7 8 0 0 0.9 north\nS 6 1 4 8 5 0 5 0.9 west\n"
    "S 7 3 2 6 7 0 5 0.9 east\nO 8 9 10 11 0\nEnd of data\nwhat follows is not read\n";

TEST(SceneFormats, View3dCutsSubsurfacesOutOfTheirBase) {
  const SceneDescription d = read_scene("room.vs3", view3d);
  const Scene scene(d);
  EXPECT_THAT(scene.report().warnings, SizeIs(0));
  double south = 0, total = 0;
  for (const Patch& patch : scene.patches()) {
    south += patch.face == 2 ? patch.area : 0;
    total += patch.area;
    if (patch.face < 7) {
      EXPECT_GT(dot(patch.normal, Vec3{2, 1.5, 1} - patch.center), 0) << patch.face;
    }
  }
  EXPECT_NEAR(south, 4 * 2 - 0.5, 1e-12);
  EXPECT_NEAR(total, 2 * (12 + 8 + 6) + 0.25, 1e-12);  // the obstruction has 0.25 m²
  EXPECT_THAT(scene.groups(),
              ElementsAre("floor", "ceiling", "south", "window", "north", "surface 8"));
  EXPECT_EQ(scene.reflectance(0), (Rgb{1 - 0.9, 1 - 0.9, 1 - 0.9}));
  EXPECT_EQ(scene.material(scene.patch_count() - 1).name, "obstruction");
}

// A room of 4 x 3 x 2 m by planes and shapes in them; the ceiling has a part of its own.
const std::string view3d_shapes =
    "T a room\nC encl=1\nF 3a\n! # shape base cmb emit name\n"
    "S 1 R 0 0 0.9 south ! x y z azimuth tilt width height\n 4 0 0  0 90  4 2\n"
    "S 2 r 0 0 0.9 east\n 4 3 0  270 90\n 3 2\n"
    "S 3 R 0 0 0.9 north\n 0 3 0  180 90  4. 2.\n"
    "S 4 R 0 2 0.9 west\n 0 0 0  90 90  3 2\n"
    "S 5 Q 0 0 0.8 ceiling\n 4 0 2  0 180\n 0 0  4 0  4 3  0 3\n"
    "S 6 q 0 0 0.8 floor-1\n 0 0 0  180 0\n 0 0  4 0\n 4 1  0 1\n"
    "S 7 T 0 6 0.8 floor-2\n 0 0 0  180 0\n 0 1  4 1  4 3\n"
    "S 8 T 0 6 0.8 floor-3\n 0 0 0  180 0\n 0 1  4 3  0 3\n"
    "O 9 R\n 1 1 1  0 30  1 1\nEnd of data\n";

TEST(SceneFormats, View3dShapesInPlanesMakeTheSameRoom) {
  const SceneDescription d = read_scene("room.vs3", view3d_shapes);
  const Scene scene(d);
  ASSERT_EQ(scene.patch_count(), 9);
  double total = 0;
  Vec3 closure;
  for (PatchId i = 0; i < 8; ++i) {
    const Patch& patch = scene.patch(i);
    EXPECT_GT(dot(patch.normal, Vec3{2, 1.5, 1} - patch.center), 0.9) << i;
    total += patch.area;
    closure = closure + patch.area * patch.normal;
  }
  EXPECT_NEAR(total, 2 * (12 + 8 + 6), 1e-12);
  EXPECT_NEAR(norm(closure), 0, 1e-12);
  // Corners of right angles are exact, so that walls share them.
  EXPECT_EQ(scene.points().size(), 8U + 2 + 4);
  EXPECT_EQ(scene.material(8).name, "obstruction");
  // Tilted by 30 degrees and facing north, the lower edge is on the plane's x axis, westward.
  EXPECT_NEAR(scene.patch(8).normal.y, 0.5, 1e-12);
  EXPECT_NEAR(scene.patch(8).normal.z, std::sqrt(3) / 2, 1e-12);
  EXPECT_NEAR(scene.patch(8).center.x, 0.5, 1e-12);
  EXPECT_THAT(scene.groups(),
              ElementsAre("south", "east", "north", "ceiling", "floor-1", "surface 9"));
}

TEST(SceneFormats, View3dRefusesBrokenShapes) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = view3d_shapes;
    text.replace(text.find(from), from.size(), to);
    return scene_refusal("a.vs3", text);
  };
  EXPECT_EQ(with("S 5 Q", "S 5 H"),
            "a.vs3:14: `H` is no shape; shapes are R (rectangle), Q (quadrilateral) and T "
            "(triangle)");
  EXPECT_THAT(with("0 90  4 2", "0 90  4 -2"), HasSubstr("a.vs3:6: the height must be above 0"));
  EXPECT_THAT(with(" 1 1 1  0 30  1 1\nEnd of data\n", " 1 1"),
              HasSubstr("a.vs3:28: the file ends within the surface"));
  EXPECT_THAT(with("0 90  4 2", "0 x  4 2"), HasSubstr("a.vs3:6: the tilt must be a number"));
}

TEST(SceneFormats, View3dRefusesWhatIsBroken) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = view3d;
    text.replace(text.find(from), from.size(), to);
    return scene_refusal("a.vs3", text);
  };
  EXPECT_EQ(with("F 3\n", "F 2\n"),
            "a.vs3:3: only geometry in three dimensions (F 3 or F 3a) can be read");
  EXPECT_THAT(with("V 2 4", "V 3 4"), HasSubstr("a.vs3:6: the vertex's number"));
  EXPECT_THAT(with("V 2 4", "V 1 4"), HasSubstr("a.vs3:6: vertices must be numbered in order"));
  EXPECT_THAT(with("S 1 1 2 3 4", "S 1 1 2 13 4"), HasSubstr("a.vs3:18: a vertex of a surface"));
  EXPECT_THAT(with("0.25 window", "1.25 window"), HasSubstr("a.vs3:21: the emissivity must be"));
  EXPECT_THAT(with("V 4 0 3 0", "V 4 0 nan 0"), HasSubstr("not a finite point"));
  EXPECT_EQ(scene_refusal("a.vs3", "T nothing\n"), "a.vs3: has no surfaces");
}

// Radiance ------------------------------------------------------------------------------------

const std::string radiance =
    "# a lamp over a floor\nvoid plastic red 0 0 5 .8 .4 .2 .5 0\n"
    "void light lamp\n0\n0\n3 2 1 .5\nvoid glass pane 0 0 3 .9 .9 .9\n"
    "red polygon floor.1 0 0\n12\n0 0 0  1 0 0\n1 1 0\n0 1 0\n"
    "lamp polygon ceiling 0 0 9 0 0 1 0 1 1 1 0 1\n"
    "lamp sphere ball 0 0 4 0 0 0 1\nvoid brightfunc stripes 2 a b 0 0\n"
    "stripes alias other red\nother polygon wall 0 0 9 0 0 0 0 1 0 0 0 1\n";

TEST(SceneFormats, RadiancePolygonsHaveTheDiffusePartOfTheirMaterials) {
  const SceneDescription d = read_scene("a.rad", radiance);
  ASSERT_EQ(d.face_count(), 3U);
  const auto material = [&](std::size_t f) {
    return d.materials[static_cast<std::size_t>(d.face_material[f])];
  };
  EXPECT_EQ(material(0).reflectance, (Rgb{0.4, 0.2, 0.1}));
  EXPECT_EQ(material(1).exitance,
            (Rgb{2 * std::numbers::pi, std::numbers::pi, 0.5 * std::numbers::pi}));
  EXPECT_EQ(material(2).name, "red");
  EXPECT_THAT(d.groups, ElementsAre("floor.1", "ceiling", "wall"));
  EXPECT_THAT(d.notes, ::testing::Contains(HasSubstr("sphere `ball` is not a polygon; omitted")));
}

TEST(SceneFormats, RadianceWordsInQuotesMayHoldBlanks) {
  const SceneDescription d =
      read_scene("a.rad",
                 "void plastic \"my red # paint\" 0 0 5 .8 .4 .2 0 0 # a comment 7\n"
                 "\"my red # paint\" polygon 'the \"long\" wall' 0 0 9 0 0 0 0 1 0 0 0 1\n"
                 "void brightfunc b\n2 \"a b\" c\n0 0\nvoid plastic w#1 0 0 5 1e-1 1e-1 1e-1 0 0\n"
                 "w#1 polygon \"\" 0 0 9 0 0 0 0 1 0 0 0 1\n");
  ASSERT_EQ(d.face_count(), 2U);
  const auto material = [&](std::size_t f) {
    return d.materials[static_cast<std::size_t>(d.face_material[f])];
  };
  EXPECT_EQ(material(0).name, "my red # paint");
  EXPECT_EQ(material(0).reflectance, (Rgb{0.8, 0.4, 0.2}));
  EXPECT_EQ(material(1).name, "w#1");
  EXPECT_THAT(d.groups, ElementsAre("the \"long\" wall", ""));
  EXPECT_EQ(scene_refusal("a.rad", "void plastic 'red 0 0\n 5 .8 .4 .2 0 0\n"),
            "a.rad:1: the quotes of `red 0 0` do not end on their line");
}

TEST(SceneFormats, RadianceRefusesCommandsAndWhatIsBroken) {
  EXPECT_THAT(scene_refusal("a.rad", "void plastic a 0 0 5 1 1 1 0 0\n!xform -t 1 0 0 b.rad\n"),
              HasSubstr("a.rad:2: `!xform -t 1 0 0 b.rad` is a command, which is not run"));
  EXPECT_EQ(scene_refusal("a.rad", "void polygon a 0 0 8 1 2 3 4 5 6 7 8\n"),
            "a.rad:1: polygon `a` has 8 numbers; three for each of three corners or more are "
            "required");
  EXPECT_EQ(scene_refusal("a.rad", "void polygon a 0 0 999\n"),
            "a.rad:1: `999` is not a number of arguments");
  EXPECT_EQ(scene_refusal("a.rad", "void polygon a 0 0 9 1 2\n"),
            "a.rad:1: the file ends within a primitive");
  EXPECT_EQ(scene_refusal("a.rad", "void plastic a 0 0 5 -1 1 1 0 0\n"),
            "a.rad:1: plastic `a`: -1 is not a color");
  EXPECT_EQ(scene_refusal("a.rad", "void plastic a 0 0 5 1 1 1 0 0\n"), "a.rad: has no polygons");
}

// All -----------------------------------------------------------------------------------------

TEST(SceneFormats, AByteOrderMarkIsNoPartOfAFile) {
  const std::string mark = "\xef\xbb\xbf";
  expect_cube(read_scene("a.ply", mark + ply("ascii")));
  expect_cube(read_scene("a.ply", mark + ply("binary_big_endian")));
  expect_cube(read_scene("a.off", mark + off("OFF\n8 6 12\n", "")));
  expect_cube(read_scene("a.stl", mark + text_stl()));
}

TEST(SceneFormats, AreFoundByTheEndingInAnyCaseAndListedWhenItIsUnknown) {
  expect_cube(read_scene("CUBE.STL", text_stl()));
  EXPECT_TRUE(is_scene_file("a.Glb"));
  EXPECT_TRUE(is_scene_file("a.vtp"));
  EXPECT_FALSE(is_scene_file("a.csv"));
  EXPECT_EQ(scene_refusal("a.step", "x"),
            "a.step: not a scene file; scene files end in .obj, .gltf, .glb, .ply, .stl, .off, "
            ".rad, .vs3, .vtp, .vtk");
}

}  // namespace
}  // namespace transillum::scene_formats_test
