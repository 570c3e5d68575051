// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Joining faces of one plane: which faces become one polygon and which do not, and that the faces
// still meet as before.
#include "scene/build/joining.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "scene_test_support.h"
#include "support/canceled.h"
#include "transillum/at.h"

namespace transillum::joining_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Turns by a rotation of no special angle and moves.
Vec3 turned(const Vec3& p) {
  const double c = std::cos(0.7), s = std::sin(0.7), k = std::cos(1.1), l = std::sin(1.1);
  const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x + 3, k * q.y - l * q.z - 2, l * q.y + k * q.z + 5};
}

Vec3 as_float(const Vec3& p) {
  const auto f = [](double v) { return static_cast<double>(static_cast<float>(v)); };
  return {f(p.x), f(p.y), f(p.z)};
}

/// Rectangles of a grid, each as two triangles with alternating diagonals, with a point of their
/// own for each triangle.
class Mesh {
 public:
  SceneDescription description;

  Mesh() {
    description.name = "mesh";
    description.materials = {{"gray", {0.5, 0.5, 0.5}, {}}, {"red", {0.5, 0, 0}, {}}};
  }
  void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, int material = 0) {
    std::vector<PointId> outline;
    for (const Vec3& p : {a, b, c}) {
      outline.push_back(static_cast<PointId>(description.points.size()));
      description.points.push_back(p);
    }
    description.add_face(outline, material);
  }
  void add_square(const Vec3& corner, const Vec3& u, const Vec3& v, bool other, int material = 0) {
    add_square(corner, corner + u, corner + u + v, corner + v, other, material);
  }
  void add_square(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, bool other,
                  int material = 0) {
    if (other) {
      add_triangle(a, b, d, material);
      add_triangle(b, c, d, material);
    } else {
      add_triangle(a, b, c, material);
      add_triangle(a, c, d, material);
    }
  }
  /// The grid without the squares that `is_hole` names.
  void add_grid(const Vec3& corner, const Vec3& u, const Vec3& v, int n,
                const std::function<bool(int, int)>& is_hole = {}) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        if (!is_hole || !is_hole(i, j)) {
          const auto point = [&](int k, int l) {
            return corner + static_cast<double>(k) / n * u + static_cast<double>(l) / n * v;
          };
          add_square(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1),
                     (i + j) % 2 == 1);
        }
      }
    }
  }
  void add_box(int n) {
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;
    add_grid(origin, y, x, n);
    add_grid(z, x, y, n);
    add_grid(origin, x, z, n);
    add_grid(y, z, x, n);
    add_grid(origin, z, y, n);
    add_grid(x, y, z, n);
  }
  template <class Map>
  Mesh& move(Map map) {
    for (Vec3& p : description.points) {
      p = map(p);
    }
    return *this;
  }
};

SceneDescription joined(const SceneDescription& d) { return join_faces(d, {}).description; }
double area_of(const SceneDescription& d) { return total_area(Scene(d)); }

/// The largest number of faces that an edge has in one direction, and whether each edge has as many
/// in the other.
bool is_closed(const SceneDescription& d) {
  std::map<std::pair<PointId, PointId>, int> edges;
  for (std::size_t f = 0; f < d.face_count(); ++f) {
    const auto outline = d.outline(f);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; });
}

TEST(Joining, MakesTheSixSquaresOfABoxOfItsTriangles) {
  for (const int n : {1, 2, 7}) {
    Mesh mesh;
    mesh.add_box(n);
    for (const bool turn : {false, true}) {
      if (turn) {
        mesh.move(turned).move(as_float);
      }
      const SceneDescription box = joined(mesh.description);
      ASSERT_EQ(box.face_count(), 6U) << n << turn;
      EXPECT_THAT(box.points, SizeIs(8)) << n << turn;
      for (std::size_t f = 0; f < 6; ++f) {
        EXPECT_THAT(box.outline(f), SizeIs(4)) << n << turn;
      }
      EXPECT_TRUE(is_closed(box));
      EXPECT_NEAR(area_of(box), 6, 1e-5);
    }
  }
}

TEST(Joining, NumbersFacesByTheirFirstPart) {
  Mesh mesh;
  mesh.add_box(1);
  const JoinedFaces result = join_faces(mesh.description, {});
  EXPECT_THAT(result.description.face_number, ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(result.face_of, ElementsAre(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5));
}

TEST(Joining, LeavesAHoleOpen) {
  Mesh mesh;
  mesh.add_grid({}, {1, 0, 0}, {0, 1, 0}, 5, [](int i, int j) { return i == 2 && j == 2; });
  const SceneDescription wall = joined(mesh.description);
  EXPECT_GT(wall.face_count(), 1U);
  EXPECT_LT(wall.face_count(), 6U);
  EXPECT_NEAR(area_of(wall), 24.0 / 25, 1e-12);
  const Scene scene(wall);
  EXPECT_THAT(scene.report().warnings, SizeIs(0));
}

TEST(Joining, KeepsMaterialsGroupsAndSidesApart) {
  Mesh mesh;
  mesh.add_square({}, {1, 0, 0}, {0, 1, 0}, false, 0);
  mesh.add_square({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, false, 1);
  mesh.add_square({2, 0, 0}, {1, 0, 0}, {0, 1, 0}, false, 1);
  EXPECT_EQ(joined(mesh.description).face_count(), 2U);
  SceneDescription grouped = mesh.description;
  grouped.groups = {"left", "right"};
  grouped.face_group = {0, 0, 0, 0, 1, 1};
  EXPECT_EQ(joined(grouped).face_count(), 3U);
  SceneDescription sided = mesh.description;
  sided.face_two_sided = {0, 0, 0, 0, 1, 1};
  const SceneDescription result = joined(sided);
  EXPECT_EQ(result.face_count(), 3U);
  EXPECT_THAT(result.face_two_sided, ElementsAre(0, 0, 1));
}

TEST(Joining, KeepsCornersThatOtherFacesBendAt) {
  // Two walls that meet in an edge; the second one has a corner in its middle.
  Mesh mesh;
  mesh.add_grid({}, {1, 0, 0}, {0, 1, 0}, 2);
  mesh.add_triangle({1, 0, 0}, {0.5, 0, 0}, {1, 0, 1});
  mesh.add_triangle({0.5, 0, 0}, {}, {0, 0.25, 1});
  const SceneDescription result = joined(mesh.description);
  ASSERT_EQ(result.face_count(), 3U);
  EXPECT_THAT(result.outline(0), SizeIs(5));
}

TEST(Joining, KeepsTheFacetsOfACylinder) {
  for (const int facets : {12, 360, 3600}) {
    Mesh mesh;
    for (int k = 0; k < facets; ++k) {
      const auto at_angle = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / facets;
        return Vec3{std::cos(angle), std::sin(angle), 0};
      };
      const Vec3 a = at_angle(k), b = at_angle(k + 1), up{0, 0, 1};
      mesh.add_triangle(a, b, b + up);
      mesh.add_triangle(a, b + up, a + up);
    }
    for (const bool rounded : {false, true}) {
      if (rounded) {
        mesh.move(turned).move(as_float);
      }
      EXPECT_EQ(joined(mesh.description).face_count(), static_cast<std::size_t>(facets)) << rounded;
    }
  }
}

TEST(Joining, KeepsTheAreaOfAnyMesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Mesh mesh;
    mesh.add_grid({}, {1, 0, 0}, {0, 1, 0}, 9, [&](int, int) { return unit(random) < 0.3; });
    mesh.add_grid({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 4, [&](int, int) { return unit(random) < 0.2; });
    mesh.move(turned);
    if (trial % 3 == 1) {
      mesh.move(as_float);
    } else if (trial % 3 == 2) {
      // Points that are nearly one.
      mesh.move([&](const Vec3& p) { return p + Vec3{1e-15 * unit(random), 0, 0}; });
    }
    const SceneDescription result = joined(mesh.description);
    EXPECT_LT(result.face_count(), mesh.description.face_count() / (trial % 3 == 2 ? 1 : 2));
    const double area = area_of(mesh.description);
    EXPECT_NEAR(area_of(result), area, 1e-5 * area) << trial;
  }
}

TEST(Joining, PassesFacesWithoutAreaOn) {
  Mesh mesh;
  mesh.add_square({}, {1, 0, 0}, {0, 1, 0}, false);
  mesh.add_triangle({}, {1, 0, 0}, {0.5, 0, 0});
  mesh.add_triangle({}, {1, 0, 0}, {1, 0, 0});
  const SceneDescription result = joined(mesh.description);
  EXPECT_NEAR(area_of(result), 1, 1e-12);
}

TEST(Joining, IsCanceled) {
  Mesh mesh;
  mesh.add_box(60);
  EXPECT_THROW(join_faces(mesh.description, testing::canceled()), Canceled);
}

}  // namespace
}  // namespace transillum::joining_test
