// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The OBJ reader accepts all dialects of valid files, and the OBJ writer writes files that it reads
// back bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_test_support.h"
#include "transillum/files.h"

namespace transillum::scene_obj_reader_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

SceneDescription read(const std::string& obj, const std::string& mtl = "") {
  const test::TemporaryFolder folder;
  if (!mtl.empty()) {
    folder.write("s.mtl", mtl);
  }
  return describe_scene(folder.write("s.obj", obj));
}

TEST(ObjReader, KeepsPolygonsAndTheirOrderAcrossGroupsObjectsAndMaterials) {
  const SceneDescription d =
      read("mtllib s.mtl\no one\n" + square +
               "v 2 2 0\ng a b\nusemtl red\nf 1 2 3 4\ng\nusemtl blue\nf 1 2 3\ns off\n"
               "o two\nusemtl red\nf 1 2 3 5 4\nf 4 3 2\n",
           "newmtl blue\nKd 0 0 .5\nnewmtl red\nKd .5 0 0\nKe 1 2 3\n");
  ASSERT_EQ(d.face_count(), 4u);
  EXPECT_THAT(d.outline(0), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(d.outline(2), ElementsAre(0, 1, 2, 4, 3));
  EXPECT_THAT(d.face_material, ElementsAre(1, 0, 1, 1));
  EXPECT_THAT(d.face_line, ElementsAre(10, 13, 17, 18));
  EXPECT_EQ(d.materials[0].exitance, (Rgb{0, 0, 0}));
  EXPECT_EQ(d.materials[1].exitance, (Rgb{1, 2, 3}));
  EXPECT_THAT(d.groups, ElementsAre("a b", "two"));
  EXPECT_THAT(d.face_group, ElementsAre(0, no_group, 1, 1));
  EXPECT_TRUE(d.notes.empty());
}

TEST(ObjReader, ReadsLobes) {
  const SceneDescription d =
      read("mtllib s.mtl\n" + square +
               "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl d\nf 1 2 3\n",
           "newmtl a\nKd .5 .5 .5\nKs .1 .2 .3\nNs 12.5\nillum 2\n"
           "newmtl b\nKd .5 .5 .5\nKs .25\nPr .3\nNs 50\n"
           "newmtl c\nKd .5 .5 .5\nKs .5 .5 .5\nNs 50\nillum 1\n"
           "newmtl d\nKd .5 .5 .5\nKs .5 x .5\nNs -3\n");
  EXPECT_EQ(d.materials[0].lobe.reflectance, (Rgb{0.1, 0.2, 0.3}));
  EXPECT_EQ(d.materials[0].lobe.shape, LobeShape::phong);
  EXPECT_EQ(d.materials[0].lobe.exponent, 12.5);
  EXPECT_EQ(d.materials[1].lobe.reflectance, (Rgb{0.25, 0.25, 0.25}));
  EXPECT_EQ(d.materials[1].lobe.shape, LobeShape::ggx);
  EXPECT_EQ(d.materials[1].lobe.roughness, 0.3);
  EXPECT_FALSE(d.materials[2].lobe.present());
  EXPECT_FALSE(d.materials[3].lobe.present());
  EXPECT_THAT(d.notes, Contains(HasSubstr("material `d`: Ks is ignored")));
  // Refined patches and two-sided patches have the lobe of their face.
  const Scene scene(d, {.two_sided = true, .max_patch_area = 0.1});
  EXPECT_GT(scene.patch_count(), 16);
  EXPECT_EQ(scene.material(1).lobe, d.materials[0].lobe);
}

/// Files have numbers as Ks and Ns that are used as they are, and others that are ignored.
TEST(ObjReader, ReadsLobesOfAwkwardFiles) {
  const auto lobe = [](const std::string& lines) {
    return read("mtllib s.mtl\n" + square + "usemtl a\nf 1 2 3\n",
                "newmtl a\nKd .5 .5 .5\n" + lines)
        .materials[0]
        .lobe;
  };
  EXPECT_EQ(lobe("Ks .2 .2 .2\nNs 0\n").exponent, 0);
  EXPECT_EQ(lobe("Ks .2 .2 .2\n").exponent, 0);
  EXPECT_EQ(lobe("Ks .2 .2 .2\nNs 1e6\n").exponent, 1e6);
  EXPECT_EQ(lobe("Ks .2 .2 .2\nNs 1e12\n").exponent, 0);
  EXPECT_EQ(lobe("Ks .2 .2 .2\nNs nan\n").exponent, 0);
  EXPECT_EQ(lobe("Ks 3\nNs 5\n").reflectance, (Rgb{3, 3, 3}));  // lowered by solves
  for (const char* unusable : {"Ks -.1 .2 .2\n", "Ks nan nan nan\n", "Ks .1 .2\n", "Ks\n",
                               "Ks xyz .1 .2 .3\n", "Ks 1e300 0 0\n", "Ns 50\n", "Pr .3\n"}) {
    EXPECT_FALSE(lobe(unusable).present()) << unusable;
  }
  EXPECT_EQ(lobe("Ks .2 .2 .2\nPr 7\n").roughness, 1);
}

TEST(ObjReader, AcceptsTextureNormalAndNegativeIndices) {
  const SceneDescription d = read(square +
                                  "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2//1 3//1\n"
                                  "f 1/1 2/1 3/1\nf -4 -3/-1 -2//-1\nv 9 9 9\nf -1 -3 -2\n");
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_THAT(d.outline(f), ElementsAre(0, 1, 2)) << f;
  }
  EXPECT_THAT(d.outline(3), ElementsAre(0, 1, 2));
  EXPECT_THAT(d.outline(4), ElementsAre(4, 2, 3));
}

TEST(ObjReader, AcceptsVerticesAfterTheirFaces) {
  EXPECT_THAT(read("f 1 2 3\n" + square).outline(0), ElementsAre(0, 1, 2));
}

TEST(ObjReader, AcceptsLineEndsOfAllSystemsCommentsBlanksAndContinuations) {
  const std::string plain = square + "f 1 2 3 4\n";
  std::string crlf, cr;
  for (const char c : plain) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  const std::string decorated =
      "\xef\xbb\xbf# a path \\\n\n  v 0 0 0 # first\n\tv\t1 0   0 1.0\nv +1 1e0 0\nv 0 1 0\n"
      "f 1 2 \\\n 3 4";
  for (const std::string& text : {plain, crlf, cr, decorated}) {
    const SceneDescription d = read(text);
    EXPECT_EQ(d.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_THAT(d.outline(0), ElementsAre(0, 1, 2, 3));
  }
}

TEST(ObjReader, ReadsTheNearestDoubleOfEveryNumber) {
  // Numbers for which tinyobjloader's own arithmetic is wrong in the last place.
  const SceneDescription d = read(
      "mtllib s.mtl\nv 0.1 2.2250738585072014e-308 123456789.123456789\nv 1 0 0\n"
      "v 0 1.7976931348623157e-300 1e-999\nusemtl m\nf 1 2 3\n",
      "newmtl m\nKd 0.3333333333333333 0.1 0.7\nKe 9007199254740993 5e-324 0.30000000000000004\n");
  EXPECT_EQ(d.points[0], (Vec3{0.1, 2.2250738585072014e-308, 123456789.123456789}));
  EXPECT_EQ(d.points[2], (Vec3{0, 1.7976931348623157e-300, 0}));
  EXPECT_EQ(d.materials[0].reflectance, (Rgb{0.3333333333333333, 0.1, 0.7}));
  EXPECT_EQ(d.materials[0].exitance, (Rgb{9007199254740993.0, 5e-324, 0.30000000000000004}));
}

TEST(ObjReader, AcceptsNamesWithBlanksAndNumberSigns) {
  const test::TemporaryFolder folder;
  folder.write("my scene.mtl", "newmtl Material #25\nKd .1 .2 .3\n");
  const SceneDescription d = describe_scene(
      folder.write("s.obj", "mtllib my scene.mtl\n" + square + "usemtl Material #25\nf 1 2 3\n"));
  ASSERT_EQ(d.materials.size(), 1u);
  EXPECT_EQ(d.materials[0].name, "Material #25");
}

TEST(ObjReader, AcceptsSeveralLibrariesInOneLine) {
  const test::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nKd .1 .1 .1\n");
  folder.write("b.mtl", "newmtl b\nKd .2 .2 .2\n");
  const SceneDescription d = describe_scene(folder.write(
      "s.obj", "mtllib a.mtl .\\b.mtl\n" + square + "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"));
  EXPECT_THAT(d.face_material, ElementsAre(1, 0));
}

TEST(ObjReader, DoesNotCheckUnusedMaterials) {
  EXPECT_NO_THROW(read("mtllib s.mtl\n" + square + "usemtl a\nf 1 2 3\n",
                       "newmtl a\nKd .1 .1 .1\nnewmtl b\nKd 1 1 1\n"));
}

TEST(ObjReader, ReportsWhatItIgnoresOrAssumes) {
  const SceneDescription d = read("mtllib s.mtl\n" + square + "l 1 2\nf 1 2 3\ncurv 0 1 1 2\n",
                                  "newmtl a\nmap_Ks x.png\nnewmtl a\nKd .1 .1 .1\n");
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.obj:6: keyword `l` is not supported; line ignored")));
  EXPECT_THAT(d.notes,
              Contains(HasSubstr("s.obj:8: keyword `curv` is not supported; line ignored")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.mtl:2: texture map `map_Ks` is ignored")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.mtl:3: material `a` is already defined")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.mtl:1: material `a` has no Kd")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("1 of 1 faces have no material (usemtl); rho = 0.5")));
}

TEST(ObjReader, CountsFacesWithTooFewCornersAsDegenerate) {
  const test::TemporaryFolder folder;
  const auto scene = load_scene(folder.write("s.obj", square + "f 1 2\nf\nf 1 2 3\nf 2\n"));
  EXPECT_EQ(scene->patch_count(), 1);
  EXPECT_EQ(scene->patch(0).face, 2);
  EXPECT_EQ(scene->report().faces, 4);
  EXPECT_EQ(scene->report().removed_degenerate, 3);
  EXPECT_THAT(
      scene->report().warnings,
      Contains(HasSubstr("s.obj:5: face 0: 2 corners, but at least 3 are required; face removed")));
}

void expect_same(const SceneDescription& a, const SceneDescription& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.face_begin, b.face_begin);
  EXPECT_EQ(a.face_material, b.face_material);
  EXPECT_EQ(a.groups, b.groups);
  EXPECT_EQ(a.face_group, b.face_group);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m) {
    EXPECT_EQ(a.materials[m].name, b.materials[m].name);
    EXPECT_EQ(a.materials[m].reflectance, b.materials[m].reflectance);
    EXPECT_EQ(a.materials[m].exitance, b.materials[m].exitance);
  }
}

TEST(ObjWriter, EveryBuiltInReadsBackBitForBit) {
  for (const BuiltInScene& b : built_in_scenes()) {
    SCOPED_TRACE(b.name);
    const test::TemporaryFolder folder;
    const SceneDescription written = describe_scene(b.name);
    write_obj(folder.path() / "out.obj", written);
    expect_same(written, describe_scene((folder.path() / "out.obj").string()));
  }
}

TEST(ObjWriter, KeepsLobes) {
  SceneDescription d = describe_scene("furnace");
  d.materials[0].lobe = {.reflectance = {0.1, 0.2, 1.0 / 3}, .exponent = 0.7};
  d.materials.push_back(d.materials[0]);
  d.materials[1].name = "other";
  d.materials[1].lobe = {.reflectance = {0.3, 0.3, 0.3}, .shape = LobeShape::ggx, .roughness = 0.1};
  d.face_material[0] = 1;
  const test::TemporaryFolder folder;
  write_obj(folder.path() / "s.obj", d);
  const SceneDescription back = describe_scene((folder.path() / "s.obj").string());
  EXPECT_EQ(back.materials[0].lobe, d.materials[0].lobe);
  EXPECT_EQ(back.materials[1].lobe, d.materials[1].lobe);
}

TEST(ObjWriter, KeepsGroups) {
  SceneDescription d = test::polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  d.groups = {"a lamp", "default", "\"quoted\"", ""};
  for (const int group : {0, no_group, 0, 1, 2, 3}) {
    d.add_face(std::vector<PointId>{0, 1, 2}, 0, 0, group);
  }
  const test::TemporaryFolder folder;
  write_obj(folder.path() / "out.obj", d);
  const SceneDescription back = describe_scene((folder.path() / "out.obj").string());
  EXPECT_THAT(back.groups, ElementsAre("a lamp", "default-2", "_\"quoted\"", "_"));
  EXPECT_EQ(back.face_group, d.face_group);
}

TEST(ObjWriter, ReplacesCharactersThatNamesCannotHave) {
  SceneDescription d = test::polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  d.materials = {{"a\nb", {}, {}}, {"", {}, {}}, {" c \\", {}, {}}, {"", {}, {}}};
  d.face_material = {3};
  const test::TemporaryFolder folder;
  write_obj(folder.path() / "out.obj", d);
  const SceneDescription back = describe_scene((folder.path() / "out.obj").string());
  ASSERT_EQ(back.materials.size(), 4u);
  EXPECT_EQ(back.materials[0].name, "a_b");
  EXPECT_THAT(back.face_material, ElementsAre(3));
}

TEST(ObjWriter, LeavesNoFileIfItCannotWrite) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "out.mtl");
  const SceneDescription d = test::polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_THROW(write_obj(folder.path() / "out.obj", d), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.obj"));
}

}  // namespace
}  // namespace transillum::scene_obj_reader_test
