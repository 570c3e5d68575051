// transillum: diffuse light by the transillumination method. GPL-3.0-or-later. Imperfect material
// files: missing, misspelt or invalid values are replaced, with a warning that gives the place, the
// value and the number of faces.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene_test_support.h"

namespace transillum::scene_repairs_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string face = "f 1 2 3\n";
const std::string textures = std::string(TRANSILLUM_DATA_DIR) + "/corpus/textures/";

/// A folder with s.obj and s.mtl.
class SceneRepairs : public ::testing::Test {
 protected:
  SceneDescription read(const std::string& obj, const std::string& mtl = "",
                        const ReadOptions& options = {}) const {
    if (!mtl.empty()) {
      folder_.write("s.mtl", mtl);
    }
    return describe_scene(folder_.write("s.obj", obj), options);
  }
  /// One face of material `m`, defined as `mtl`.
  SceneDescription with_material(const std::string& mtl, const ReadOptions& options = {}) const {
    return read("mtllib s.mtl\n" + square + "usemtl m\n" + face, "newmtl m\n" + mtl, options);
  }
  void copy_texture(const std::string& name, const std::string& to) const {
    std::filesystem::copy_file(textures + name, folder_.path() / to);
  }
  static Rgb reflectance(const SceneDescription& d, std::size_t f = 0) {
    return at(d.materials, d.face_material[f]).reflectance;
  }

  test::TemporaryFolder folder_;
};

TEST_F(SceneRepairs, ReflectancesOfOneAndMoreAreLoweredPerChannel) {
  const SceneDescription d = with_material("Kd 1 .3 7\n");
  EXPECT_EQ(reflectance(d), (Rgb{.98, .3, .98}));
  EXPECT_THAT(d.notes,
              ElementsAre(HasSubstr(
                  "s.mtl:1: material `m`: reflectance rho (Kd) 1 0.3 7 is lowered to 0.98")));
  EXPECT_EQ(reflectance(with_material("Kd 1e400 .3 .3\n")), (Rgb{.98, .3, .3}));
  EXPECT_EQ(reflectance(with_material("Kd 0.99999997 .3 .3\n")), (Rgb{.98, .3, .3}))
      << "1 in single precision, rounded";
}

TEST_F(SceneRepairs, ReflectancesBelowOneAreKeptUnlessALimitIsGiven) {
  const SceneDescription kept = with_material("Kd .99 .999 .5\n");
  EXPECT_EQ(reflectance(kept), (Rgb{.99, .999, .5}));
  EXPECT_THAT(kept.notes, IsEmpty());
  const SceneDescription lowered = with_material("Kd .99 1 .5\n", {.max_reflectance = .9});
  EXPECT_EQ(reflectance(lowered), (Rgb{.9, .9, .5}));
  EXPECT_EQ(lowered.notes.size(), 1u);
}

TEST_F(SceneRepairs, AMissingMaterialFileGivesTheDefault) {
  const SceneDescription d =
      read("mtllib gone.mtl\n" + square + "usemtl a\n" + face + face + "usemtl b\n" + face, "",
           {.default_reflectance = .25});
  EXPECT_EQ(reflectance(d, 0), (Rgb{.25, .25, .25}));
  EXPECT_EQ(at(d.materials, d.face_material[2]).name, "b") << "so that options can name it";
  EXPECT_THAT(
      d.notes,
      ElementsAre(
          HasSubstr("s.obj:1: MTL file `gone.mtl` not found"),
          AllOf(HasSubstr("s.obj:6: material `a` is not defined; rho = 0.25, E = 0 assumed for 2 "
                          "faces")),
          HasSubstr("s.obj:9: material `b` is not defined; rho = 0.25, E = 0 assumed for 1 face")));
}

TEST_F(SceneRepairs, SimilarNamesAreSuggested) {
  const SceneDescription d = read("mtllib t.mtl\nmtllib s.mtl\n" + square + "usemtl whit\n" + face,
                                  "newmtl white\nKd .7 .7 .7\n");
  EXPECT_THAT(d.notes, Contains(HasSubstr("MTL file `t.mtl` not found; did you mean `s.mtl`")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("for 1 face; did you mean \"white\"?")));
}

TEST_F(SceneRepairs, OneMissingOfSeveralMaterialFilesIsToldAndTheOthersRead) {
  for (const std::string line :
       {"mtllib gone.mtl s.mtl\n", "mtllib s.mtl gone.mtl\n", "mtllib my gone.mtl s.mtl\n"}) {
    const SceneDescription d =
        read(fmt::format("{}{}usemtl m\n{}", line, square, face), "newmtl m\nKd .7 .7 .7\n");
    EXPECT_EQ(reflectance(d), (Rgb{.7, .7, .7})) << line;
    EXPECT_THAT(d.notes, ElementsAre(HasSubstr("gone.mtl` not found"))) << line;
  }
}

TEST_F(SceneRepairs, MaterialFilesAreFoundByQuotesCaseAndForeignPaths) {
  folder_.write("my walls.mtl", "newmtl m\nKd .7 .7 .7\n");
  std::filesystem::create_directory(folder_.path() / "Sub");
  folder_.write("Sub/Other.mtl", "newmtl o\nKd .2 .2 .2\n");
  for (const std::string name :
       {"my walls.mtl", "\"my walls.mtl\"", "'my walls.mtl'", "My Walls.MTL", "my walls.mtl  ",
        "C:\\scenes\\my walls.mtl", "..\\my walls.mtl", "/home/x/scenes/my walls.mtl",
        "\"C:\\a b\\MY WALLS.mtl\"", "sub\\other.MTL my walls.mtl",
        "\"D:\\x\\sub\\Other.mtl\" \"my walls.mtl\""}) {
    const SceneDescription d = read(fmt::format("mtllib {}\n{}usemtl m\n{}", name, square, face));
    EXPECT_EQ(reflectance(d), (Rgb{.7, .7, .7})) << name;
    EXPECT_THAT(d.notes, IsEmpty()) << name;
  }
}

TEST_F(SceneRepairs, MaterialsAreFoundByQuotesAndCase) {
  const std::string mtl =
      "newmtl \"Red Wall\"\nKd .7 .7 .7\nnewmtl wall\nKd .1 .1 .1\n"
      "newmtl Wall\nKd .2 .2 .2\n";
  const SceneDescription d =
      read("mtllib s.mtl\n" + square + "usemtl red wall\n" + face + "usemtl \"Red Wall\"\n" + face +
               "usemtl Wall\n" + face + "usemtl wall\n" + face + "usemtl WALL\n" + face,
           mtl);
  std::vector<double> rho;
  for (std::size_t f = 0; f < 5; ++f) {
    rho.push_back(reflectance(d, f).r);
  }
  EXPECT_THAT(rho, ElementsAre(.7, .7, .2, .1, .1));
  EXPECT_THAT(d.notes, IsEmpty());
}

TEST_F(SceneRepairs, NamelessMaterialsGetTheDefault) {
  const SceneDescription d =
      read("mtllib s.mtl\n" + square + "usemtl\n" + face + "usemtl \"\"\n" + face + "mtllib\n",
           "newmtl \nKd .8 .8 .8\nnewmtl a\nKd .7 .7 .7\n");
  EXPECT_EQ(reflectance(d), (Rgb{.5, .5, .5}));
  EXPECT_EQ(d.materials.size(), 2u);
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.mtl:1: newmtl has no name")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.obj:6: usemtl has no name")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("s.obj:10: mtllib has no file name")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("2 of 2 faces have no material (usemtl); rho = 0.5")));
}

TEST_F(SceneRepairs, ThousandsOfWarningsAreCounted) {
  std::string obj = square, mtl;
  for (int k = 0; k < 5000; ++k) {
    obj += fmt::format("mtllib gone{0}.mtl\nusemtl u{0}\n{1}usemtl w{0}\n{1}", k, face);
    mtl += "newmtl w" + std::to_string(k) + "\nKd 1 1 1\n";
  }
  const SceneDescription d = read("mtllib s.mtl\n" + obj, mtl);
  EXPECT_EQ(d.notes.size(), 33u);
  EXPECT_THAT(d.notes, Contains("and 4990 more missing MTL files"));
  EXPECT_THAT(d.notes, Contains("and 4990 more materials that are not defined"));
  EXPECT_THAT(d.notes, Contains("and 4990 more materials, whose reflectance is lowered"));
}

TEST_F(SceneRepairs, ATextureGivesItsAverageInLinearLight) {
  copy_texture("checker.png", "checker.png");
  copy_texture("Gray Wall.JPG", "Gray Wall.JPG");
  // A black and a white pixel, and transparent ones that do not count.
  const SceneDescription png = with_material("Kd 0 0 0\nmap_Kd checker.png\n");
  EXPECT_EQ(reflectance(png), (Rgb{.5, .5, .5}));
  EXPECT_THAT(png.notes,
              ElementsAre(HasSubstr("material `m`: Kd is 0; rho = 0.5, 0.5, 0.5, the "
                                    "average of texture `checker.png` in linear light")));
  EXPECT_EQ(png.files.size(), 3u) << "must not be overwritten";
  // sRGB 188 is 0.503 of linear light, not 188/255.
  const SceneDescription jpeg = with_material("map_Kd -s 2 2 2 -clamp on X:\\t\\gray wall.jpg\n");
  EXPECT_NEAR(reflectance(jpeg).g, .5028864580325687, .005);
}

TEST_F(SceneRepairs, TheAverageOfATextureIsLimitedToo) {
  copy_texture("checker.png", "t.png");
  EXPECT_EQ(reflectance(with_material("Kd 0 0 0\nmap_Kd t.png\n", {.max_reflectance = .4})),
            (Rgb{.4, .4, .4}));
}

TEST_F(SceneRepairs, UnreadableTexturesGiveTheDefault) {
  copy_texture("broken.jpg", "cut.jpg");
  folder_.write("cut.png", "\x89PNG\r\n\x1a\n");
  folder_.write("text.png", "not an image");
  std::filesystem::create_directory(folder_.path() / "folder.png");
  const std::vector<std::pair<std::string, std::string>> rows{
      {"gone.png", "texture `gone.png` is not found; rho = 0.5 assumed"},
      {"cut.jpg", "is a broken image"},
      {"cut.png", "is a broken image"},
      {"text.png", "is not a PNG or JPEG image"},
      {"folder.png", "is not a file"}};
  for (const auto& [name, problem] : rows) {
    const SceneDescription d = with_material("Kd 0 0 0\nmap_Kd " + name + "\n");
    EXPECT_EQ(reflectance(d), (Rgb{.5, .5, .5})) << name;
    EXPECT_THAT(d.notes, ElementsAre(HasSubstr(problem))) << name;
  }
}

TEST_F(SceneRepairs, HugeTexturesAreNotRead) {
  // A PNG header of 65,536 x 65,536 pixels, with its checksum.
  folder_.write("huge.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\1\0\0\x08\2\0\0\0"
                                        "\xe3\xe6\xa7\xb4\0\0\0\0IDAT\x35\xaf\x06\x1e",
                                        45));
  const SceneDescription d = with_material("Kd 0 0 0\nmap_Kd huge.png\n");
  EXPECT_EQ(reflectance(d), (Rgb{.5, .5, .5}));
  EXPECT_THAT(d.notes, ElementsAre(HasSubstr("has 65536 x 65536 pixels; the limit is 67108864")));
}

TEST_F(SceneRepairs, ATextureOfAMaterialWithAColorIsIgnored) {
  copy_texture("checker.png", "checker.png");
  const SceneDescription d = with_material("Kd .2 .2 .2\nmap_Kd checker.png\n");
  EXPECT_EQ(reflectance(d), (Rgb{.2, .2, .2}));
  EXPECT_THAT(d.notes, ElementsAre(HasSubstr("s.mtl:3: texture map `map_Kd` is ignored")));
}

TEST_F(SceneRepairs, AScaleMultipliesAllCoordinates) {
  const SceneDescription d = read("v 0 0 0\nv 3 0 0\nv 0 5 0\n" + face, "", {.scale = .5});
  EXPECT_EQ(d.points, (std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}, {0, 2.5, 0}}));
  EXPECT_EQ(describe_scene("furnace", {.scale = 2}).points.size(),
            describe_scene("furnace").points.size());
  EXPECT_EQ(length_unit_from_name("in"), 0.0254);
  EXPECT_THAT(test::refusal([] { length_unit_from_name("yd"); }),
              HasSubstr("choose one of mm, cm, m, in, ft"));
}

TEST_F(SceneRepairs, ImpossibleOptionsAreRefused) {
  EXPECT_THAT(test::refusal([] { describe_scene("furnace", {.default_reflectance = 1}); }),
              HasSubstr("the default reflectance is 1, but must be >= 0 and < 1"));
  EXPECT_THAT(test::refusal([] { describe_scene("furnace", {.max_reflectance = -.1}); }),
              HasSubstr("the maximum reflectance is -0.1"));
  for (const double scale : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THAT(test::refusal([&] { describe_scene("furnace", {.scale = scale}); }),
                HasSubstr("the scale is"));
  }
}

/// Patches that the rounding of a file had bent were refused in the result of their own solve.
TEST(PatchesOfResults, AreKeptThoughRoundingHasBentThem) {
  SceneDescription description;
  description.name = "bent";
  description.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 7.25342e-4}, {0, 1, 0}};
  description.corners = {0, 1, 2, 3};
  description.face_begin = {0};
  description.face_line = {1};
  description.materials.resize(1);
  description.materials[0].reflectance = {0.5, 0.5, 0.5};
  description.face_material = {0};
  EXPECT_EQ(Scene(description).patch_count(), 2);
  description.faces_are_patches = true;
  const Scene scene(description);
  ASSERT_EQ(scene.patch_count(), 1);
  EXPECT_EQ(scene.point(scene.outline(0)[2]), description.points[2]);
  EXPECT_THAT(scene.report().warnings, IsEmpty());
}

TEST(CorpusMaterials, AllRepairsInOneFile) {
  const auto scene = load_scene(std::string(TRANSILLUM_DATA_DIR) + "/corpus/materials.obj");
  EXPECT_TRUE(scene->has_light());
  EXPECT_EQ(scene->reflectance(0), (Rgb{.98, .98, .98}));
  EXPECT_EQ(scene->reflectance(1), (Rgb{.6, .1, .98}));
  EXPECT_EQ(scene->reflectance(4), (Rgb{.5, .5, .5}));
  EXPECT_NEAR(scene->reflectance(6).r, .503, .005);
  EXPECT_THAT(scene->groups(), ElementsAre("room", "lights of the ceiling"));
  EXPECT_EQ(scene->patch(0).group, 0);
  EXPECT_EQ(scene->patch(5).group, 1);
  EXPECT_EQ(scene->patch(6).group, no_group);
  EXPECT_FALSE(
      load_scene(std::string(TRANSILLUM_DATA_DIR) + "/corpus/no-materials.obj")->has_light());
}

TEST(CoveredFaces, AreThoseThatAreNotSeen) {
  const auto covered = [](const SceneDescription& d, const SceneOptions& options = {}) {
    return Scene(d, options).report().covered_faces;
  };
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  // The later of two faces with the same direction covers the other; a turned face is seen.
  SceneDescription d = test::polygons(points, {{0, 1, 2, 3}, {2, 3, 0, 1}, {3, 2, 1, 0}});
  EXPECT_THAT(covered(d), ElementsAre(0));
  EXPECT_THAT(covered(d, {.two_sided = true}), ElementsAre(0, 1));
  // The brighter face covers the other, whatever the order.
  d.materials.push_back({"lamp", {}, {1, 1, 1}});
  d.face_material[0] = 1;
  EXPECT_THAT(covered(d), ElementsAre(1));
  EXPECT_THAT(
      Scene(d).report().warnings,
      Contains(HasSubstr("face 1: covered by a face on the same points: it gets no light")));
}

}  // namespace
}  // namespace transillum::scene_repairs_test
