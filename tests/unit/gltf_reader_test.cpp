// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// glTF: nodes, primitives and numbers in all their forms, the diffuse part of materials, textures,
// and the message for each refused file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <array>
#include <numbers>

#include "gltf_test_file.h"
#include "scene_test_support.h"
#include "transillum/files.h"

namespace transillum::gltf_reader_test {
namespace {

using nlohmann::json;
using test::square_in;
using File = test::GltfText;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

SceneDescription read(const File& file, const ReadOptions& options = {}) {
  return test::read_scene("a.glb", file.glb(), options);
}
std::string refusal_of(const std::string& text, const std::string& name = "a.gltf") {
  return test::scene_refusal(name, text);
}
const Material& material_of(const SceneDescription& d, std::size_t face) {
  return d.materials[static_cast<std::size_t>(d.face_material[face])];
}

TEST(Gltf, IsReadFromOneFileOrWithABufferBesideItOrInIt) {
  File file;
  file.add(square_in(file));
  const test::TemporaryFolder folder;
  folder.write("my data.bin", file.bytes);
  const std::string glb = folder.write("a.glb", file.glb());
  const std::string beside = folder.write("a.gltf", file.gltf("my%20data.bin"));
  for (const std::string& path : {glb, beside}) {
    const SceneDescription d = describe_scene(path);
    ASSERT_EQ(d.face_count(), 1U);
    EXPECT_THAT(d.outline(0), SizeIs(4));
    EXPECT_THAT(d.notes, Contains(HasSubstr("2 triangles joined to 1 polygons")));
  }
  EXPECT_THAT(describe_scene(beside).files,
              ElementsAre(beside, (folder.path() / "my data.bin").string()));
  EXPECT_EQ(read(file, {.join = false}).face_count(), 2U);
}

TEST(Gltf, PlacesMeshesByAllTheirNodes) {
  File file;
  const json primitive = square_in(file);
  // A parent that scales by 2, and a child that turns by 90 degrees about x and moves.
  const double h = std::numbers::sqrt2 / 2;
  file.add(primitive, {{"rotation", {h, 0, 0, h}}, {"translation", {0, 0, 1}}, {"name", "wall"}});
  file.root["nodes"].push_back({{"children", {0}}, {"scale", {2, 2, 2}}});
  file.root["scenes"][0]["nodes"] = {1};
  // The same mesh again, mirrored.
  file.root["nodes"].push_back(
      {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}});
  file.root["scenes"][0]["nodes"].push_back(2);
  const Scene scene(read(file));
  ASSERT_EQ(scene.patch_count(), 2);
  EXPECT_NEAR(scene.patch(0).area, 4, 1e-12);
  EXPECT_NEAR(norm(scene.patch(0).center - Vec3{1, 0, 3}), 0, 1e-12);
  EXPECT_NEAR(norm(scene.patch(0).normal - Vec3{0, -1, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(scene.patch(1).center - Vec3{4.5, 0.5, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(scene.patch(1).normal - Vec3{0, 0, 1}), 0, 1e-12);
  EXPECT_THAT(scene.groups(), ElementsAre("wall", "node 2"));
}

TEST(Gltf, TakesStripsFansAndTrianglesWithoutIndices) {
  File file;
  const int strip = file.points({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const int fan = file.points({0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1});
  const int plain = file.points({0, 0, 2, 1, 0, 2, 1, 1, 2});
  file.add({{"attributes", {{"POSITION", strip}}}, {"mode", 5}});
  file.add({{"attributes", {{"POSITION", fan}}}, {"mode", 6}});
  file.add({{"attributes", {{"POSITION", plain}}}});
  file.add({{"attributes", {{"POSITION", plain}}}, {"mode", 1}});
  const SceneDescription d = read(file);
  const Scene scene(d);
  ASSERT_EQ(scene.patch_count(), 3);
  for (PatchId i = 0; i < 3; ++i) {
    EXPECT_NEAR(scene.patch(i).area, (std::array{1.5, 1.0, 0.5}[static_cast<std::size_t>(i)]),
                1e-12);
    EXPECT_NEAR(scene.patch(i).normal.z, 1, 1e-12);
  }
  EXPECT_THAT(d.notes, Contains(HasSubstr("1 meshes of points or lines, omitted")));
}

TEST(Gltf, ReadsNumbersOfAllTypesAndSparseOnes) {
  File file;
  // Shorts normalized to 1, four numbers apart.
  const int view =
      file.view<std::int16_t>({0, 0, 0, 9, 32767, 0, 0, 9, 32767, 32767, 0, 9, 0, 32767, 0, 9}, 8);
  file.root["accessors"].push_back({{"bufferView", view},
                                    {"componentType", 5122},
                                    {"normalized", true},
                                    {"type", "VEC3"},
                                    {"count", 4}});
  const int bytes = file.accessor(file.view<std::uint8_t>({0, 1, 2, 0, 2, 3}), 5121, "SCALAR", 6);
  file.add({{"attributes", {{"POSITION", 0}}}, {"indices", bytes}});
  // All points of the square are 0, and then replaced.
  json sparse = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}};
  sparse["sparse"] = {
      {"count", 4},
      {"indices",
       {{"bufferView", file.view<std::uint16_t>({3, 2, 1, 0})}, {"componentType", 5123}}},
      {"values", {{"bufferView", file.view<float>({0, 1, 1, 1, 1, 1, 1, 0, 1, 0, 0, 1})}}}};
  file.root["accessors"].push_back(sparse);
  file.add({{"attributes", {{"POSITION", 2}}}, {"indices", bytes}});
  const Scene scene(read(file));
  ASSERT_EQ(scene.patch_count(), 2);
  EXPECT_NEAR(scene.patch(0).area, 1, 1e-12);
  EXPECT_NEAR(scene.patch(1).area, 1, 1e-12);
  EXPECT_NEAR(scene.patch(1).center.z, 1, 1e-12);
}

TEST(Gltf, HasTheDiffusePartOfItsMaterials) {
  File file;
  file.root["materials"] = {
      {{"name", "paint"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"metallicFactor", 0.2}}}},
      {{"name", "lamp"},
       {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
       {"emissiveFactor", {1, 0.5, 0}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}}},
      {{"name", "steel"}}};
  for (int m = -1; m < 3; ++m) {
    file.add(square_in(file, m), {{"translation", {0, 0, m}}});
  }
  const SceneDescription d = read(file);
  EXPECT_EQ(material_of(d, 0).reflectance, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_NEAR(material_of(d, 1).reflectance.r, 0.4, 1e-12);
  EXPECT_NEAR(material_of(d, 1).reflectance.b, 0.8, 1e-12);
  EXPECT_EQ(material_of(d, 2).reflectance, (Rgb{0.98, 0.98, 0.98}));
  EXPECT_NEAR(material_of(d, 2).exitance.r, 10 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(material_of(d, 2).exitance.g, 5 * std::numbers::pi, 1e-12);
  EXPECT_EQ(material_of(d, 3).reflectance, Rgb());
  EXPECT_THAT(d.notes, Contains(HasSubstr("`steel` is a metal")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("lamp: reflectance rho 1 1 1 is lowered to 0.98")));
  EXPECT_THAT(d.notes, Contains(HasSubstr("1 meshes have no material; rho = 0.5")));
  EXPECT_NEAR(material_of(read(file, {.photometric = true}), 2).exitance.r,
              10 * std::numbers::pi / 683, 1e-12);
}

TEST(Gltf, HasTheLobesOfItsMaterials) {
  File file;
  file.root["materials"] = {
      {{"name", "varnish"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.4}}}},
      {{"name", "brass"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.9, 0.8, 0.3, 1}}, {"roughnessFactor", 0.3}}}},
      {{"name", "chalk"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
      {{"name", "mirror"}, {"pbrMetallicRoughness", {{"roughnessFactor", 0}}}},
      {{"name", "older"},
       {"extensions",
        {{"KHR_materials_pbrSpecularGlossiness",
          {{"specularFactor", {0.2, 0.3, 0.4}}, {"glossinessFactor", 0.75}}}}}}};
  for (int m = 0; m < 5; ++m) {
    file.add(square_in(file, m), {{"translation", {0, 0, m}}});
  }
  const SceneDescription d = read(file);
  const Lobe varnish = material_of(d, 0).lobe, brass = material_of(d, 1).lobe;
  EXPECT_EQ(varnish.shape, LobeShape::ggx);
  EXPECT_EQ(varnish.reflectance, (Rgb{0.04, 0.04, 0.04}));
  EXPECT_EQ(varnish.roughness, 0.4);
  EXPECT_NEAR(brass.reflectance.g, 0.8, 1e-12);
  EXPECT_EQ(brass.roughness, 0.3);
  EXPECT_FALSE(material_of(d, 2).lobe.present());
  EXPECT_EQ(material_of(d, 3).lobe.roughness, 0.01);
  EXPECT_EQ(material_of(d, 4).lobe.reflectance, (Rgb{0.2, 0.3, 0.4}));
  EXPECT_EQ(material_of(d, 4).lobe.roughness, 0.25);
}

TEST(Gltf, DoubleSidedMaterialsGiveTwoPatches) {
  File file;
  file.root["materials"] = {{{"name", "leaf"}, {"doubleSided", true}}};
  file.add(square_in(file));
  file.add(square_in(file, 0), {{"translation", {0, 0, 1}}});
  const Scene scene(read(file));
  ASSERT_EQ(scene.patch_count(), 3);
  EXPECT_EQ(scene.patch(1).face, scene.patch(2).face);
  EXPECT_EQ(scene.patch(1).normal.z, -scene.patch(2).normal.z);
}

/// A PNG image of 64 x 64 pixels: the value is 188, a half in linear light, in the left half, 0 in
/// the right.
std::string half_image(const test::TemporaryFolder& folder) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(64, 64, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 3; ++c) {
        image->SetScalarComponentFromDouble(x, y, 0, c, x < 32 ? 188 : 0);
      }
    }
  }
  std::string path = folder / "half.png";
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
  return path;
}

/// Adds a square at a height with texture coordinates at its corners.
void add_textured(File& file, const std::vector<float>& uv, double z) {
  json primitive = square_in(file, 0);
  primitive["attributes"]["TEXCOORD_0"] = file.accessor(file.view(uv), 5126, "VEC2", 4);
  file.add(primitive, {{"translation", {0, 0, z}}});
}

/// The texture has metal (blue) and roughness (green), which are linear: 188 of 255.
TEST(Gltf, AveragesATextureOfMetalAndRoughness) {
  File file;
  file.root["images"] = {{{"uri", "half.png"}}};
  file.root["textures"] = {{{"source", 0}}};
  file.root["materials"] = {{{"name", "rust"},
                             {"pbrMetallicRoughness",
                              {{"baseColorFactor", {0.8, 0.4, 0.2, 1}},
                               {"metallicRoughnessTexture", {{"index", 0}}},
                               {"roughnessFactor", 0.5}}}}};
  add_textured(file, {0, 0, 1, 0, 1, 1, 0, 1}, 0);        // all
  add_textured(file, {0, 0, 0.5F, 0, 0.5F, 1, 0, 1}, 1);  // the left half: metal
  add_textured(file, {0.5F, 0, 1, 0, 1, 1, 0.5F, 1}, 2);  // the right half: smooth and no metal
  const test::TemporaryFolder folder;
  (void)half_image(folder);
  const SceneDescription d = describe_scene(folder.write("a.glb", file.glb()));
  ASSERT_EQ(d.face_count(), 3U);
  const double value = 188.0 / 255;
  const std::array metals{value / 2, value, 0.0};
  for (std::size_t f = 0; f < 3; ++f) {
    const Material& material = material_of(d, f);
    const double metal = metals[f];
    EXPECT_NEAR(material.reflectance.r, (1 - metal) * 0.8, 0.012) << f;
    EXPECT_NEAR(material.lobe.reflectance.r, 0.04 * (1 - metal) + metal * 0.8, 0.012) << f;
    EXPECT_NEAR(material.lobe.reflectance.b, 0.04 * (1 - metal) + metal * 0.2, 0.012) << f;
    EXPECT_NEAR(material.lobe.roughness, std::max(0.5 * metal, 0.01), 0.008) << f;
  }
}

TEST(Gltf, AveragesATextureOverEachFace) {
  File file;
  file.root["images"] = {{{"uri", "half.png"}}};
  file.root["textures"] = {{{"source", 0}}};
  file.root["materials"] = {{{"name", "poster"},
                             {"pbrMetallicRoughness",
                              {{"baseColorFactor", {1, 0.5, 1, 1}},
                               {"baseColorTexture", {{"index", 0}}},
                               {"metallicFactor", 0}}}}};
  file.root["materials"].push_back(
      {{"name", "plain"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.3, 0.6, 0.9, 1}}, {"metallicFactor", 0}}}});
  file.add(square_in(file, 1), {{"translation", {0, 0, -1}}});
  add_textured(file, {0, 0, 1, 0, 1, 1, 0, 1}, 0);                          // all
  add_textured(file, {0, 0, 0.5F, 0, 0.5F, 1, 0, 1}, 1);                    // the left half
  add_textured(file, {0.5F, 0, 1, 0, 1, 1, 0.5F, 1}, 2);                    // the right half
  add_textured(file, {-3, 0, 5, 0, 5, 8, -3, 8}, 3);                        // repeated
  add_textured(file, {0.1F, 0.1F, 0.1F, 0.1F, 0.1F, 0.1F, 0.1F, 0.1F}, 4);  // one point
  const test::TemporaryFolder folder;
  (void)half_image(folder);
  const SceneDescription d = describe_scene(folder.write("a.glb", file.glb()));
  ASSERT_EQ(d.face_count(), 6U);
  EXPECT_EQ(material_of(d, 0).reflectance, (Rgb{0.3, 0.6, 0.9}));
  const std::array expected{0.25, 0.5, 0.0, 0.25, 0.5};
  for (std::size_t f = 0; f < 5; ++f) {
    EXPECT_NEAR(material_of(d, f + 1).reflectance.r, expected[f], 0.006) << f;
    EXPECT_NEAR(material_of(d, f + 1).reflectance.g, expected[f] / 2, 0.003) << f;
    EXPECT_EQ(material_of(d, f + 1).name, "poster");
  }
  EXPECT_THAT(d.files, Contains((folder.path() / "half.png").string()));
  // Without the image, the default reflectance is taken for it.
  const test::TemporaryFolder empty;
  const SceneDescription missing = describe_scene(empty.write("a.glb", file.glb()));
  EXPECT_NEAR(material_of(missing, 1).reflectance.g, 0.5 * 0.5, 1e-12);
  EXPECT_THAT(
      missing.notes,
      Contains(HasSubstr(
          "image 0, `half.png`, has no data; reflectance 0.5 is assumed for it, and no light")));
}

TEST(Gltf, ColorsOfVerticesFilterTheBaseColor) {
  File file;
  file.root["materials"] = {
      {{"name", "paint"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.8, 0.8, 1}}, {"metallicFactor", 0}}}}};
  json primitive = square_in(file, 0);
  primitive["attributes"]["COLOR_0"] = file.accessor(
      file.view<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}), 5126, "VEC4", 4);
  file.add(primitive);
  const Rgb rho = material_of(read(file), 0).reflectance;
  EXPECT_NEAR(rho.r, 0.8, 1e-12);
  EXPECT_EQ(rho.g, 0);
}

/// A square with a texture over all of it, `image` in its file.
File textured_square(const json& texture, const json& image, const json& material) {
  File file;
  // Compilers differ about what {image} makes of one value.
  file.root["images"] = json::array({image});
  file.root["textures"] = json::array({texture});
  file.root["materials"] = json::array({material});
  add_textured(file, {0, 0, 1, 0, 1, 1, 0, 1}, 0);
  return file;
}
json poster_of(const json& base) {
  return {
      {"name", "poster"},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", base}, {"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}};
}

// The factor of a texture is 1 on nearly every model; no face has that reflectance.
TEST(Gltf, WarnsOfLoweredReflectanceOnlyWhereAFaceHasIt) {
  const test::TemporaryFolder folder;
  (void)half_image(folder);
  File file = textured_square({{"source", 0}}, {{"uri", "half.png"}}, poster_of({1, 1, 1, 1}));
  json unused = poster_of({1, 1, 1, 1});
  unused["name"] = "unused";
  file.root["materials"].push_back(unused);
  const SceneDescription d = describe_scene(folder.write("a.glb", file.glb()));
  EXPECT_NEAR(material_of(d, 0).reflectance.r, 0.25, 0.006);
  EXPECT_THAT(d.notes, ::testing::Not(Contains(HasSubstr("is lowered"))));
}

TEST(Gltf, NamesATextureThatIsMissing) {
  const SceneDescription d =
      read(textured_square({{"source", 0}}, {{"uri", "wood.png"}}, poster_of({1, 0.5, 1, 1})));
  EXPECT_THAT(
      d.notes,
      Contains(HasSubstr(
          "image 0, `wood.png`, has no data; reflectance 0.5 is assumed for it, and no light")));
  EXPECT_EQ(material_of(d, 0).reflectance, (Rgb{0.5, 0.25, 0.5}));
}

// No reader for Basis Universal exists; white would be the brightest of all guesses.
TEST(Gltf, KtxTexturesGiveTheDefaultReflectance) {
  const json texture = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
  const json image = {{"uri", "wood.ktx2"}, {"mimeType", "image/ktx2"}};
  File file = textured_square(texture, image, poster_of({1, 0.5, 1, 1}));
  file.root["extensionsRequired"] = {"KHR_texture_basisu"};
  const SceneDescription d = read(file, {.default_reflectance = 0.25});
  EXPECT_EQ(material_of(d, 0).reflectance, (Rgb{0.25, 0.125, 0.25}));
  EXPECT_THAT(d.notes, Contains(HasSubstr("texture 0, `wood.ktx2`, is no PNG or JPEG image; "
                                          "reflectance 0.25 is assumed for it")));
  // Without the texture of metalness, nothing is metal; without the texture of emission, nothing
  // emits.
  json metal = {
      {"name", "tin"},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
      {"emissiveTexture", {{"index", 0}}},
      {"emissiveFactor", {1, 1, 1}}};
  const SceneDescription tin = read(textured_square(texture, image, metal));
  EXPECT_EQ(material_of(tin, 0).reflectance, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_EQ(material_of(tin, 0).exitance, Rgb());
  // A fallback is used.
  json with_fallback = texture;
  with_fallback["source"] = 0;
  const test::TemporaryFolder folder;
  (void)half_image(folder);
  const SceneDescription half = describe_scene(folder.write(
      "a.glb",
      textured_square(with_fallback, {{"uri", "half.png"}}, poster_of({1, 1, 1, 1})).glb()));
  EXPECT_NEAR(material_of(half, 0).reflectance.r, 0.25, 0.006);
}

TEST(Gltf, NodesWithoutExtentAreLeftOut) {
  for (const json& node : {json{{"matrix", json(std::vector<int>(16, 0))}},
                           json{{"scale", {0, 0, 0}}}, json{{"scale", {1, 0, 0}}}}) {
    File file;
    const json primitive = square_in(file);
    file.add(primitive);
    file.add(primitive, node);
    const SceneDescription d = read(file);
    EXPECT_EQ(d.face_count(), 1U);
    EXPECT_THAT(d.notes,
                Contains(HasSubstr("1 nodes whose scale is 0, omitted; the first is node 1")));
  }
  File alone;
  alone.add(square_in(alone), {{"scale", {0, 0, 0}}});
  EXPECT_THAT(refusal_of(alone.glb(), "a.glb"),
              HasSubstr("node 0, or one above it, has a scale of 0"));
}

// Refused as invalid: more than 1,000,000 values.
TEST(Gltf, HasAnyNumberOfMeshes) {
  File file;
  const json primitive = square_in(file);
  constexpr int meshes = 40'000;
  for (int k = 0; k < meshes; ++k) {
    file.root["meshes"].push_back({{"primitives", {primitive}}, {"name", "m"}});
    file.root["nodes"].push_back(
        {{"mesh", k},
         {"translation", {2 * (k % 200), 0, 2 * (k / 200)}},
         {"name", "n"},
         {"extras", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20}}});
    file.root["scenes"][0]["nodes"].push_back(k);
  }
  EXPECT_EQ(read(file).face_count(), static_cast<std::size_t>(meshes));
}

TEST(Gltf, RefusesNumbersOfPlacesThatAreNoWholeNumbers) {
  File file;
  file.add(square_in(file));
  struct Place {
    const char* list;
    std::size_t index;
    const char* key;
    json value;
  };
  for (const auto& [list, index, key, value] : {Place{"bufferViews", 0, "byteOffset", -4},
                                                {"bufferViews", 1, "byteStride", -12},
                                                {"accessors", 1, "byteOffset", -2},
                                                {"accessors", 0, "byteOffset", 1.5},
                                                {"accessors", 0, "bufferView", -1},
                                                {"accessors", 0, "byteOffset", "12"}}) {
    File changed = file;
    changed.root[list][index][key] = value;
    EXPECT_EQ(refusal_of(changed.glb(), "a.glb"),
              fmt::format("a.glb: {} {}: {} {} is not a whole number of at least 0", list, index,
                          key, value.dump()));
  }
}

TEST(Gltf, MessagesDoNotRepeatData) {
  File file;
  file.add(square_in(file));
  const std::string data(1000, 'A');
  for (const std::string type : {"application/octet-stream", "application/x-unknown"}) {
    const std::string begin = fmt::format("data:{};base64,", type);
    const std::string message = refusal_of(file.gltf(begin + data));
    EXPECT_THAT(message, HasSubstr("a.gltf: is not a valid glTF file: "));
    EXPECT_THAT(message, HasSubstr(begin + "…"));
    EXPECT_EQ(message.find("AAAA"), std::string::npos) << message;
  }
}

// An unknown extension is reported before the buffers that it would make are missed.
TEST(Gltf, ExtensionsAreLookedAtBeforeBuffers) {
  File file;
  file.add(square_in(file));
  file.root["extensionsRequired"] = {"EXT_other_compression", "KHR_materials_unlit"};
  EXPECT_THAT(refusal_of(file.gltf("gone.bin")),
              HasSubstr("a.gltf: requires EXT_other_compression, which cannot be read"));
}

TEST(Gltf, RefusesWhatIsBroken) {
  File file;
  file.add(square_in(file));
  EXPECT_THAT(refusal_of("{", "a.gltf"), HasSubstr("a.gltf, line 1, column 1: invalid JSON"));
  EXPECT_THAT(refusal_of("{}"), HasSubstr("a.gltf: is not a valid glTF file"));
  EXPECT_THAT(refusal_of("glTF"), HasSubstr("a.gltf: is cut"));
  EXPECT_THAT(refusal_of(file.glb().substr(0, 300), "a.glb"), HasSubstr("a.glb: is cut"));
  struct Change {
    const char* pointer;  ///< to a value in the JSON text
    json value;
    const char* expected;
  };
  const Change changes[] = {
      {"/asset/version", "1.0", "is of version `1.0` of glTF"},
      {"/extensionsRequired", json::array({"EXT_other_compression"}),
       "requires EXT_other_compression, which cannot be read"},
      {"/accessors/0/count", 5, "buffer view 0 has no 60 bytes from byte 0"},
      {"/accessors/0/count", 4'000'000'000U,
       "accessor 0 has 4000000000 entries; at most 20000000 are left"},
      {"/accessors/0/bufferView", 7, "buffer view 7 does not exist; there are 2"},
      {"/bufferViews/0/byteOffset", 1U << 31, "a.glb: buffer view 0 has no"},
      {"/accessors/0/type", "VEC2", "accessor 0 must have 3 numbers per entry"},
      {"/accessors/1/componentType", 5126, "accessor 1 must have whole numbers"},
      {"/nodes/0/children", json::array({0}), "node 0 has two parents or is a child of itself"},
      {"/nodes/0/mesh", 3, "node 0: mesh 3 does not exist; there are 1"},
      {"/meshes/0/primitives/0/material", 0,
       "node 0, mesh 0: material 0 does not exist; there are 0"},
      {"/nodes/0/translation", json::array({0, 1e300, 0}),
       "node 0, mesh 0: vertex 0 is not a finite point"},
      {"/scenes/0/nodes", json::array(), "has no triangles"},
  };
  for (const Change& change : changes) {
    File changed = file;
    changed.root[json::json_pointer(change.pointer)] = change.value;
    EXPECT_THAT(refusal_of(changed.glb(), "a.glb"), HasSubstr(change.expected)) << change.pointer;
  }
  File far;
  json primitive = square_in(far);
  primitive["indices"] = far.indices({0, 1, 4});
  far.add(primitive);
  EXPECT_THAT(refusal_of(far.glb(), "a.glb"), HasSubstr("vertex 4 does not exist; there are 4"));
}

TEST(Gltf, BoundsWhatInstancesMultiply) {
  File file;
  const json primitive = square_in(file);
  file.root["meshes"].push_back({{"primitives", json::array()}});
  for (int k = 0; k < 3000; ++k) {
    file.root["meshes"][0]["primitives"].push_back(primitive);
  }
  for (int k = 0; k < 3000; ++k) {
    file.root["nodes"].push_back({{"mesh", 0}});
    file.root["scenes"][0]["nodes"].push_back(k);
  }
  EXPECT_THAT(refusal_of(file.glb(), "a.glb"), HasSubstr("at most"));
}

}  // namespace
}  // namespace transillum::gltf_reader_test
