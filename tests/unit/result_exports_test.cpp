// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Radiosity for other programs: colors and triangles of glTF files, colors of PLY files, series for
// ParaView.
#include <gmock/gmock.h>
#include <png.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "io/srgb.h"
#include "support/program_call.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "transillum/solve_session.h"

namespace transillum::testing::result_exports_test {
namespace {

using nlohmann::json;
using test::refusal;
using ::testing::HasSubstr;

/// A binary glTF file: its document and buffer.
struct Glb {
  json document;
  std::string buffer;

  explicit Glb(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, sizeof value);
      return std::size_t{value};
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), bytes.size());
    const std::size_t length = word(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    document = json::parse(bytes.substr(20, length));
    EXPECT_EQ(length % 4, 0U);
    EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
    buffer = bytes.substr(28 + length);
    EXPECT_EQ(buffer.size(), word(20 + length));
    EXPECT_EQ(document["buffers"][0]["byteLength"], buffer.size());
  }
  /// Entry `index` of an accessor with `components` numbers each.
  template <class Number>
  std::vector<Number> values(const json& accessor) const {
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<Number> list(view["byteLength"].get<std::size_t>() / sizeof(Number));
    std::memcpy(list.data(), buffer.data() + view["byteOffset"].get<std::size_t>(),
                list.size() * sizeof(Number));
    const std::size_t components = accessor["type"] == "SCALAR" ? 1
                                   : accessor["type"] == "VEC2" ? 2
                                                                : 3;
    EXPECT_EQ(list.size(), components * accessor["count"].get<std::size_t>());
    return list;
  }
};

/// The triangles with colors that a viewer shows.
struct Shown {
  Vec3 corner[3];
  Rgb color;

  double area() const { return norm(cross(corner[1] - corner[0], corner[2] - corner[0])) / 2; }
  Vec3 normal() const { return normalized(cross(corner[1] - corner[0], corner[2] - corner[0])); }
};

std::vector<Shown> shown_by(const Glb& glb) {
  std::vector<Shown> list;
  for (const json& node : glb.document["nodes"]) {
    if (!node.contains("mesh")) {
      continue;
    }
    const Vec3 origin{node["translation"][0], node["translation"][1], node["translation"][2]};
    const json& part = glb.document["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    const auto accessor = [&](const json& index) {
      return glb.document["accessors"][index.get<std::size_t>()];
    };
    const auto positions = glb.values<float>(accessor(part["attributes"]["POSITION"]));
    const auto colors = glb.values<float>(accessor(part["attributes"]["COLOR_0"]));
    const auto indices = glb.values<std::uint32_t>(accessor(part["indices"]));
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      Shown shown;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t p = 3 * std::size_t{indices[k + c]};
        shown.corner[c] = origin + Vec3{positions.at(p), positions.at(p + 1), positions.at(p + 2)};
        shown.color = {colors.at(p), colors.at(p + 1), colors.at(p + 2)};
      }
      list.push_back(shown);
    }
  }
  return list;
}

/// The picture of a light map.
class Picture {
 public:
  explicit Picture(const Glb& glb) {
    const json& of_image =
        glb.document["bufferViews"][glb.document["images"][0]["bufferView"].get<std::size_t>()];
    const std::size_t begin = of_image["byteOffset"], length = of_image["byteLength"];
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, glb.buffer.data() + begin, length), 0);
    image.format = PNG_FORMAT_RGB;
    width = image.width;
    height = image.height;
    bytes_.resize(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, bytes_.data(), 0, nullptr), 0);
  }
  std::array<int, 3> texel(std::size_t x, std::size_t y) const {
    const std::size_t first = 3 * (y * width + x);
    return {bytes_.at(first), bytes_.at(first + 1), bytes_.at(first + 2)};
  }

  std::size_t width = 0, height = 0;

 private:
  std::vector<unsigned char> bytes_;
};

class ResultExports : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return folder_ / name; }
  Glb exported(const DisplayOptions& display = {}) const {
    write_result(path("r.glb"), solution_, display);
    return Glb(read_file(path("r.glb")));
  }

  TemporaryFolder folder_;
  Solution solution_ = solve(load_scene("cornell-box"), {.directions = 32});
};

TEST_F(ResultExports, TrianglesHaveTheAreaAndLightOfThePatches) {
  const double exposure = 1e-3;  // nothing is white
  const Glb glb = exported({.exposure = exposure});
  double area = 0, expected_area = 0;
  Rgb power, expected_power;
  for (const Shown& shown : shown_by(glb)) {
    area += shown.area();
    power += shown.area() * shown.color;
  }
  for (PatchId i = 0; i < solution_.scene->patch_count(); ++i) {
    expected_area += solution_.scene->patch(i).area;
    expected_power += (solution_.scene->patch(i).area * exposure) * at(solution_.radiosity, i);
  }
  EXPECT_NEAR(area, expected_area, 1e-5 * expected_area);
  EXPECT_LE(max_abs(power - expected_power), 1e-5 * max_abs(expected_power));
  EXPECT_NEAR(glb.document["scenes"][0]["extras"]["exposure"], exposure, 1e-15);
}

TEST_F(ResultExports, TrianglesFaceAsThePatches) {
  const auto shown = shown_by(exported());
  std::size_t k = 0;
  for (const Piece& piece : solution_.scene->pieces()) {
    for (std::size_t c = 2; c < solution_.scene->corners(piece).size(); ++c) {
      EXPECT_GT(dot(shown.at(k++).normal(), solution_.scene->patch(piece.patch).normal), 0.999);
    }
  }
  EXPECT_EQ(k, shown.size());
}

TEST_F(ResultExports, TheDocumentIsUnlitGltf) {
  const json document = exported().document;
  EXPECT_EQ(document["asset"]["version"], "2.0");
  EXPECT_EQ(document["extensionsUsed"], json::array({"KHR_materials_unlit"}));
  EXPECT_TRUE(document["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  for (const json& accessor : document["accessors"]) {
    EXPECT_EQ(document["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"]
                      .get<std::size_t>() %
                  4,
              0U);
  }
  write_result(path("r.gltf"), solution_);
  json text = json::parse(read_file(path("r.gltf")));
  EXPECT_THAT(text["buffers"][0]["uri"].get<std::string>(),
              ::testing::StartsWith("data:application/octet-stream;base64,"));
  text["buffers"][0].erase("uri");
  EXPECT_EQ(text, document);
}

/// All texels that linear filtering reads, also in the first reduction, have the patch's color.
TEST_F(ResultExports, LightMapsShowThePatchesWithoutBleeding) {
  const double exposure = automatic_exposure(solution_);
  const Glb glb = exported({.light_map = true});
  EXPECT_EQ(glb.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  const Picture picture(glb);
  const json& part = glb.document["meshes"][0]["primitives"][0];
  EXPECT_FALSE(part["attributes"].contains("COLOR_0"));
  const auto uv = glb.values<float>(
      glb.document["accessors"][part["attributes"]["TEXCOORD_0"].get<std::size_t>()]);
  std::size_t corner = 0;
  for (const Piece& piece : solution_.scene->pieces()) {
    const Rgb color = exposure * at(solution_.radiosity, piece.patch);
    const std::array<int, 3> expected{srgb_byte(color.r), srgb_byte(color.g), srgb_byte(color.b)};
    for (std::size_t k = 0; k < solution_.scene->corners(piece).size(); ++k, ++corner) {
      const double x = uv.at(2 * corner) * static_cast<double>(picture.width);
      const double y = uv.at(2 * corner + 1) * static_cast<double>(picture.height);
      for (const double dx : {-1 + 1e-3, 1 - 1e-3}) {
        for (const double dy : {-1 + 1e-3, 1 - 1e-3}) {
          EXPECT_EQ(
              picture.texel(static_cast<std::size_t>(x + dx), static_cast<std::size_t>(y + dy)),
              expected)
              << piece.patch;
        }
      }
    }
  }
  EXPECT_EQ(2 * corner, uv.size());
}

/// The corners of a patch have distinct coordinates with the same orientation, and the coordinates
/// of different patches do not overlap.
TEST_F(ResultExports, LightMapsHaveCoordinatesOfTheirOwn) {
  solution_ = solve(load_scene("cornell-box", {.max_patch_area = 0.02}), {.directions = 8});
  const Glb glb = exported({.light_map = true});
  const json& part = glb.document["meshes"][0]["primitives"][0];
  const auto accessor = [&](const json& index) {
    return glb.document["accessors"][index.get<std::size_t>()];
  };
  const auto uv = glb.values<float>(accessor(part["attributes"]["TEXCOORD_0"]));
  const auto indices = glb.values<std::uint32_t>(accessor(part["indices"]));
  double area = 0;
  for (std::size_t k = 0; k < indices.size(); k += 3) {
    const auto point = [&](std::size_t c) {
      return Vec3{uv.at(2 * std::size_t{indices[k + c]}),
                  1 - uv.at(2 * std::size_t{indices[k + c]} + 1), 0};
    };
    const double twice = cross(point(1) - point(0), point(2) - point(0)).z;
    EXPECT_GT(twice, 0) << k;
    area += twice / 2;
  }
  const Picture picture(glb);
  const double square = 4.0 / static_cast<double>(picture.width * picture.height);  // 2 by 2 texels
  EXPECT_LE(area, square * solution_.scene->patch_count() * (1 + 1e-3));
  EXPECT_GE(area, 0.5 * square * solution_.scene->patch_count() * (1 - 1e-3));
}

TEST_F(ResultExports, GroupsAreNodes) {
  SceneDescription description = describe_scene("boards");
  description.groups = {"left", "right"};
  description.face_group.assign(description.face_count(), 1);
  description.face_group.front() = 0;
  solution_ = solve(std::make_shared<const Scene>(description), {.directions = 8});
  const json nodes = exported().document["nodes"];
  ASSERT_EQ(nodes.size(), 3U);
  EXPECT_EQ(nodes[0]["children"], json::array({1, 2}));
  EXPECT_EQ(nodes[1]["name"], "left");
  EXPECT_EQ(nodes[2]["name"], "right");
}

/// Colors are at most white, and the exposure that is chosen leaves 98 % of the area below it.
TEST_F(ResultExports, TheExposureIsChosenOrGiven) {
  double white = 0, area = 0;
  for (PatchId i = 0; i < solution_.scene->patch_count(); ++i) {
    if (max_abs(solution_.scene->exitance(i)) == 0) {
      const double of_patch = solution_.scene->patch(i).area;
      area += of_patch;
      white += automatic_exposure(solution_) * max_abs(at(solution_.radiosity, i)) > 1 + 1e-12
                   ? of_patch
                   : 0;
    }
  }
  EXPECT_GT(area, 0);
  EXPECT_LE(white, 0.02 * area);
  double largest = 0;
  for (const Shown& shown : shown_by(exported({.exposure = 1e6}))) {
    largest = std::max(largest, max_abs(shown.color));
  }
  EXPECT_EQ(largest, 1);
  for (Rgb& b : solution_.radiosity) {
    b = {};
  }
  EXPECT_EQ(automatic_exposure(solution_), 1);
  EXPECT_THAT(refusal([&] { exported({.exposure = 0}); }), HasSubstr("exposure: 0"));
  EXPECT_THAT(refusal([&] { exported({.up = Vec3{0, 0, 2}}); }), HasSubstr("up: the vector"));
}

TEST_F(ResultExports, UpIsTurnedToY) {
  for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0.6, 0, -0.8}}) {
    const json q = exported({.up = up}).document["nodes"][0]["rotation"];
    const Vec3 axis{q[0], q[1], q[2]};
    const double w = q[3];
    // Rotation by a quaternion: v + 2 w (a x v) + 2 a x (a x v).
    const Vec3 turned = up + 2 * w * cross(axis, up) + 2 * cross(axis, cross(axis, up));
    EXPECT_LE(norm(turned - Vec3{0, 1, 0}), 1e-12);
  }
}

TEST_F(ResultExports, PlyHasTheColorsAsSrgb) {
  Sketch sketch("gray");
  sketch.face({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, sketch.material(0.5, 1));
  solution_ = {};
  solution_.scene = sketch.scene();
  solution_.radiosity = {{0.5, 1, 0.001}};
  solution_.irradiance = {{}};
  write_result(path("r.ply"), solution_, {.exposure = 1});
  EXPECT_THAT(read_file(path("r.ply")), HasSubstr("property uchar red"));
  EXPECT_THAT(read_file(path("r.ply")), HasSubstr("\n0 0 0 188 255 3\n"));
}

TEST_F(ResultExports, ASeriesListsItsFiles) {
  ResultSeries series(path("s.pvd"));
  series.add(solution_, 1);
  series.add(solution_, 2);
  const std::string text = read_file(path("s.pvd"));
  EXPECT_THAT(text, HasSubstr("timestep=\"1\" part=\"0\" file=\"s-0001.vtp\""));
  EXPECT_THAT(text, HasSubstr("timestep=\"2\" part=\"0\" file=\"s-0002.vtp\""));
  EXPECT_EQ(read_result(path("s-0002.vtp")).radiosity, solution_.radiosity);
  EXPECT_THAT(refusal([&] { ResultSeries wrong(path("s.vtp")); }), HasSubstr("must end in .pvd"));
}

TEST(CliExports, WritesColorsAndSeries) {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"solve", "cornell-box", "-m", "16", "-q"});
    return run_program(arguments, {}, {}, folder.path().string());
  };
  ASSERT_EQ(run({"--iterations", "3", "--series", "s.pvd", "--out", "r.glb", "--out", "r.ply",
                 "--exposure", "0.5", "--up", "0,0,1"})
                .status,
            0);
  EXPECT_THAT(folder.names(), ::testing::ElementsAre("r.glb", "r.ply", "s-0001.vtp", "s-0002.vtp",
                                                     "s-0003.vtp", "s.pvd"));
  EXPECT_EQ(read_result(folder / "s-0002.vtp").statistics.iterations, 2);
  // The series does not change the result.
  ASSERT_EQ(run({"--iterations", "3", "--out", "whole.vtp"}).status, 0);
  EXPECT_EQ(read_result(folder / "whole.vtp").radiosity,
            read_result(folder / "s-0003.vtp").radiosity);
  const auto refused = [&](const std::vector<std::string>& arguments) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(line_count(result.err), 1U);
    return result.err;
  };
  EXPECT_THAT(refused({"--exposure", "1"}), HasSubstr("used only with a .ply"));
  EXPECT_THAT(refused({"--exposure", "0", "--out", "r.ply"}), HasSubstr("not greater than 0"));
  EXPECT_THAT(refused({"--up", "0,0,1"}), HasSubstr("--up"));
  EXPECT_THAT(refused({"--series", "s.vtp"}), HasSubstr("must end in .pvd"));
  EXPECT_THAT(refused({"--series-every", "2"}), HasSubstr("used only with --series"));
  EXPECT_THAT(refused({"--series", "s.pvd", "--series-every", "0"}), HasSubstr("--series-every"));
  EXPECT_THAT(refused({"--light-map", "--out", "r.ply"}), HasSubstr("used only with a .glb"));
}

/// The estimate after every five of sixteen directions, and after each of two iterations.
TEST(CliExports, WritesASeriesOverDirections) {
  const TemporaryFolder folder;
  const auto run = [&](const std::vector<std::string>& arguments) {
    return run_program(arguments, {}, {}, folder.path().string()).status;
  };
  ASSERT_EQ(run({"solve", "cornell-box", "-m", "16", "-q", "--scheme", "semi-iterative",
                 "--iterations", "2", "--burn-in", "0", "--series", "s.pvd", "--series-every", "5",
                 "--out", "whole.vtp"}),
            0);
  const std::string list = read_file(folder / "s.pvd");
  for (const char* time : {"0.3125", "0.625", "0.9375", "1", "1.3125", "1.625", "1.9375", "2"}) {
    EXPECT_THAT(list, HasSubstr("timestep=\"" + std::string(time) + "\""));
  }
  EXPECT_EQ(folder.names().size(), 10U);
  EXPECT_EQ(read_result(folder / "s-0008.vtp").radiosity,
            read_result(folder / "whole.vtp").radiosity);
  EXPECT_FALSE(read_result(folder / "s-0002.vtp").complete);
}

}  // namespace
}  // namespace transillum::testing::result_exports_test
