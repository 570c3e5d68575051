// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "gltf_test_file.h"
#include "scene/read/scene_cameras.h"
#include "support/temporary_folder.h"
#include "transillum/errors.h"

namespace transillum::gltf_cameras_test {
namespace {

using test::GltfText;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// A square, and cameras whose nodes are added to the scene.
class GltfCameras : public ::testing::Test {
 protected:
  GltfCameras() {
    file_.add(test::square_in(file_));
    file_.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", std::numbers::pi / 3}, {"znear", 1}}}},
        {{"type", "orthographic"},
         {"name", "plan"},
         {"orthographic", {{"xmag", 3}, {"ymag", 1.5}, {"znear", 0}, {"zfar", 9}}}}};
  }
  void add_node(const nlohmann::json& node) {
    file_.root["nodes"].push_back(node);
    file_.root["scenes"][0]["nodes"].push_back(file_.root["nodes"].size() - 1);
  }
  std::vector<SceneCamera> read(double scale = 1) const {
    return read_cameras(folder_.write("scene.glb", file_.glb()), scale);
  }
  void expect_refused(const std::string& text) const {
    EXPECT_THAT([&] { read(); }, ThrowsMessage<InputError>(HasSubstr(text)));
  }

  GltfText file_;
  test::TemporaryFolder folder_;
};

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_NEAR(norm(a - b), 0, 1e-12); }

TEST_F(GltfCameras, LookAlongTheirNodes) {
  add_node({{"name", "door"}, {"camera", 0}, {"translation", {1, 2, 3}}});
  // A quarter turn about y: -z becomes -x.
  add_node({{"camera", 1},
            {"translation", {0, 5, 0}},
            {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
  add_node({{"camera", 0}, {"scale", {2, 2, 2}}});
  const std::vector<SceneCamera> cameras = read(10);
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].name, "door");
  expect_near(cameras[0].eye, {10, 20, 30});
  expect_near(cameras[0].direction, {0, 0, -1});
  expect_near(cameras[0].up, {0, 1, 0});
  ASSERT_TRUE(cameras[0].field_of_view);
  EXPECT_NEAR(*cameras[0].field_of_view, 60, 1e-12);
  EXPECT_EQ(cameras[1].name, "plan");
  expect_near(cameras[1].direction, {-1, 0, 0});
  EXPECT_FALSE(cameras[1].field_of_view);
  EXPECT_NEAR(cameras[1].height, 30, 1e-12);
  EXPECT_EQ(cameras[2].name, "camera 0");
  expect_near(cameras[2].direction, {0, 0, -1});
}

TEST_F(GltfCameras, ArePlacedByTheParentsOfTheirNodes) {
  add_node({{"translation", {1, 0, 0}}, {"children", {2}}});
  file_.root["nodes"].push_back({{"camera", 0}, {"translation", {0, 1, 0}}});
  const std::vector<SceneCamera> cameras = read();
  ASSERT_EQ(cameras.size(), 1U);
  expect_near(cameras[0].eye, {1, 1, 0});
}

TEST_F(GltfCameras, AreMissingInOtherFiles) {
  EXPECT_THAT(read(), IsEmpty());
  EXPECT_THAT(read_cameras("no-such-file.obj"), IsEmpty());
}

TEST_F(GltfCameras, ThatAreImpossibleAreRefused) {
  add_node({{"name", "door"}, {"camera", 2}});
  expect_refused("scene.glb: node 1: camera 2 does not exist; there are 2");
  file_.root["nodes"].back()["camera"] = 0;
  file_.root["cameras"][0]["perspective"]["yfov"] = 4;
  expect_refused("camera \"door\": its angle yfov is 4");
  file_.root["nodes"].back()["camera"] = 1;
  file_.root["cameras"][1]["orthographic"]["ymag"] = 0;
  expect_refused("camera \"door\": its height ymag is 0");
  file_.root["cameras"][1]["orthographic"]["ymag"] = 1;
  file_.root["nodes"].back()["scale"] = {0, 0, 0};
  expect_refused("camera \"door\": its node has no direction");
}

}  // namespace
}  // namespace transillum::gltf_cameras_test
