// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A room with its radiosity as glTF, shown by three.js in a real browser: every patch has the color
// of its radiosity, pixel by pixel. The test runs nightly, and only where Chromium is installed and
// TRANSILLUM_THREE is the folder of the npm package three (`npm install three` makes
// node_modules/three). TRANSILLUM_PICTURES: a folder for the picture of the room.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/srgb.h"
#include "support/program_call.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "transillum/solution.h"
#include "transillum/solve_session.h"

namespace transillum::testing::browser_test {
namespace {

using nlohmann::json;

constexpr const char* page = R"(<!doctype html><title>loading</title><body style="margin:0">
<script type="importmap">{"imports": {"three": "file://THREE/build/three.module.js",
  "three/addons/": "file://THREE/examples/jsm/"}}</script>
<script type="module">
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
const bytes = Uint8Array.from(atob("GLB"), c => c.charCodeAt(0));
const probes = PROBES;
const renderer = new THREE.WebGLRenderer({preserveDrawingBuffer: true});
document.body.appendChild(renderer.domElement);
const vector = v => new THREE.Vector3(v[0], v[1], v[2]);
// The pixel in the middle of a picture from right above the point.
function color(scene, probe) {
  const d = probe.distance, n = vector(probe.normal), gl = renderer.getContext();
  const camera = new THREE.OrthographicCamera(-d, d, d, -d, 0, 2 * d);
  camera.position.copy(vector(probe.point)).addScaledVector(n, d);
  camera.up.set(n.y, n.z, n.x);
  camera.lookAt(vector(probe.point));
  renderer.render(scene, camera);
  const pixel = new Uint8Array(4);
  gl.readPixels(4, 4, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return [...pixel.slice(0, 3)];
}
try {
  const gltf = await new GLTFLoader().parseAsync(bytes.buffer, '');
  const scene = new THREE.Scene();
  scene.add(gltf.scene);
  renderer.setSize(9, 9);
  const colors = probes.map(probe => color(scene, probe));
  const box = new THREE.Box3().setFromObject(gltf.scene);
  const center = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
  const camera = new THREE.PerspectiveCamera(38, 9 / 7, 0.01 * size.z, 10 * size.z);
  camera.position.set(center.x, center.y, box.min.z - 1.4 * size.z);
  camera.lookAt(center);
  renderer.setSize(900, 700);
  renderer.render(scene, camera);
  document.title = JSON.stringify(colors);
} catch (error) {
  document.title = 'failed: ' + error;
}
</script>)";

std::string base64(const std::string& bytes) {
  constexpr const char* letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::array<unsigned, 3> three{};
    for (std::size_t c = 0; c < 3 && k + c < bytes.size(); ++c) {
      three[c] = static_cast<unsigned char>(bytes[k + c]);
    }
    const unsigned bits = three[0] << 16 | three[1] << 8 | three[2];
    for (unsigned c = 0; c < 4; ++c) {
      text += k + c > bytes.size() ? '=' : letters[bits >> (18 - 6 * c) & 63];
    }
  }
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* three = std::getenv("TRANSILLUM_THREE");
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      const std::string found = std::string("command -v ") + name + " > /dev/null";
      // NOLINTNEXTLINE(concurrency-mt-unsafe,cert-env33-c): one thread, a fixed command
      if (program_.empty() && std::system(found.c_str()) == 0) {
        program_ = name;
      }
    }
    if (three == nullptr || program_.empty()) {
      GTEST_SKIP() << "needs Chromium, and TRANSILLUM_THREE, the folder of the npm package three";
    }
    three_ = three;
  }

  /// A place above each patch that nothing covers, and the color that must be there.
  json probes() const {
    const Scene& scene = *solution_.scene;
    json list = json::array();
    PatchId last = no_patch;
    for (const Piece& piece : scene.pieces()) {
      if (piece.patch == last) {
        continue;
      }
      last = piece.patch;
      Vec3 middle;
      const auto corners = scene.corners(piece);
      for (const PointId corner : corners) {
        middle = middle + (1.0 / static_cast<double>(corners.size())) * scene.point(corner);
      }
      const Vec3 n = scene.patch(piece.patch).normal;
      list.push_back({{"point", {middle.x, middle.y, middle.z}},
                      {"normal", {n.x, n.y, n.z}},
                      {"distance", 1e-3 * std::sqrt(scene.patch(piece.patch).area)}});
    }
    return list;
  }

  void run(const std::string& options, const std::string& out) const {
    const std::string command =
        "timeout 120 " + program_ +
        " --headless --no-sandbox --allow-file-access-from-files --use-gl=angle"
        " --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=900,700"
        " --virtual-time-budget=60000 --user-data-dir='" +
        (folder_ / "profile") + "' " + options + " 'file://" + (folder_ / "page.html") + "' > '" +
        out + "' 2> /dev/null";
    // NOLINTNEXTLINE(concurrency-mt-unsafe,cert-env33-c): one thread, a fixed command
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  void expect_colors(bool light_map) {
    write_result(folder_ / "room.glb", solution_, {.light_map = light_map});
    std::string text = replaced(page, "THREE/", three_ + "/");
    text = replaced(text, "GLB", base64(read_file(folder_ / "room.glb")));
    const json places = probes();
    write_text(folder_ / "page.html", replaced(text, "PROBES", places.dump()));
    run("--dump-dom", folder_ / "dom.html");
    const std::string dom = read_file(folder_ / "dom.html");
    const std::size_t begin = dom.find("<title>") + 7;
    const std::string title = dom.substr(begin, dom.find("</title>") - begin);
    ASSERT_TRUE(title.starts_with("[[")) << title.substr(0, 300);
    const json colors = json::parse(title);
    const double exposure = automatic_exposure(solution_);
    ASSERT_EQ(colors.size(), solution_.radiosity.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const Rgb color = exposure * solution_.radiosity[i];
      const std::array<int, 3> expected{srgb_byte(color.r), srgb_byte(color.g), srgb_byte(color.b)};
      for (std::size_t c = 0; c < 3; ++c) {
        // The browser computes the transfer function in single precision.
        EXPECT_NEAR(colors[i][c].get<int>(), expected[c], 1) << "patch " << i << " channel " << c;
      }
    }
    if (const char* pictures = std::getenv("TRANSILLUM_PICTURES")) {
      run("--screenshot='" + std::string(pictures) +
              (light_map ? "/browser-light-map.png'" : "/browser-colors.png'"),
          "/dev/null");
    }
  }

  TemporaryFolder folder_;
  std::string program_, three_;
  Solution solution_ =
      solve(load_scene("cornell-box", {.max_patch_area = 0.005}), {.directions = 64});
};

TEST_F(Browser, NightlyShowsTheColorsOfAGltfRoom) { expect_colors(false); }

TEST_F(Browser, NightlyShowsTheLightMapOfAGltfRoom) { expect_colors(true); }

}  // namespace
}  // namespace transillum::testing::browser_test
