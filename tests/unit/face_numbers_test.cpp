// transillum: diffuse light by the transillumination method. GPL-3.0-or-later. Faces have one
// numbering, the numbers of the file, also where faces are joined or one face has several parts: in
// changes of materials, in messages, in reports and in results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scene/build/joining.h"
#include "support/program_call.h"
#include "support/refusal.h"
#include "transillum/at.h"
#include "transillum/material_changes.h"
#include "transillum/orientation.h"

namespace transillum::face_numbers_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A strip of unit squares along x, two triangles each, every square of its own material.
SceneDescription strip(int squares) {
  SceneDescription d;
  d.name = "strip";
  const auto add = [&](std::initializer_list<Vec3> corners, int material) {
    std::vector<PointId> outline;
    for (const Vec3& p : corners) {
      outline.push_back(static_cast<PointId>(d.points.size()));
      d.points.push_back(p);
    }
    d.add_face(outline, material);
  };
  for (int k = 0; k < squares; ++k) {
    const double x = k;
    d.materials.push_back({"square " + std::to_string(k), {0.5, 0.5, 0.5}, {}});
    add({{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}}, k);
    add({{x, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}, k);
  }
  return d;
}

SceneDescription joined(const SceneDescription& d) { return join_faces(d, {}).description; }

/// Numbers of the faces whose patches emit.
std::vector<std::int32_t> lit_faces(const SceneDescription& d) {
  const Scene scene(d);
  std::vector<std::int32_t> faces;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (max_abs(scene.exitance(i)) > 0) {
      faces.push_back(scene.patch(i).face);
    }
  }
  return faces;
}

TEST(FaceNumbers, OfAChangeAreThoseOfPatches) {
  SceneDescription d = joined(strip(4));
  change_materials(d, std::vector{exitance_change("face:2=7")});
  EXPECT_THAT(lit_faces(d), ElementsAre(2));
}

TEST(FaceNumbers, OfAllPartsOfAFaceAreChanged) {
  SceneDescription d = strip(3);
  d.face_number = {0, 0, 4, 4, 9, 9};
  change_materials(d, std::vector{exitance_change("face:4=7")});
  EXPECT_THAT(lit_faces(d), ElementsAre(4, 4));
  EXPECT_THAT(test::refusal([&] { change_materials(d, std::vector{exitance_change("face:5=7")}); }),
              HasSubstr("there is no face 5; faces are numbered 0 to 9"));
}

TEST(FaceNumbers, OfJoinedFacesAreRefusedWithWhatTheyBecame) {
  SceneDescription d = joined(strip(4));
  EXPECT_THAT(d.joined_to, ElementsAre(0, 0, 2, 2, 4, 4, 6, 6));
  EXPECT_THAT(test::refusal([&] { change_materials(d, std::vector{exitance_change("face:5=7")}); }),
              HasSubstr("strip: face 5 was joined to face 4"));
  EXPECT_THAT(test::refusal([&] { change_materials(d, std::vector{exitance_change("face:8=7")}); }),
              HasSubstr("there is no face 8; faces are numbered 0 to 7"));
  EXPECT_EQ(Scene(d).report().joined_to, d.joined_to);
}

TEST(FaceNumbers, OfPartsJoinedToSeveralFacesPreferTheirOwn) {
  SceneDescription d = strip(2);
  d.face_number = {0, 1, 1, 2};  // the parts of face 1 go to squares 0 and 1
  EXPECT_THAT(joined(d).joined_to, ElementsAre(0, 1, 1));
}

TEST(FaceNumbers, AreInMessagesAndReports) {
  SceneDescription d = joined(strip(3));
  const std::vector<PointId> outline(d.outline(1).begin(), d.outline(1).end());
  d.add_face(outline, 1);
  d.face_number.push_back(8);
  d.add_face(std::vector<PointId>{0, 1}, 1);
  d.face_number.push_back(9);
  const SceneReport report = Scene(d).report();
  EXPECT_THAT(report.covered_faces, ElementsAre(2));
  EXPECT_THAT(report.warnings, ::testing::Contains(HasSubstr("face 8: same points as face 2")));
  EXPECT_THAT(report.warnings, ::testing::Contains(HasSubstr("face 9: 2 corners")));
  EXPECT_EQ(plan_orientation(d).numbers, d.face_number);
}

/// An ASCII STL file of the strip.
std::string stl(const SceneDescription& d) {
  std::string text = "solid strip\n";
  for (std::size_t f = 0; f < d.face_count(); ++f) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const PointId p : d.outline(f)) {
      const Vec3& q = at(d.points, p);
      text += "vertex " + std::to_string(q.x) + " " + std::to_string(q.y) + " " +
              std::to_string(q.z) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

/// An L of two walls, two triangles each: faces 0 and 2 after joining.
TEST(FaceNumbers, OfTheProgramAreThoseOfItsResults) {
  const testing::TemporaryFolder folder;
  SceneDescription d = strip(2);
  for (Vec3& p : d.points) {
    p = p.x > 1 ? Vec3{1, p.y, 1} : p;
  }
  const std::string scene = folder / "walls.stl";
  test::write_text(scene, stl(d));
  const testing::ProgramResult lit =
      testing::run_program({"solve", scene, "--emission", "face:2=10", "-m", "8", "--out", "-"});
  EXPECT_EQ(lit.status, 0) << lit.err;
  EXPECT_THAT(lit.out, HasSubstr("\n2,1,1,10,10,10,"));
  testing::expect_refused({"solve", scene, "--emission", "face:3=10", "-m", "8"},
                          "face 3 was joined to face 2");
}

/// A result numbers the faces of its scene, also where a face without area or the division into
/// patches makes its polygons other numbers.
TEST(FaceNumbers, OfAResultAreThoseOfItsScene) {
  const testing::TemporaryFolder folder;
  const std::string scene = folder / "s.obj", result = folder / "s.vtp";
  test::write_text(scene,
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                   "f 1 2 2\nf 1 2 3 4\nf 8 7 6 5\n");
  const testing::ProgramResult solved =
      testing::run_program({"solve", scene, "--emission", "face:2=10", "-m", "8",
                            "--max-patch-area", "0.3", "--out", result});
  ASSERT_EQ(solved.status, 0) << solved.err;
  const SceneDescription read = describe_scene(result);
  EXPECT_THAT(read.face_number, ElementsAre(1, 1, 1, 1, 2, 2, 2, 2));
  EXPECT_THAT(lit_faces(read), ElementsAre(2, 2, 2, 2));
  // An array of that name that is no numbering is not read.
  const std::string other = folder / "other.vtk";
  test::write_text(other,
                   "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
                   "0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 2\n"
                   "SCALARS face int 1\nLOOKUP_TABLE default\n7 3\n");
  EXPECT_THAT(describe_scene(other).face_number, ::testing::IsEmpty());
}

}  // namespace
}  // namespace transillum::face_numbers_test
