// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Scenes with the flaws of real files. Objects are made as a mesh of quadrilaterals and triangles,
// in a room around them; then all points are turned and rounded, so that faces that were planar,
// and surfaces that touched, are so only within the rounding.
#include "support/imperfect_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

namespace transillum::testing {
namespace {

struct Axes {
  Vec3 x, y, z;
};

class Mesh {
 public:
  explicit Mesh(const ImperfectScene& scene) : scene_(scene), generator_(scene.seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  Vec3 point(const Vec3& low, const Vec3& high) {
    // One statement per number: the scene depends on the order of evaluation.
    const double x = uniform(low.x, high.x);
    const double y = uniform(low.y, high.y);
    const double z = uniform(low.z, high.z);
    return {x, y, z};
  }
  Axes random_axes() {
    Vec3 z;
    do {
      z = point({-1, -1, -1}, {1, 1, 1});
    } while (norm(z) < 0.1 || norm(z) > 1);
    z = normalized(z);
    const Vec3 x = normalized(cross(std::abs(z.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, z));
    return {x, cross(z, x), z};
  }

  PointId add(const Vec3& p) {
    description.points.push_back(p);
    return static_cast<PointId>(description.points.size()) - 1;
  }
  void face(std::vector<PointId> corners, int material = 0) {
    if (scene_.quads) {
      description.add_face(corners, material);
      return;
    }
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      description.add_face(std::vector<PointId>{corners[0], corners[k], corners[k + 1]}, material);
    }
  }
  /// Faces outward, or inward with the top emitting.
  void box(const Vec3& center, const Axes& axes, const Vec3& half, bool room = false) {
    std::array<PointId, 8> p{};
    for (std::size_t k = 0; k < 8; ++k) {
      const auto sign = [k](std::size_t bit) { return (k >> bit & 1) != 0 ? 1.0 : -1.0; };
      p[k] = add(center + sign(0) * half.x * axes.x + sign(1) * half.y * axes.y +
                 sign(2) * half.z * axes.z);
    }
    constexpr std::array<std::array<std::size_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
    for (std::size_t s = 0; s < sides.size(); ++s) {
      std::vector<PointId> corners;
      for (const std::size_t k : sides[s]) {
        corners.push_back(p[k]);
      }
      if (room) {
        std::reverse(corners.begin(), corners.end());
      }
      face(corners, !room ? 0 : s == 1 ? 2 : 1);
    }
  }
  /// From corner to corner, along the axes.
  void box(const Vec3& low, const Vec3& high) {
    box(0.5 * (low + high), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.5 * (high - low));
  }

  SceneDescription description;

 private:
  const ImperfectScene& scene_;
  std::mt19937_64 generator_;
};

void add_rails(const ImperfectScene& scene, Mesh& mesh) {
  for (int i = 0; i < scene.count; ++i) {
    mesh.box({1.0 * i, -1.3, 0}, {i + 0.25, 1.3, 0.15});
  }
  for (const double y : {-0.75, 0.68}) {
    mesh.box({-1, y, 0.15 + scene.gap}, {1.0 * scene.count, y + 0.07, 0.3 + scene.gap});
  }
}

void add_truss(const ImperfectScene& scene, Mesh& mesh) {
  std::vector<Vec3> knots;
  for (int k = 0; k < std::max(4, scene.count / 6); ++k) {
    knots.push_back(mesh.point({-100, -100, -100}, {100, 100, 100}));
  }
  const auto any = [&] {
    return static_cast<std::size_t>(mesh.uniform(0, static_cast<double>(knots.size())));
  };
  for (int k = 0; k < scene.count; ++k) {
    const std::size_t a = any();
    std::size_t b = any();
    while (b == a) {
      b = any();
    }
    const double width = 100 / scene.aspect * std::pow(scene.aspect / 100, mesh.uniform(0, 1));
    const PointId from = mesh.add(knots[a]), to = mesh.add(knots[b]);
    const PointId tip = mesh.add(knots[b] + width * mesh.random_axes().x);
    mesh.face({from, to, tip});
    mesh.face({from, tip, to});
  }
}

void add_ball(const ImperfectScene& scene, Mesh& mesh) {
  const int rings = scene.count, slices = 2 * scene.count;
  const PointId top = mesh.add({0, 0, 1}), bottom = mesh.add({0, 0, -1});
  const double pi = std::acos(-1.0);
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < slices; ++j) {
      const double theta = pi * i / rings, phi = 2 * pi * j / slices;
      mesh.add({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  const auto on_ring = [&](int i, int j) {
    return static_cast<PointId>(2 + (i - 1) * slices + j % slices);
  };
  for (int j = 0; j < slices; ++j) {
    mesh.face({top, on_ring(1, j), on_ring(1, j + 1)});
    mesh.face({bottom, on_ring(rings - 1, j + 1), on_ring(rings - 1, j)});
    for (int i = 1; i < rings - 1; ++i) {
      mesh.face({on_ring(i, j), on_ring(i + 1, j), on_ring(i + 1, j + 1), on_ring(i, j + 1)});
    }
  }
}

void add_terrain(const ImperfectScene& scene, Mesh& mesh) {
  const int n = scene.count;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      mesh.add({10.0 * i / n, 10.0 * j / n, mesh.uniform(0, 0.3)});
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const PointId p = i * (n + 1) + j;
      mesh.face({p, p + n + 1, p + n + 2, p + 1});
    }
  }
}

void add_objects(const ImperfectScene& scene, Mesh& mesh) {
  switch (scene.kind) {
    case Imperfect::rails:
      return add_rails(scene, mesh);
    case Imperfect::beams:
      for (int k = 0; k < scene.count; ++k) {
        const Vec3 center = mesh.point({-400, -400, -400}, {400, 400, 400});
        const double half = 500 / scene.aspect;
        mesh.box(center, mesh.random_axes(), {half, half, 500});
      }
      return;
    case Imperfect::truss:
      return add_truss(scene, mesh);
    case Imperfect::clutter:
      for (int k = 0; k < scene.count; ++k) {
        const Vec3 center = mesh.point({-5, -5, 0}, {5, 5, 1});
        const Axes axes = mesh.random_axes();
        mesh.box(center, axes, mesh.point({0.1, 0.1, 0.1}, {1, 1, 1}));
      }
      return;
    case Imperfect::ball:
      return add_ball(scene, mesh);
    case Imperfect::terrain:
      return add_terrain(scene, mesh);
  }
}

/// A room around all points. Clutter and ball stand on, or in, its floor.
void add_room(const ImperfectScene& scene, Mesh& mesh) {
  Bounds bounds;
  for (const Vec3& p : mesh.description.points) {
    bounds.add(p);
  }
  const Vec3 margin = 0.3 * (bounds.high - bounds.low) + Vec3{0.1, 0.1, 0.1};
  bounds.low = bounds.low - margin;
  bounds.high = bounds.high + margin;
  if (scene.kind == Imperfect::clutter) {
    bounds.low.z = 0;
  } else if (scene.kind == Imperfect::ball) {
    bounds.low.z = -1;
  }
  mesh.box(bounds.center(), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.5 * (bounds.high - bounds.low),
           true);
}

double rounded(double v, int digits) {
  return digits < 17 ? std::strtod(fmt::format("{:.{}g}", v, digits).c_str(), nullptr) : v;
}

}  // namespace

SceneDescription describe(const ImperfectScene& scene) {
  Mesh mesh(scene);
  mesh.description.materials = {{"thing", {0.6, 0.5, 0.4}, {}},
                                {"wall", {0.5, 0.5, 0.5}, {}},
                                {"lamp", {0.5, 0.5, 0.5}, {1, 1, 1}}};
  add_objects(scene, mesh);
  add_room(scene, mesh);
  const Axes axes = scene.turned ? mesh.random_axes() : Axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (Vec3& p : mesh.description.points) {
    const Vec3 turned = p.x * axes.x + p.y * axes.y + p.z * axes.z;
    p = {rounded(turned.x, scene.digits), rounded(turned.y, scene.digits),
         rounded(turned.z, scene.digits)};
  }
  return std::move(mesh.description);
}

RandomScene random_imperfect_scene(std::uint64_t seed) {
  std::mt19937_64 generator(seed * 0x9e3779b97f4a7c15U + 7);
  const auto pick = [&](int count) {
    return static_cast<int>(generator() % static_cast<unsigned>(count));
  };
  constexpr std::array digits{6, 7, 9, 12, 17};
  constexpr std::array gaps{-0.05, 0.0, 0.05};
  ImperfectScene scene;
  scene.kind = static_cast<Imperfect>(pick(6));
  scene.count = 3 + pick(5);
  scene.gap = gaps[static_cast<std::size_t>(pick(3))];
  scene.aspect = 500;
  scene.digits = digits[static_cast<std::size_t>(pick(5))];
  scene.turned = pick(4) > 0;
  scene.quads = pick(2) == 0;
  scene.seed = seed;

  constexpr std::array kinds{"rails", "beams", "truss", "clutter", "ball", "terrain"};
  RandomScene random;
  random.kind = kinds[static_cast<std::size_t>(scene.kind)];
  random.description = describe(scene);
  random.description.name =
      fmt::format("{} {}, {} digits{}{}", random.kind, seed, scene.digits,
                  scene.turned ? ", turned" : "", scene.quads ? ", quadrilaterals" : "");
  // Clutter, and a rounded ball where it touches the floor, reach through the floor.
  random.closed = scene.kind != Imperfect::clutter && scene.kind != Imperfect::ball;
  const auto component = [&] { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1; };
  for (int k = 0; k < 2; ++k) {
    const double x = component(), y = component(), z = component();
    random.directions.push_back(normalized(Vec3{x, y, z + 1e-3}));
  }
  random.directions.push_back({0, 0, 1});
  return random;
}

}  // namespace transillum::testing
