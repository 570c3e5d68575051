// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
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

class SceneGame {
 public:
  explicit SceneGame(std::uint64_t seed) : generator_(seed * 0x9e3779b97f4a7c15U + 1) {
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
    // One statement a number: the order of evaluation is part of the scene.
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

/// Corners of a plane figure: at + x u + y v.
std::vector<Vec3> placed(const std::vector<std::array<double, 2>>& figure, const Vec3& at,
                         const Vec3& u, const Vec3& v) {
  std::vector<Vec3> outline;
  for (const auto& [x, y] : figure) {
    outline.push_back(at + x * u + y * v);
  }
  return outline;
}

struct Axes {
  Vec3 u, v;
};
Axes any_axes(SceneGame& game) {
  const Vec3 normal = game.unit();
  const Vec3 u = normalized(cross(normal, game.unit()));
  return {u, cross(normal, u)};
}

/// A star of `count` corners round the origin; concave, with corners in the middle of some edges.
std::vector<std::array<double, 2>> star(SceneGame& game, int count, bool straight_corners) {
  std::vector<std::array<double, 2>> figure;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * (k + game.uniform(0, 0.7)) / count;
    const double radius = game.uniform(0.25, 1);
    figure.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  if (!straight_corners) {
    return figure;
  }
  std::vector<std::array<double, 2>> refined;
  for (std::size_t k = 0; k < figure.size(); ++k) {
    const auto& a = figure[k];
    const auto& b = figure[(k + 1) % figure.size()];
    refined.push_back(a);
    if (game.chance(0.5)) {
      refined.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
    }
  }
  return refined;
}

void add_triangles(SceneGame& game, int count) {
  for (int k = 0; k < count; ++k) {
    const Vec3 at = game.point(0.7);
    std::vector<Vec3> outline;
    for (int corner = 0; corner < 3; ++corner) {
      outline.push_back(at + game.point(0.8));
    }
    game.face(outline);
  }
}

void add_stars(SceneGame& game, int count, bool straight_corners) {
  for (int k = 0; k < count; ++k) {
    const Axes axes = any_axes(game);
    game.face(
        placed(star(game, game.some(4, 9), straight_corners), game.point(0.7), axes.u, axes.v));
  }
}

void interpenetrating(SceneGame& game) {
  add_triangles(game, game.some(3, 15));
  add_stars(game, game.some(2, 8), false);
}

void concave_with_straight_corners(SceneGame& game) { add_stars(game, game.some(5, 16), true); }

/// Boxes, some of which stand on the floor, touch one another or stick in one another.
void boxes_in_a_room(SceneGame& game) {
  game.sketch().box({-2, -2, -1}, {2, 2, 1}, true, game.any_material());
  // The bottom of a box on the floor looks out of the room.
  const bool standing = game.chance(0.3);
  game.closed = !standing;
  const int count = game.some(1, 7);
  for (int k = 0; k < count; ++k) {
    const auto snapped = [&](double low, double high) {
      return game.chance(0.5) ? 0.25 * std::round(4 * game.uniform(low, high))
                              : game.uniform(low, high);
    };
    const double x = snapped(-1.7, 1), y = snapped(-1.7, 1);
    const double z = standing && game.chance(0.7) ? -1 : snapped(-0.85, 0.4);
    const Vec3 size{game.uniform(0.1, 0.7), game.uniform(0.1, 0.7), game.uniform(0.1, 0.5)};
    game.sketch().box({x, y, z}, Vec3{x, y, z} + size, false, game.any_material());
  }
}

/// Tiles that touch, overlap or coincide in a few planes one above the other.
void stacks_of_tiles(SceneGame& game) {
  const Axes axes = game.chance(0.5) ? Axes{{1, 0, 0}, {0, 1, 0}} : any_axes(game);
  const Vec3 normal = cross(axes.u, axes.v);
  const int planes = game.some(1, 4);
  for (int plane = 0; plane < planes; ++plane) {
    const int tiles = game.some(4, 12);
    for (int k = 0; k < tiles; ++k) {
      const double x = 0.25 * game.pick(6), y = 0.25 * game.pick(6);
      const double width = 0.25 * game.some(1, 3), height = 0.25 * game.some(1, 3);
      game.face(placed({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}},
                       0.3 * plane * normal, axes.u, axes.v));
    }
  }
}

/// A rectangle cut again and again, so that corners lie inside the edges of others.
void cut_rectangle(SceneGame& game, const Axes& axes, const Vec3& at, double x0, double x1,
                   double y0, double y1, int depth, bool reversed) {
  if (depth > 0) {
    const double share = game.uniform(0.2, 0.8);
    const bool across = x1 - x0 > y1 - y0;
    const double x = across ? x0 + share * (x1 - x0) : x1;
    const double y = across ? y1 : y0 + share * (y1 - y0);
    cut_rectangle(game, axes, at, x0, x, y0, y, depth - 1 - game.pick(2), reversed);
    cut_rectangle(game, axes, at, across ? x : x0, x1, across ? y0 : y, y1,
                  depth - 1 - game.pick(2), reversed);
    return;
  }
  auto outline = placed({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, at, axes.u, axes.v);
  if (reversed) {
    std::reverse(outline.begin(), outline.end());
  }
  game.face_as_it_is(outline);
}

void grids_with_t_junctions(SceneGame& game) {
  const Axes flat{{1, 0, 0}, {0, 1, 0}};
  cut_rectangle(game, flat, {-1, -1, 0}, 0, 2, 0, 2, game.some(2, 5), false);
  const Axes above = game.chance(0.5) ? flat : any_axes(game);
  cut_rectangle(game, above, {-0.5, -0.5, game.uniform(0.2, 1.5)}, -1, 1, -1, 1, game.some(1, 5),
                game.chance(0.7));
  add_triangles(game, game.pick(4));
}

/// Needles of widths from a tenth down to a ten-millionth of their length.
void slivers(SceneGame& game) {
  const int count = game.some(5, 20);
  for (int k = 0; k < count; ++k) {
    const Axes axes = any_axes(game);
    const double width = std::pow(10.0, -game.uniform(1, 7));
    const Vec3 at = game.point(0.5);
    if (game.chance(0.5)) {
      game.face(placed({{-1, 0}, {1, 0}, {game.uniform(-1, 1), width}}, at, axes.u, axes.v));
    } else {
      game.face(placed({{-1, 0}, {1, 0}, {1, width}, {-1, width}}, at, axes.u, axes.v));
    }
  }
  add_triangles(game, game.some(1, 6));
}

/// All corners on a coarse grid: points on edges, edges on edges, planes through corners.
void snapped_to_a_grid(SceneGame& game) {
  const auto corner = [&] {
    const double x = game.some(-2, 2), y = game.some(-2, 2), z = game.some(-2, 2);
    return Vec3{x, y, z};
  };
  for (int added = 0, wanted = game.some(8, 35); added < wanted;) {
    const Vec3 a = corner(), b = corner(), c = corner();
    if (norm(cross(b - a, c - a)) == 0) {
      continue;
    }
    std::vector<Vec3> outline{a, b, c};
    if (game.chance(0.4)) {
      outline.push_back(a + (c - b));
    }
    game.face(outline);
    ++added;
  }
}

void both_sides_of_everything(SceneGame& game) {
  add_triangles(game, game.some(3, 12));
  add_stars(game, game.some(1, 5), true);
}

/// Faces, then the same faces again, some turned over, and some that lie in the same planes.
void coincident_faces(SceneGame& game) {
  const int count = game.some(3, 12);
  for (int k = 0; k < count; ++k) {
    const Axes axes = any_axes(game);
    const Vec3 at = game.point(0.6);
    const auto figure = star(game, game.some(3, 6), false);
    const int copies = game.some(1, 3);
    for (int copy = 0; copy < copies; ++copy) {
      game.face(placed(figure, at, axes.u, axes.v));
    }
    if (game.chance(0.6)) {
      const double x = game.uniform(-0.5, 0.5), y = game.uniform(-0.5, 0.5);
      game.face(placed(star(game, 4, false), at + x * axes.u + y * axes.v, axes.u, axes.v));
    }
  }
}

/// Rings of boards, each over the next and under the one before.
void cyclic_overlap(SceneGame& game) {
  const int rings = game.some(1, 3);
  for (int ring = 0; ring < rings; ++ring) {
    const int boards = game.some(3, 8);
    const double lift = game.uniform(0.05, 0.4), breadth = game.uniform(0.05, 0.4);
    for (int k = 0; k < boards; ++k) {
      const double angle = 2 * M_PI * k / boards;
      const Vec3 out{std::cos(angle), std::sin(angle), 0}, along{-out.y, out.x, lift};
      game.face(placed({{-1.2, 0}, {1.2, 0}, {1.2, breadth}, {-1.2, breadth}},
                       0.5 * out + Vec3{0, 0, 0.3 * ring}, along, out));
    }
  }
  add_triangles(game, game.pick(5));
}

struct Kind {
  const char* name;
  void (*make)(SceneGame&);
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

/// Directions that see something edge-on, and one that does not.
std::vector<Vec3> nasty_directions(SceneGame& game, const SceneDescription& description) {
  std::vector<Vec3> directions;
  for (;;) {
    const double x = game.some(-1, 1), y = game.some(-1, 1), z = game.some(-1, 1);
    if (x == 0 && y == 0 && z == 0) {
      continue;
    }
    directions.push_back(normalized({x, y, z}));
    break;
  }
  const auto outline = description.outline(
      static_cast<std::size_t>(game.pick(static_cast<int>(description.face_count()))));
  const auto corner = [&](std::size_t k) {
    return at(description.points, outline[k % outline.size()]);
  };
  const auto k = static_cast<std::size_t>(game.pick(static_cast<int>(outline.size())));
  const Vec3 edge = normalized(corner(k + 1) - corner(k));
  directions.push_back(edge);
  directions.push_back(normalized(corner(k + 2) - corner(k) + game.uniform() * edge));
  directions.push_back(game.unit());
  return directions;
}

}  // namespace

RandomScene random_scene(std::uint64_t seed) {
  SceneGame game(seed);
  const Kind& kind = kinds[seed % std::size(kinds)];
  kind.make(game);
  RandomScene scene;
  scene.kind = kind.name;
  scene.closed = game.closed;
  scene.options.two_sided = kind.two_sided;
  const double scale = game.chance(0.35) ? std::pow(10.0, game.some(-6, 6)) : 1;
  scene.description = moved(game.sketch().description(), [&](const Vec3& p) { return scale * p; });
  scene.description.name = "random scene " + std::to_string(seed) + ": " + scene.kind;
  scene.directions = nasty_directions(game, scene.description);
  return scene;
}

}  // namespace transillum::testing
