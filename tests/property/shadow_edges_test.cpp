// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Edges of shadows in closed form, and that no patch is partly in the sun once it is divided along
// them.
#include "visibility/map/shadow_edges.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "session/divisions.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/shading.h"

namespace transillum::shadow_edges_test {
namespace {

using ::testing::HasSubstr;
using testing::Sketch;

std::vector<ShadowEdge> edges_of(const Scene& scene, const Vec3& to_light) {
  const BspTree tree(scene);
  return shadow_edges(scene, tree, record_local_map(scene, tree, -to_light).record);
}

/// A box of 2 m by 1 m and 3 m high on a plane of `divisions` by `divisions` patches.
std::shared_ptr<const Scene> box_on_a_plane(int divisions) {
  Sketch sketch("box on a plane");
  const int gray = sketch.material(0.5, 0);
  sketch.grid({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, divisions,
              [&](double, double) { return gray; });
  sketch.box({0.3, 0.4, 0}, {2.3, 1.4, 3}, false, gray);
  return sketch.scene();
}

/// The same box, each of whose sides is a grid of patches.
std::shared_ptr<const Scene> box_of_patches() {
  Sketch sketch("box of patches");
  const int gray = sketch.material(0.5, 0);
  const auto add = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    sketch.grid(corner, u, v, 3, [&](double, double) { return gray; });
  };
  sketch.face({{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}}, gray);
  const Vec3 low{0.3, 0.4, 0}, x{2, 0, 0}, y{0, 1, 0}, z{0, 0, 3};
  add(low + z, x, y);
  add(low, x, z);
  add(low + x, y, z);
  add(low + x + y, -x, z);
  add(low + y, -y, z);
  return sketch.scene();
}

/// Triangles and tetrahedra, some of which intersect, over a floor; turned by a random rotation.
std::shared_ptr<const Scene> clutter(std::uint64_t seed) {
  Sketch sketch("clutter");
  const int gray = sketch.material(0.5, 0);
  sketch.grid({-1, -1, 0}, {3, 0, 0}, {0, 3, 0}, 2, [&](double, double) { return gray; });
  sketch.triangles(6, 0.4, seed, gray).tetrahedra(6, 0.5, seed + 1, gray);
  return std::make_shared<const Scene>(
      testing::moved(sketch.description(), testing::random_rotation(seed)));
}

double area_of(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches()) {
    area += patch.area;
  }
  return area;
}

/// The largest area of a patch that is neither all in the sun nor all out of it, m².
double largest_mixed_area(const std::shared_ptr<const Scene>& scene, const Vec3& to_light) {
  double largest = 0;
  sunlit_fractions(scene, std::make_shared<const BspTree>(*scene), std::span(&to_light, 1),
                   [&](std::size_t, const std::vector<double>& fractions) {
                     for (PatchId i = 0; i < scene->patch_count(); ++i) {
                       const double lit = at(fractions, i);
                       largest = std::max(largest, std::min(lit, 1 - lit) * scene->patch(i).area);
                     }
                   });
  return largest;
}

/// The outline of the sum of the base and of the segment to the top's shadow: with a sun in the
/// first quadrant, the edges of the base and twice the segment.
TEST(ShadowEdges, OfABoxOnAPlaneAreTheOutlineOfItsShadow) {
  const Vec3 sun = normalized(Vec3{0.5, 0.7, 1});
  const double x = 3 * 0.5, y = 3 * 0.7;  // m by which the top's shadow is moved
  for (const int divisions : {1, 7}) {
    const auto scene = box_on_a_plane(divisions);
    double length = 0;
    for (const ShadowEdge& edge : edges_of(*scene, sun)) {
      ASSERT_LT(edge.patch, divisions * divisions) << "no side of the box is partly lit";
      EXPECT_NEAR(edge.a.z, 0, 1e-12);
      EXPECT_NEAR(edge.b.z, 0, 1e-12);
      length += norm(edge.b - edge.a);
    }
    EXPECT_NEAR(length, 2 * (2 + 1) + 2 * std::hypot(x, y), 1e-9);
  }
}

/// A board below a lamp: along the vertical, the floor has the outlines of both, the board none.
TEST(ShadowEdges, OfALampAreTheOutlinesOfLampAndBoard) {
  Sketch sketch("a lamp over a board");
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0, 1);
  sketch.grid({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 3, [&](double, double) { return gray; });
  sketch.box({0.1, 0.1, 1}, {0.7, 0.5, 1.1}, false, gray);
  sketch.grid({0, 0, 2}, {0, 1, 0}, {1, 0, 0}, 2, [&](double, double) { return lamp; });
  const auto scene = sketch.scene();
  std::vector<bool> emits;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    emits.push_back(max_abs(scene->material(i).exitance) > 0);
  }
  const BspTree tree(*scene);
  const auto length_along = [&](const Vec3& omega) {
    double length = 0;
    const MapRecord record = record_local_map(*scene, tree, omega).record;
    for (const ShadowEdge& edge : lamp_shadow_edges(*scene, tree, record, emits)) {
      EXPECT_EQ(scene->patch(edge.patch).center.z, 0);
      length += norm(edge.b - edge.a);
    }
    return length;
  };
  EXPECT_NEAR(length_along({0, 0, 1}), 4 * 1 + 2 * (0.6 + 0.4), 1e-9);
  EXPECT_EQ(length_along({0, 0, -1}), 0);
}

/// Neighboring patches of the box have edges on the same line, which are different lines of the
/// tree.
TEST(ShadowEdges, OfABoxOfPatchesAreTheSame) {
  const auto scene = box_of_patches();
  for (const Vec3& direction : {Vec3{0.5, 0.7, 1}, Vec3{-0.31, 0.17, 0.6}, Vec3{0.5, 0, 1}}) {
    const Vec3 sun = normalized(direction);
    double length = 0;
    for (const ShadowEdge& edge : edges_of(*scene, sun)) {
      EXPECT_EQ(edge.patch, 0) << "no side of the box is partly lit";
      length += norm(edge.b - edge.a);
    }
    const double x = 3 * direction.x / direction.z, y = 3 * direction.y / direction.z;
    EXPECT_NEAR(length, 2 * (2 + 1) + 2 * std::hypot(x, y), 1e-9);
  }
}

/// One half of the lamp has an edge, the other has it in two parts.
TEST(ShadowEdges, OfALampWithAHangingNodeAreItsOutline) {
  Sketch sketch("lamp of three");
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0, 1);
  sketch.face({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, gray);
  sketch.face({{0, 0, 2}, {0, 1, 2}, {0.5, 1, 2}, {0.5, 0, 2}}, lamp);
  sketch.face({{0.5, 0, 2}, {0.5, 0.3, 2}, {1, 0.3, 2}, {1, 0, 2}}, lamp);
  sketch.face({{0.5, 0.3, 2}, {0.5, 1, 2}, {1, 1, 2}, {1, 0.3, 2}}, lamp);
  const auto scene = sketch.scene();
  const BspTree tree(*scene);
  double length = 0;
  for (const Vec3& omega : {Vec3{0, 0, 1}, normalized(Vec3{0.2, -0.1, 1})}) {
    length = 0;
    for (const ShadowEdge& edge :
         lamp_shadow_edges(*scene, tree, record_local_map(*scene, tree, omega).record,
                           {false, true, true, true})) {
      length += norm(edge.b - edge.a);
    }
    EXPECT_NEAR(length, 4, 1e-9);
  }
}

TEST(ShadowEdges, AreNoneWithoutShadows) {
  Sketch sketch("a floor");
  const int gray = sketch.material(0.5, 0);
  sketch.grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, [&](double, double) { return gray; });
  EXPECT_TRUE(edges_of(*sketch.scene(), {0, 0, 1}).empty());
  EXPECT_TRUE(edges_of(*sketch.scene(), {0, 0, -1}).empty());
}

TEST(ShadowEdges, PatchesDividedAlongThemAreInTheSunOrNot) {
  const Vec3 afternoon = normalized(Vec3{0.5, 0.7, 1});
  struct Lit {
    std::shared_ptr<const Scene> scene;
    Vec3 sun;
  };
  std::vector<Lit> cases{{box_on_a_plane(1), afternoon}, {box_on_a_plane(5), afternoon}};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    cases.push_back({clutter(seed), testing::random_rotation(seed)(afternoon)});
  }
  for (const auto& [scene, sun] : cases) {
    const auto divided = divided_scene(scene, {division_by_shadows(sun)});
    EXPECT_GT(largest_mixed_area(scene, sun), 1e-3);
    EXPECT_LT(largest_mixed_area(divided, sun), 1e-9) << scene->name();
    EXPECT_NEAR(area_of(*divided), area_of(*scene), 1e-12 * area_of(*scene));
  }
}

/// A frame is concave; only the shadow's part on it divides it, and no other point is added.
TEST(ShadowEdges, DivideConcavePatchesAndAddNoUnusedPoints) {
  Sketch sketch("an L below a sheet");
  const int gray = sketch.material(0.5, 0);
  sketch.face({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}}, gray);
  sketch.face({{2, 0.2, 1}, {3, 0.2, 1}, {3, 3, 1}, {2, 3, 1}}, gray);
  const auto scene = sketch.scene();
  const Vec3 sun{0, 0, 1};
  const auto divided = divided_scene(scene, {"patch:1", division_by_shadows(sun)});
  EXPECT_LT(largest_mixed_area(divided, sun), 1e-12);
  EXPECT_NEAR(area_of(*divided), area_of(*scene), 1e-12);
  std::vector<bool> used(divided->points().size(), false);
  for (PatchId i = 0; i < divided->patch_count(); ++i) {
    for (const PointId p : divided->outline(i)) {
      used[static_cast<std::size_t>(p)] = true;
    }
  }
  EXPECT_THAT(used, ::testing::Each(true));
}

TEST(ShadowEdges, BothSidesOfASheetAreDividedAlike) {
  Sketch sketch("a sheet below another");
  const int gray = sketch.material(0.5, 0);
  sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, gray);
  sketch.face({{0.5, 0.5, 1}, {1, 0.5, 1}, {1, 1.5, 1}, {0.5, 1.5, 1}}, gray);
  const auto scene = sketch.scene({.two_sided = true});
  ASSERT_EQ(scene->patch_count(), 4);
  const auto divided = divided_scene(scene, {"shadows:0,0,1"});
  EXPECT_EQ(divided->patch_count(), 2 * 5 + 2);
  for (PatchId i = 0; i < 10; i += 2) {
    EXPECT_EQ(divided->patch(i).center, divided->patch(i + 1).center);
    EXPECT_EQ(divided->patch(i).normal, -divided->patch(i + 1).normal);
  }
}

TEST(ShadowEdges, ADirectionThatIsNoneIsRefused) {
  const auto scene = box_on_a_plane(1);
  for (const char* name : {"shadows:", "shadows:1,2", "shadows:1,2,3,4", "shadows:0,0,0",
                           "shadows:nan,0,1", "shadows:1,2,x", "shadows:1e999,0,1"}) {
    EXPECT_THAT(test::refusal([&] { divided_scene(scene, {name}); }), HasSubstr("shadows:1,0,2"))
        << name;
  }
}

}  // namespace
}  // namespace transillum::shadow_edges_test
