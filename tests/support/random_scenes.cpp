// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Ten kinds of random scenes with degeneracies: interpenetration, contact, overlap, T-junctions,
// slivers, coordinates on a grid, coincident faces, cyclic overlap, straight corners.
#include "support/random_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>

#include "support/scenes.h"
#include "transillum/at.h"

namespace transillum::testing {
namespace {

/// Random numbers and a sketch of the scene made from them.
class SceneGenerator {
 public:
  explicit SceneGenerator(std::uint64_t seed) : generator_(seed * 0x9e3779b97f4a7c15U + 1) {
    for (int k = 0; k < 4; ++k) {
      materials_.push_back(sketch_.material(0.2 * k, k % 2));
    }
  }

  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  /// 0 … count-1.
  int pick(int count) { return static_cast<int>(generator_() % static_cast<unsigned>(count)); }
  int some(int low, int high) { return low + pick(high - low + 1); }
  bool chance(double probability) { return uniform() < probability; }
  Vec3 point(double size = 1) {
    // One statement per number: the scene depends on the order of evaluation.
    const double x = uniform(-size, size);
    const double y = uniform(-size, size);
    const double z = uniform(-size, size);
    return {x, y, z};
  }
  Vec3 unit() {
    for (;;) {
      const Vec3 p = point();
      if (norm(p) > 0.1 && norm(p) < 1) {
        return normalized(p);
      }
    }
  }

  void face(std::vector<Vec3> outline) {
    if (chance(0.5)) {
      std::reverse(outline.begin(), outline.end());
    }
    face_as_it_is(outline);
  }
  void face_as_it_is(const std::vector<Vec3>& outline) { sketch_.face(outline, any_material()); }
  int any_material() { return at(materials_, pick(4)); }
  Sketch& sketch() { return sketch_; }

  bool closed = false;

 private:
  std::mt19937_64 generator_;
  Sketch sketch_{"random"};
  std::vector<int> materials_;
};

/// Corners of a plane figure placed in space: at + x u + y v.
std::vector<Vec3> placed(const std::vector<std::array<double, 2>>& flat, const Vec3& at,
                         const Vec3& u, const Vec3& v) {
  std::vector<Vec3> outline;
  for (const auto& [x, y] : flat) {
    outline.push_back(at + x * u + y * v);
  }
  return outline;
}

struct PlaneAxes {
  Vec3 u, v;
};
PlaneAxes any_axes(SceneGenerator& generator) {
  const Vec3 normal = generator.unit();
  const Vec3 u = normalized(cross(normal, generator.unit()));
  return {u, cross(normal, u)};
}

/// A concave star of `count` corners about the origin.
/// @param straight_corners adds corners in the middle of some edges.
std::vector<std::array<double, 2>> star(SceneGenerator& generator, int count,
                                        bool straight_corners) {
  std::vector<std::array<double, 2>> outline;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * (k + generator.uniform(0, 0.7)) / count;
    const double radius = generator.uniform(0.25, 1);
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  if (!straight_corners) {
    return outline;
  }
  std::vector<std::array<double, 2>> refined;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const auto& a = outline[k];
    const auto& b = outline[(k + 1) % outline.size()];
    refined.push_back(a);
    if (generator.chance(0.5)) {
      refined.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
    }
  }
  return refined;
}

void add_triangles(SceneGenerator& generator, int count) {
  for (int k = 0; k < count; ++k) {
    const Vec3 at = generator.point(0.7);
    std::vector<Vec3> outline;
    for (int corner = 0; corner < 3; ++corner) {
      outline.push_back(at + generator.point(0.8));
    }
    generator.face(outline);
  }
}

void add_stars(SceneGenerator& generator, int count, bool straight_corners) {
  for (int k = 0; k < count; ++k) {
    const PlaneAxes axes = any_axes(generator);
    generator.face(placed(star(generator, generator.some(4, 9), straight_corners),
                          generator.point(0.7), axes.u, axes.v));
  }
}

void interpenetrating(SceneGenerator& generator) {
  add_triangles(generator, generator.some(3, 15));
  add_stars(generator, generator.some(2, 8), false);
}

void concave_with_straight_corners(SceneGenerator& generator) {
  add_stars(generator, generator.some(5, 16), true);
}

/// Boxes, some of which stand on the floor, touch or intersect one another.
void boxes_in_a_room(SceneGenerator& generator) {
  generator.sketch().box({-2, -2, -1}, {2, 2, 1}, true, generator.any_material());
  // The bottom of a box on the floor faces out of the room.
  const bool standing = generator.chance(0.3);
  generator.closed = !standing;
  const int count = generator.some(1, 7);
  for (int k = 0; k < count; ++k) {
    const auto snapped = [&](double low, double high) {
      return generator.chance(0.5) ? 0.25 * std::round(4 * generator.uniform(low, high))
                                   : generator.uniform(low, high);
    };
    const double x = snapped(-1.7, 1), y = snapped(-1.7, 1);
    const double z = standing && generator.chance(0.7) ? -1 : snapped(-0.85, 0.4);
    const Vec3 size{generator.uniform(0.1, 0.7), generator.uniform(0.1, 0.7),
                    generator.uniform(0.1, 0.5)};
    generator.sketch().box({x, y, z}, Vec3{x, y, z} + size, false, generator.any_material());
  }
}

/// Tiles that touch, overlap or coincide, in a few parallel planes.
void stacks_of_tiles(SceneGenerator& generator) {
  const PlaneAxes axes =
      generator.chance(0.5) ? PlaneAxes{{1, 0, 0}, {0, 1, 0}} : any_axes(generator);
  const Vec3 normal = cross(axes.u, axes.v);
  const int planes = generator.some(1, 4);
  for (int plane = 0; plane < planes; ++plane) {
    const int tiles = generator.some(4, 12);
    for (int k = 0; k < tiles; ++k) {
      const double x = 0.25 * generator.pick(6), y = 0.25 * generator.pick(6);
      const double width = 0.25 * generator.some(1, 3), height = 0.25 * generator.some(1, 3);
      generator.face(placed({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}},
                            0.3 * plane * normal, axes.u, axes.v));
    }
  }
}

/// A rectangle subdivided recursively, so that corners lie inside the edges of other parts.
void cut_rectangle(SceneGenerator& generator, const PlaneAxes& axes, const Vec3& at, double x0,
                   double x1, double y0, double y1, int depth, bool reversed) {
  if (depth > 0) {
    const double fraction = generator.uniform(0.2, 0.8);
    const bool across = x1 - x0 > y1 - y0;
    const double x = across ? x0 + fraction * (x1 - x0) : x1;
    const double y = across ? y1 : y0 + fraction * (y1 - y0);
    cut_rectangle(generator, axes, at, x0, x, y0, y, depth - 1 - generator.pick(2), reversed);
    cut_rectangle(generator, axes, at, across ? x : x0, x1, across ? y0 : y, y1,
                  depth - 1 - generator.pick(2), reversed);
    return;
  }
  auto outline = placed({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, at, axes.u, axes.v);
  if (reversed) {
    std::reverse(outline.begin(), outline.end());
  }
  generator.face_as_it_is(outline);
}

void grids_with_t_junctions(SceneGenerator& generator) {
  const PlaneAxes flat{{1, 0, 0}, {0, 1, 0}};
  cut_rectangle(generator, flat, {-1, -1, 0}, 0, 2, 0, 2, generator.some(2, 5), false);
  const PlaneAxes above = generator.chance(0.5) ? flat : any_axes(generator);
  cut_rectangle(generator, above, {-0.5, -0.5, generator.uniform(0.2, 1.5)}, -1, 1, -1, 1,
                generator.some(1, 5), generator.chance(0.7));
  add_triangles(generator, generator.pick(4));
}

/// Needles of widths from a tenth down to a ten-millionth of their length.
void slivers(SceneGenerator& generator) {
  const int count = generator.some(5, 20);
  for (int k = 0; k < count; ++k) {
    const PlaneAxes axes = any_axes(generator);
    const double width = std::pow(10.0, -generator.uniform(1, 7));
    const Vec3 at = generator.point(0.5);
    if (generator.chance(0.5)) {
      generator.face(
          placed({{-1, 0}, {1, 0}, {generator.uniform(-1, 1), width}}, at, axes.u, axes.v));
    } else {
      generator.face(placed({{-1, 0}, {1, 0}, {1, width}, {-1, width}}, at, axes.u, axes.v));
    }
  }
  add_triangles(generator, generator.some(1, 6));
}

/// All corners on a coarse grid: points on edges, edges on edges, planes through corners.
void snapped_to_a_grid(SceneGenerator& generator) {
  const auto corner = [&] {
    const double x = generator.some(-2, 2), y = generator.some(-2, 2), z = generator.some(-2, 2);
    return Vec3{x, y, z};
  };
  for (int added = 0, wanted = generator.some(8, 35); added < wanted;) {
    const Vec3 a = corner(), b = corner(), c = corner();
    if (norm(cross(b - a, c - a)) == 0) {
      continue;
    }
    std::vector<Vec3> outline{a, b, c};
    if (generator.chance(0.4)) {
      outline.push_back(a + (c - b));
    }
    generator.face(outline);
    ++added;
  }
}

void both_sides_of_everything(SceneGenerator& generator) {
  add_triangles(generator, generator.some(3, 12));
  add_stars(generator, generator.some(1, 5), true);
}

/// Faces and copies of them, some reversed, and other faces in the same planes.
void coincident_faces(SceneGenerator& generator) {
  const int count = generator.some(3, 12);
  for (int k = 0; k < count; ++k) {
    const PlaneAxes axes = any_axes(generator);
    const Vec3 at = generator.point(0.6);
    const auto outline = star(generator, generator.some(3, 6), false);
    const int copies = generator.some(1, 3);
    for (int copy = 0; copy < copies; ++copy) {
      generator.face(placed(outline, at, axes.u, axes.v));
    }
    if (generator.chance(0.6)) {
      const double x = generator.uniform(-0.5, 0.5), y = generator.uniform(-0.5, 0.5);
      generator.face(
          placed(star(generator, 4, false), at + x * axes.u + y * axes.v, axes.u, axes.v));
    }
  }
}

/// Rings of boards, each above the next and below the previous one.
void cyclic_overlap(SceneGenerator& generator) {
  const int rings = generator.some(1, 3);
  for (int ring = 0; ring < rings; ++ring) {
    const int boards = generator.some(3, 8);
    const double lift = generator.uniform(0.05, 0.4), breadth = generator.uniform(0.05, 0.4);
    for (int k = 0; k < boards; ++k) {
      const double angle = 2 * M_PI * k / boards;
      const Vec3 out{std::cos(angle), std::sin(angle), 0}, along{-out.y, out.x, lift};
      generator.face(placed({{-1.2, 0}, {1.2, 0}, {1.2, breadth}, {-1.2, breadth}},
                            0.5 * out + Vec3{0, 0, 0.3 * ring}, along, out));
    }
  }
  add_triangles(generator, generator.pick(5));
}

struct Kind {
  const char* name;
  void (*make)(SceneGenerator&);
  bool two_sided = false;
};
constexpr Kind kinds[] = {
    {"interpenetrating", interpenetrating},
    {"boxes in a room", boxes_in_a_room},
    {"stacks of tiles", stacks_of_tiles},
    {"T-junctions", grids_with_t_junctions},
    {"slivers", slivers},
    {"snapped to a grid", snapped_to_a_grid},
    {"both sides", both_sides_of_everything, true},
    {"coincident faces", coincident_faces},
    {"cyclic overlap", cyclic_overlap},
    {"straight corners", concave_with_straight_corners},
};

/// Directions along which something is edge-on, and one random direction.
std::vector<Vec3> difficult_directions(SceneGenerator& generator,
                                       const SceneDescription& description) {
  std::vector<Vec3> directions;
  for (;;) {
    const double x = generator.some(-1, 1), y = generator.some(-1, 1), z = generator.some(-1, 1);
    if (x == 0 && y == 0 && z == 0) {
      continue;
    }
    directions.push_back(normalized({x, y, z}));
    break;
  }
  const auto outline = description.outline(
      static_cast<std::size_t>(generator.pick(static_cast<int>(description.face_count()))));
  const auto corner = [&](std::size_t k) {
    return at(description.points, outline[k % outline.size()]);
  };
  const auto k = static_cast<std::size_t>(generator.pick(static_cast<int>(outline.size())));
  const Vec3 edge = normalized(corner(k + 1) - corner(k));
  directions.push_back(edge);
  directions.push_back(normalized(corner(k + 2) - corner(k) + generator.uniform() * edge));
  directions.push_back(generator.unit());
  return directions;
}

}  // namespace

RandomScene random_scene(std::uint64_t seed) {
  SceneGenerator generator(seed);
  const Kind& kind = kinds[seed % std::size(kinds)];
  kind.make(generator);
  RandomScene scene;
  scene.kind = kind.name;
  scene.closed = generator.closed;
  scene.options.two_sided = kind.two_sided;
  const double scale = generator.chance(0.35) ? std::pow(10.0, generator.some(-6, 6)) : 1;
  scene.description =
      moved(generator.sketch().description(), [&](const Vec3& p) { return scale * p; });
  scene.description.name = "random scene " + std::to_string(seed) + ": " + scene.kind;
  scene.directions = difficult_directions(generator, scene.description);
  return scene;
}

}  // namespace transillum::testing
