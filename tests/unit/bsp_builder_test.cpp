// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Building the BSP tree: convex surfaces without cuts, any number of threads, progress, and the
// search for planes that cut nothing.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/bsp_tree.h"
#include "visibility/bsp/clean_planes.h"
#include "visibility/bsp/disk_tree.h"

namespace transillum::bsp_builder_test {
namespace {

using testing::Sketch;

/// The triangles of a sphere in `rings` rings, 4 · rings · (rings - 1) of them.
Sketch& add_sphere(Sketch& sketch, int rings, const Vec3& center, bool inward, int material) {
  const auto point = [&](int ring, int k) {
    const double theta = std::numbers::pi * ring / rings, phi = std::numbers::pi * k / rings;
    // Each pole is one point.
    const double r = ring == 0 || ring == rings ? 0.0 : std::sin(theta);
    return center + Vec3{r * std::cos(phi), r * std::sin(phi), std::cos(theta)};
  };
  const auto face = [&](Vec3 a, Vec3 b, Vec3 c) {
    sketch.face(inward ? std::vector<Vec3>{c, b, a} : std::vector<Vec3>{a, b, c}, material);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < 2 * rings; ++k) {
      const int next = (k + 1) % (2 * rings);
      if (ring > 0) {
        face(point(ring, k), point(ring + 1, k), point(ring, next));
      }
      if (ring + 1 < rings) {
        face(point(ring, next), point(ring + 1, k), point(ring + 1, next));
      }
    }
  }
  return sketch;
}

std::shared_ptr<const Scene> sphere(int rings, bool inward) {
  Sketch sketch;
  add_sphere(sketch, rings, {0.1, 0.2, 0.3}, inward, sketch.material(0.5, 1));
  return sketch.scene();
}

/// The pieces of a scene and their planes, as the builder starts with them.
struct Pieces {
  PolygonSet set;
  std::vector<BspTree::Plane> planes;

  explicit Pieces(const Scene& scene) {
    for (const Piece& piece : scene.pieces()) {
      const auto begin = static_cast<std::uint32_t>(set.places.size());
      for (const PointId p : scene.corners(piece)) {
        set.corners.push_back({p, 0, true});
        set.places.push_back(scene.point(p));
      }
      set.polygons.push_back({piece.patch, static_cast<std::int32_t>(planes.size()), begin,
                              static_cast<std::uint32_t>(set.places.size())});
      const Vec3 normal = scene.patch(piece.patch).normal;
      planes.push_back({normal, dot(normal, set.places[begin])});
    }
  }
};

/// The whole content of a tree as numbers.
std::vector<double> numbers_of(const BspTree& tree) {
  std::vector<double> numbers{static_cast<double>(tree.depth())};
  const auto add = [&](auto... values) { (numbers.push_back(static_cast<double>(values)), ...); };
  for (const auto& n : tree.nodes()) {
    add(n.plane.normal.x, n.plane.normal.y, n.plane.normal.z, n.plane.offset, n.front, n.back,
        n.begin, n.middle, n.end);
  }
  for (const auto& f : tree.fragments()) {
    add(f.patch, f.begin, f.end);
    for (const auto& c : tree.corners(f)) {
      add(c.point, c.line, c.forward);
    }
  }
  for (const auto& p : tree.points()) {
    add(p.x, p.y, p.z);
  }
  for (const auto& l : tree.lines()) {
    add(l.a, l.b);
  }
  for (const auto& c : tree.cut_points()) {
    add(c.a, c.b, c.t);
  }
  return numbers;
}

TEST(BspBuilder, CutsNoConvexSurface) {
  for (const int rings : {5, 30, 60}) {
    for (const bool inward : {false, true}) {
      const auto scene = sphere(rings, inward);
      const BspTree tree(*scene);
      EXPECT_EQ(tree.fragments().size(), scene->pieces().size()) << rings << inward;
      EXPECT_EQ(tree.cut_points().size(), 0U);
      EXPECT_LE(tree.nodes().size(), scene->pieces().size());
    }
  }
}

/// Planes through patches of 1 cm would miss the end of a strip of 100 m by the rounding of
/// corners.
TEST(BspBuilder, PutsAllPatchesOfAFaceInItsPlane) {
  const Vec3 along = normalized({3, -2, 1}), across = normalized(cross(along, {1, 5, 2}));
  for (const double height : {0.0, 2.7, 31.1}) {
    const Vec3 start{0.3, -0.7, height}, end = start + 100 * along, width = 0.1 * across;
    Sketch sketch;
    sketch.face({start, end, end + width, start + width}, sketch.material(0.5, 1));
    const auto scene = sketch.scene({.max_patch_area = 1.01e-4});
    const BspTree tree(*scene);
    EXPECT_GE(scene->patch_count(), 99'000);
    ASSERT_EQ(tree.nodes().size(), 1U) << height;
    const BspTree::Plane& plane = tree.nodes()[0].plane;
    const double rounding = BspTree::thickness(*scene) / 16;
    for (const Vec3& p : scene->points()) {
      ASSERT_LE(std::abs(dot(plane.normal, p) - plane.offset), rounding);
    }
    EXPECT_EQ(tree.fragments().size(), scene->pieces().size());
  }
}

TEST(BspBuilder, MakesTheSameTreeForAnyNumberOfThreads) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  for (int k = 0; k < 3; ++k) {
    add_sphere(sketch, 20, {1.5 * k, 0, 0}, false, gray);
  }
  sketch.triangles(2500, 0.3, 4, gray).box({-3, -3, -3}, {7, 4, 3}, true, gray);
  const auto scene = sketch.scene();
  const std::vector<double> expected = numbers_of(BspTree(*scene, {}, {}, 1));
  for (const int threads : {2, 3, 0}) {
    EXPECT_EQ(numbers_of(BspTree(*scene, {}, {}, threads)), expected) << threads;
  }
}

TEST(BspBuilder, ReportsProgressOnItsThread) {
  const auto scene = load_scene("sphere-flake:levels=3");
  std::vector<double> fractions;
  const BspTree tree(
      *scene, {},
      [&, thread = std::this_thread::get_id()](double fraction) {
        EXPECT_EQ(std::this_thread::get_id(), thread);
        fractions.push_back(fraction);
      },
      2);
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
}

TEST(BspBuilder, IsCanceledWhileThreadsBuild) {
  const auto scene = load_scene("sphere-flake:levels=3");
  const Cancellation cancellation;
  EXPECT_THROW(BspTree(
                   *scene, cancellation, [&](double) { cancellation.cancel(); }, 3),
               Canceled);
}

/// The planes of a convex surface meet few of its polygons each, however many there are: a chain
/// of nodes for it takes near-linear time.
TEST(DiskTree, VisitsFewPolygonsOfARoundSurface) {
  for (const int rings : {20, 80}) {
    const Pieces pieces(*sphere(rings, false));
    const DiskTree tree(pieces.set, pieces.planes, [] {});
    std::size_t visits = 0;
    for (const BspTree::Plane& plane : pieces.planes) {
      tree.for_each_reaching(plane.normal, plane.offset - 1e-12, [&](std::int32_t) {
        ++visits;
        return true;
      });
    }
    EXPECT_LE(visits, 100 * pieces.planes.size()) << rings;
  }
}

TEST(DiskTree, FindsAllPolygonsThatReachAPlane) {
  Sketch sketch;
  const auto scene = sketch.triangles(300, 0.4, 7, sketch.material(0.5, 1)).scene();
  const Pieces pieces(*scene);
  const DiskTree tree(pieces.set, pieces.planes, [] {});
  for (const Vec3& normal : testing::test_directions(40, 3)) {
    for (const double offset : {-0.5, 0.0, 0.3, 0.9}) {
      std::vector<char> found(pieces.set.size(), 0);
      tree.for_each_reaching(normal, offset, [&](std::int32_t p) {
        at(found, p) = 1;
        return true;
      });
      for (std::size_t p = 0; p < found.size(); ++p) {
        if (pieces.set.extent(pieces.set.polygons[p], {normal, offset}).high >= 0) {
          EXPECT_EQ(found[p], 1);
        }
      }
    }
  }
}

TEST(CleanPlanes, AgreeInSmallAndLargeSets) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.triangles(60, 0.2, 5, gray).box({-1, -1, -1}, {2, 2, 2}, true, gray);
  add_sphere(sketch, 4, {0.5, 0.5, 3.2}, false, gray);
  const Pieces pieces(*sketch.scene());
  CleanPlanes search(pieces.planes, 1e-13, [] {});
  const auto one_sided = [&](const std::vector<CleanPlanes::Plane>& planes) {
    std::vector<std::int32_t> polygons;
    for (const CleanPlanes::Plane& plane : planes) {
      if (plane.one_sided()) {
        polygons.push_back(plane.polygon);
        for (std::uint32_t k = plane.begin; k < plane.end; ++k) {
          polygons.push_back(search.in_plane()[k]);
        }
      }
    }
    return polygons;
  };
  const std::vector<std::int32_t> all = one_sided(search.find_all(pieces.set));
  EXPECT_GE(all.size(), 6U);
  EXPECT_THAT(one_sided(search.find_one_sided(pieces.set)),
              ::testing::UnorderedElementsAreArray(all));
}

}  // namespace
}  // namespace transillum::bsp_builder_test
