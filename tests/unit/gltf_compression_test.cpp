// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// glTF: meshes compressed by meshoptimizer and Draco give the scene of the uncompressed file, and
// damaged meshes give an error or a scene. The files are made by the encoders of both libraries.
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <chrono>
#include <cmath>
#include <random>

#include "gltf_test_file.h"
#include "scene/read/gltf/gltf_compression.h"
#include "scene_test_support.h"

namespace transillum::gltf_compression_test {
namespace {

using nlohmann::json;
using test::GltfText;
using ::testing::HasSubstr;
using Bytes = std::vector<unsigned char>;

/// A wavy sheet of cells x cells squares of two triangles.
struct Sheet {
  explicit Sheet(int cells) {
    for (int y = 0; y <= cells; ++y) {
      for (int x = 0; x <= cells; ++x) {
        const float u = static_cast<float>(x) / static_cast<float>(cells),
                    v = static_cast<float>(y) / static_cast<float>(cells);
        points.insert(points.end(), {4 * u, 3 * v, 0.2F * std::sin(9 * u) * std::cos(7 * v)});
        texture.insert(texture.end(), {u, v});
      }
    }
    const auto n = static_cast<std::uint32_t>(cells + 1);
    for (std::uint32_t y = 0; y + 1 < n; ++y) {
      for (std::uint32_t x = 0; x + 1 < n; ++x) {
        const std::uint32_t a = y * n + x;
        indices.insert(indices.end(), {a, a + 1, a + n + 1, a, a + n + 1, a + n});
      }
    }
  }
  std::size_t vertices() const { return points.size() / 3; }

  std::vector<float> points, texture;
  std::vector<std::uint32_t> indices;
};

GltfText plain(const Sheet& sheet) {
  GltfText file;
  file.add(
      {{"attributes", {{"POSITION", file.points(sheet.points)}}},
       {"indices", file.accessor(file.view(sheet.indices), 5125, "SCALAR", sheet.indices.size())}});
  return file;
}

// meshoptimizer -------------------------------------------------------------------------------

Bytes packed_vertices(const void* data, std::size_t count, std::size_t stride) {
  Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, count, stride));
  return bytes;
}
Bytes packed_indices(const Sheet& sheet, bool sequence) {
  Bytes bytes(sequence ? meshopt_encodeIndexSequenceBound(sheet.indices.size(), sheet.vertices())
                       : meshopt_encodeIndexBufferBound(sheet.indices.size(), sheet.vertices()));
  const auto encode = [&](auto encoder) {
    return encoder(bytes.data(), bytes.size(), sheet.indices.data(), sheet.indices.size());
  };
  bytes.resize(sequence ? encode(meshopt_encodeIndexSequence<unsigned int>)
                        : encode(meshopt_encodeIndexBuffer<unsigned int>));
  return bytes;
}

/// Adds a view of these compressed bytes, of a placeholder as gltfpack writes them.
int packed_view(GltfText& file, const Bytes& bytes, const char* mode, std::size_t count,
                std::size_t stride, const char* filter = "NONE") {
  const int view = file.view(bytes);
  json& made = file.root["bufferViews"].back();
  made["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                   {"byteOffset", made["byteOffset"]},
                                                   {"byteLength", bytes.size()},
                                                   {"count", count},
                                                   {"byteStride", stride},
                                                   {"mode", mode},
                                                   {"filter", filter}};
  made["buffer"] = 1;
  made["byteOffset"] = 0;
  made["byteLength"] = count * stride;
  return view;
}

GltfText by_meshopt(const Sheet& sheet, bool sequence = false) {
  GltfText file;
  const int points = packed_view(file, packed_vertices(sheet.points.data(), sheet.vertices(), 12),
                                 "ATTRIBUTES", sheet.vertices(), 12);
  const int indices = packed_view(file, packed_indices(sheet, sequence),
                                  sequence ? "INDICES" : "TRIANGLES", sheet.indices.size(), 4);
  file.add({{"attributes", {{"POSITION", file.accessor(points, 5126, "VEC3", sheet.vertices())}}},
            {"indices", file.accessor(indices, 5125, "SCALAR", sheet.indices.size())}});
  file.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  file.placeholder = 1'000'000;
  return file;
}

// Draco ---------------------------------------------------------------------------------------

/// Quantized to 14 bits, unless `bits` is 0; attribute 0 is POSITION, attribute 1 has the texture
/// coordinates.
Bytes by_encoder(const Sheet& sheet, int method, int bits) {
  draco::Mesh mesh;
  const auto count = static_cast<std::uint32_t>(sheet.vertices());
  mesh.set_num_points(count);
  const auto add = [&](draco::GeometryAttribute::Type type, const std::vector<float>& numbers,
                       std::int8_t components) {
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), draco::DT_FLOAT32, false,
                   4 * components, 0);
    draco::PointAttribute* const made = mesh.attribute(mesh.AddAttribute(attribute, true, count));
    for (std::uint32_t v = 0; v < count; ++v) {
      made->SetAttributeValue(draco::AttributeValueIndex(v),
                              numbers.data() + static_cast<std::size_t>(components) * v);
    }
  };
  add(draco::GeometryAttribute::POSITION, sheet.points, 3);
  add(draco::GeometryAttribute::TEX_COORD, sheet.texture, 2);
  for (std::size_t k = 0; k < sheet.indices.size(); k += 3) {
    mesh.AddFace({draco::PointIndex(sheet.indices[k]), draco::PointIndex(sheet.indices[k + 1]),
                  draco::PointIndex(sheet.indices[k + 2])});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  if (bits > 0) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, bits);
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  const auto* const bytes = reinterpret_cast<const unsigned char*>(buffer.data());
  return {bytes, bytes + buffer.size()};
}

GltfText by_draco(const Sheet& sheet, const Bytes& bytes) {
  GltfText file;
  const int view = file.view(bytes);
  for (const auto& [component, type, count] : {std::tuple{5126, "VEC3", sheet.vertices()},
                                               {5126, "VEC2", sheet.vertices()},
                                               {5125, "SCALAR", sheet.indices.size()}}) {
    file.root["accessors"].push_back(
        {{"componentType", component}, {"type", type}, {"count", count}});
  }
  json primitive = {{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}};
  file.add(primitive);
  file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return file;
}

SceneDescription read(const std::string& bytes, const ReadOptions& options = {.join = false}) {
  return test::read_scene("a.glb", bytes, options);
}
std::string refusal_of(const GltfText& file) { return test::scene_refusal("a.glb", file.glb()); }

/// The corners of all faces, each face from its least corner on; faces in any order.
std::vector<std::array<Vec3, 3>> triangles_of(const SceneDescription& d) {
  std::vector<std::array<Vec3, 3>> all;
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  for (std::size_t f = 0; f < d.face_count(); ++f) {
    std::array<Vec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = d.points[static_cast<std::size_t>(d.outline(f)[k])];
    }
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end(), less),
                triangle.end());
    all.push_back(triangle);
  }
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return all;
}

TEST(GltfCompression, MeshoptimizerGivesTheSceneOfThePlainFile) {
  const Sheet sheet(20);
  const auto expected = triangles_of(read(plain(sheet).glb()));
  for (const bool sequence : {false, true}) {
    EXPECT_EQ(triangles_of(read(by_meshopt(sheet, sequence).glb())), expected);
  }
  // The file is text, with a placeholder that has no data.
  const GltfText file = by_meshopt(sheet);
  const test::TemporaryFolder folder;
  folder.write("a.bin", file.bytes);
  EXPECT_EQ(
      triangles_of(describe_scene(folder.write("a.gltf", file.gltf("a.bin")), {.join = false})),
      expected);
}

TEST(GltfCompression, MeshoptimizersFiltersAreApplied) {
  const Sheet sheet(6);
  std::vector<float> filtered(sheet.points.size());
  meshopt_encodeFilterExp(filtered.data(), sheet.vertices(), 12, 16, sheet.points.data());
  GltfText file = plain(sheet);
  const int view = packed_view(file, packed_vertices(filtered.data(), sheet.vertices(), 12),
                               "ATTRIBUTES", sheet.vertices(), 12, "EXPONENTIAL");
  file.root["accessors"][0]["bufferView"] = view;
  file.placeholder = 1000;
  const auto read_triangles = triangles_of(read(file.glb()));
  const auto expected = triangles_of(read(plain(sheet).glb()));
  ASSERT_EQ(read_triangles.size(), expected.size());
  double area = 0, expected_area = 0;
  for (std::size_t t = 0; t < expected.size(); ++t) {
    const auto area_of = [](const std::array<Vec3, 3>& p) {
      return norm(cross(p[1] - p[0], p[2] - p[0]));
    };
    area += area_of(read_triangles[t]);
    expected_area += area_of(expected[t]);
  }
  EXPECT_NEAR(area, expected_area, 1e-3 * expected_area);
}

TEST(GltfCompression, DracoGivesTheSceneOfThePlainFile) {
  const Sheet sheet(20);
  const auto expected = triangles_of(read(plain(sheet).glb()));
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    SCOPED_TRACE(method);
    EXPECT_EQ(triangles_of(read(by_draco(sheet, by_encoder(sheet, method, 0)).glb())), expected);
    // With 14 bits for a range of 4 m, the error is at most half of 4 / 16383 m, which the scene
    // knows.
    const double half = 2.0 / 16383;
    const SceneDescription quantized = read(by_draco(sheet, by_encoder(sheet, method, 14)).glb());
    EXPECT_NEAR(quantized.coordinate_rounding, half, 1e-6);
    EXPECT_EQ(quantized.face_count(), expected.size());
    for (const Vec3& p : quantized.points) {
      double nearest = 1;
      for (std::size_t v = 0; v < sheet.points.size(); v += 3) {
        const Vec3 q{static_cast<double>(sheet.points[v]), static_cast<double>(sheet.points[v + 1]),
                     static_cast<double>(sheet.points[v + 2])};
        nearest = std::min(nearest, max_abs(p - q));
      }
      EXPECT_LE(nearest, half + 1e-6);
    }
  }
}

TEST(GltfCompression, TwoPrimitivesShareADecodedMesh) {
  const Sheet sheet(4);
  GltfText file = by_draco(sheet, by_encoder(sheet, draco::MESH_EDGEBREAKER_ENCODING, 0));
  json primitive = file.root["meshes"][0]["primitives"][0];
  file.root["meshes"][0]["primitives"].push_back(primitive);
  EXPECT_EQ(read(file.glb()).face_count(), 2 * sheet.indices.size() / 3);
}

TEST(GltfCompression, RefusesWhatIsBroken) {
  const Sheet sheet(4);
  const GltfText meshopt = by_meshopt(sheet);
  const auto with = [&](const char* key, const json& value) {
    GltfText changed = meshopt;
    changed.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    return refusal_of(changed);
  };
  EXPECT_THAT(with("count", 400), HasSubstr("a.glb: buffer view 0: its compressed data: is "
                                            "damaged: its "));
  EXPECT_THAT(with("count", 1000000), HasSubstr("has 1000000 entries of 12 bytes in "));
  EXPECT_THAT(with("count", -1), HasSubstr("count is not a whole number of at least 0"));
  EXPECT_THAT(with("byteStride", 6), HasSubstr("cannot have 25 entries of 6 bytes in the mode"));
  EXPECT_THAT(with("mode", "SHAPES"), HasSubstr("in the mode `SHAPES`"));
  EXPECT_THAT(with("filter", "OCTAHEDRAL"), HasSubstr("cannot have the filter `OCTAHEDRAL`"));
  EXPECT_THAT(with("byteLength", 1U << 30), HasSubstr("buffer 0 has no 1073741824 bytes"));
  EXPECT_THAT(with("buffer", 9), HasSubstr("buffer 9 does not exist; there are 2"));
  const Bytes bytes = by_encoder(sheet, draco::MESH_EDGEBREAKER_ENCODING, 14);
  GltfText draco_file = by_draco(sheet, bytes);
  json& extension =
      draco_file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  extension["attributes"]["POSITION"] = 7;
  EXPECT_THAT(refusal_of(draco_file), HasSubstr("mesh 0: its compressed data: has no attribute 7"));
  extension["bufferView"] = 5;
  EXPECT_THAT(refusal_of(draco_file), HasSubstr("buffer view 5 does not exist; there are 1"));
  Bytes old = bytes;
  old[6] = 1;  // the minor version
  EXPECT_THAT(refusal_of(by_draco(sheet, old)), HasSubstr("is no mesh of version 2.2"));
  EXPECT_THAT(refusal_of(by_draco(sheet, Bytes(bytes.begin(), bytes.begin() + 4))),
              HasSubstr("is no mesh of Draco's format"));
}

// Decoders allocate as much as a few bytes request; counts are compared with the file before.
TEST(GltfCompression, CountsAreBoundedByTheInput) {
  const Sheet sheet(4);
  Bytes bytes = by_encoder(sheet, draco::MESH_SEQUENTIAL_ENCODING, 0);
  constexpr std::size_t counts = 11;  // after the header: faces and points, in bytes of 7 bits
  bytes[counts] = 0xff;
  bytes.insert(bytes.begin() + counts + 1, {0xff, 0xff, 0x7f});
  EXPECT_THAT(test::refusal([&] { (void)decode_draco(bytes, {0}, 20'000'000); }),
              HasSubstr("has more than"));
  EXPECT_THAT(test::refusal([&] {
                (void)decode_draco(by_encoder(sheet, draco::MESH_EDGEBREAKER_ENCODING, 0), {0}, 20);
              }),
              HasSubstr("has more than 20 vertices or triangles"));
}

/// Changed, cut and lengthened bytes: an error of one line, or a result, within a second.
template <class Decode>
void expect_no_harm(const Bytes& good, unsigned seed, int trials, Decode decode) {
  std::mt19937 random(seed);  // NOLINT(cert-msc51-cpp): the same bytes each time
  for (int k = 0; k < trials; ++k) {
    Bytes bytes = good;
    for (int n = static_cast<int>(random() % 6); n >= 0; --n) {
      // Half of the changes are at the beginning, where counts and methods are.
      const std::size_t range =
          random() % 2 == 0 ? std::min<std::size_t>(48, bytes.size()) : bytes.size();
      unsigned char& byte = bytes[random() % range];
      constexpr std::array<unsigned char, 5> values{0, 1, 0x7f, 0x80, 0xff};
      byte = random() % 2 == 0 ? values[random() % values.size()]
                               : static_cast<unsigned char>(byte ^ (1U << random() % 8));
    }
    if (random() % 4 == 0) {
      bytes.resize(1 + random() % (bytes.size() + 8));
    }
    const auto begin = std::chrono::steady_clock::now();
    const std::string message = test::refusal([&] { decode(bytes); });
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(time.count(), 10) << "seed " << seed << ", trial " << k;
  }
}

void decode_changed(unsigned seed, int trials) {
  const Sheet sheet(12);
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    for (const int bits : {0, 11}) {
      expect_no_harm(by_encoder(sheet, method, bits), seed, trials, [](const Bytes& bytes) {
        (void)decode_draco(bytes, {0, 1}, 20'000'000);
      });
    }
  }
  const auto decode_as = [&](const char* mode, std::size_t count, std::size_t stride) {
    return [=](const Bytes& bytes) { (void)decode_meshopt({count, stride, mode, "NONE"}, bytes); };
  };
  expect_no_harm(packed_vertices(sheet.points.data(), sheet.vertices(), 12), seed, trials,
                 decode_as("ATTRIBUTES", sheet.vertices(), 12));
  expect_no_harm(packed_indices(sheet, false), seed, trials,
                 decode_as("TRIANGLES", sheet.indices.size(), 4));
  expect_no_harm(packed_indices(sheet, true), seed, trials,
                 decode_as("INDICES", sheet.indices.size(), 2));
}

TEST(GltfCompression, ChangedBytesDoNoHarm) { decode_changed(7, 300); }
TEST(GltfCompression, NightlyManyChangedBytesDoNoHarm) {
  for (unsigned seed = 100; seed < 140; ++seed) {
    decode_changed(seed, 1000);
  }
}

}  // namespace
}  // namespace transillum::gltf_compression_test
