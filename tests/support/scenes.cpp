// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "transillum/directions.h"

namespace transillum::testing {
namespace {

double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

}  // namespace

int Sketch::material(double reflectance, double exitance) {
  const auto number = static_cast<int>(description_.materials.size());
  description_.materials.push_back({"m" + std::to_string(number),
                                    {reflectance, reflectance, reflectance},
                                    {exitance, exitance, exitance}});
  return number;
}

Sketch& Sketch::face(const std::vector<Vec3>& outline, int material) {
  std::vector<PointId> ids;
  for (const Vec3& p : outline) {
    ids.push_back(static_cast<PointId>(description_.points.size()));
    description_.points.push_back(p);
  }
  description_.add_face(ids, material);
  return *this;
}

Sketch& Sketch::grid(const Vec3& corner, const Vec3& u, const Vec3& v, int divisions,
                     const std::function<int(double s, double t)>& material) {
  const double step = 1.0 / divisions;
  for (int i = 0; i < divisions; ++i) {
    for (int j = 0; j < divisions; ++j) {
      const auto at = [&](int a, int b) { return corner + a * step * u + b * step * v; };
      face({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)},
           material((i + 0.5) * step, (j + 0.5) * step));
    }
  }
  return *this;
}

Sketch& Sketch::box(const Vec3& a, const Vec3& b, bool inward, int material) {
  std::vector<std::vector<Vec3>> faces{
      {{a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}},
      {{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}},
      {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}},
      {{a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}},
      {{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}},
      {{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}}};
  for (auto& outline : faces) {
    if (inward) {
      std::reverse(outline.begin(), outline.end());
    }
    face(outline, material);
  }
  return *this;
}

Sketch& Sketch::triangles(int count, double size, std::uint64_t seed, int material) {
  std::mt19937_64 generator(seed);
  for (int k = 0; k < count; ++k) {
    const Vec3 at{uniform(generator), uniform(generator), uniform(generator)};
    std::vector<Vec3> outline;
    for (int corner = 0; corner < 3; ++corner) {
      outline.push_back(at + size * Vec3{uniform(generator) - 0.5, uniform(generator) - 0.5,
                                         uniform(generator) - 0.5});
    }
    face(outline, material);
  }
  return *this;
}

Sketch& Sketch::tetrahedra(int count, double size, std::uint64_t seed, int material) {
  std::mt19937_64 generator(seed);
  const auto point = [&generator] {
    const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
    return Vec3{x, y, z};
  };
  for (int k = 0; k < count; ++k) {
    const Vec3 at = (1 - size) * point();
    std::array<Vec3, 4> corners;
    for (Vec3& corner : corners) {
      corner = at + size * point();
    }
    auto& [a, b, c, d] = corners;
    // d lies behind a, b, c.
    if (dot(cross(b - a, c - a), d - a) > 0) {
      std::swap(a, b);
    }
    face({a, b, c}, material).face({a, c, d}, material);
    face({a, d, b}, material).face({b, d, c}, material);
  }
  return *this;
}

Sketch box_in_cube(int wall, int side, const std::function<Vec3(const Vec3&)>& move) {
  Sketch sketch("box-in-cube");
  const int gray = sketch.material(0.5, 0), light = sketch.material(0.5, 1);
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, low{0.3, 0.3, 0.3}, high{0.7, 0.7, 0.7};
  const auto all_gray = [&](double, double) { return gray; };
  const auto lit_middle = [&](double s, double t) {
    return std::max(std::abs(s - 0.5), std::abs(t - 0.5)) < 0.25 ? light : gray;
  };
  sketch.grid({}, x, y, wall, all_gray).grid(z, y, x, wall, lit_middle);
  sketch.grid({}, y, z, wall, all_gray).grid(x, z, y, wall, all_gray);
  sketch.grid({}, z, x, wall, all_gray).grid(y, x, z, wall, all_gray);
  const auto add_side = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    const Vec3 at = move(corner);
    sketch.grid(at, move(corner + 0.4 * u) - at, move(corner + 0.4 * v) - at, side, all_gray);
  };
  add_side(low, y, x);
  add_side(low, z, y);
  add_side(low, x, z);
  add_side(high, -x, -y);
  add_side(high, -y, -z);
  add_side(high, -z, -x);
  return sketch;
}

SceneDescription moved(const SceneDescription& description,
                       const std::function<Vec3(const Vec3&)>& move) {
  SceneDescription result = description;
  for (Vec3& p : result.points) {
    p = move(p);
  }
  return result;
}

SceneDescription reordered(const SceneDescription& description, const std::vector<int>& order) {
  SceneDescription result;
  result.name = description.name;
  result.points = description.points;
  result.materials = description.materials;
  for (const int f : order) {
    const auto face = static_cast<std::size_t>(f);
    result.add_face(description.outline(face), description.face_material[face]);
  }
  return result;
}

std::function<Vec3(const Vec3&)> random_rotation(std::uint64_t seed) {
  const auto two = make_directions(Sampling::random, 2, seed);
  const Vec3 x = two[0].direction;
  const Vec3 y = normalized(cross(two[1].direction, x));
  const Vec3 z = cross(x, y);
  return [=](const Vec3& p) { return p.x * x + p.y * y + p.z * z; };
}

std::function<Vec3(const Vec3&)> random_rotation_about(const Vec3& center, std::uint64_t seed) {
  return [center, rotation = random_rotation(seed)](const Vec3& p) {
    return center + rotation(p - center);
  };
}

std::vector<Vec3> test_directions(int count, std::uint64_t seed) {
  std::vector<Vec3> directions{{0, 0, 1}, {1, 0, 0},  {0, 1, 0}, {0, 0, -1},
                               {1, 1, 0}, {1, -1, 1}, {0, 1, 1}};
  for (Vec3& d : directions) {
    d = normalized(d);
  }
  directions.resize(static_cast<std::size_t>(std::min<int>(count, 7)));
  if (count > 7) {
    for (const auto& sample : make_directions(Sampling::random, count - 7, seed)) {
      directions.push_back(sample.direction);
    }
  }
  return directions;
}

}  // namespace transillum::testing
