// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Built-in scenes furnace, boards, stars and flatland.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/built_in/built_in_makers.h"

namespace transillum {
namespace {

using std::numbers::pi;

SceneMaker::Block upright(const Vec3& corner, const Vec3& size) {
  return {corner, {size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}};
}

/// Board k of the ring: its center is `radius` from the ring's axis, and it rises along its length.
SceneMaker::Block board(int k, int n, const Vec3& middle) {
  constexpr double radius = 0.8, rise = 0.12, thickness = 0.04;
  const double angle = 2 * pi * k / n;
  const double crossing =
      radius * std::tan(pi / n);  // from its center to where it crosses the next
  const double half_length = 1.5 * crossing;
  const double breadth = std::min(0.35 * crossing, 0.3);
  const Vec3 out{std::cos(angle), std::sin(angle), 0};
  const Vec3 along = normalized(Vec3{-std::sin(angle), std::cos(angle), rise / crossing});
  const Vec3 up = cross(out, along);
  const Vec3 corner =
      middle + (radius - breadth / 2) * out - half_length * along - (thickness / 2) * up;
  return {corner, breadth * out, 2 * half_length * along, thickness * up};
}

void add_octahedron(SceneMaker& maker, const Vec3& center, double radius, int material) {
  const auto tip = [&](int axis, int sign) {
    Vec3 p = center;
    (axis == 0 ? p.x : axis == 1 ? p.y : p.z) += sign * radius;
    return maker.point(p);
  };
  for (const int x : {1, -1}) {
    for (const int y : {1, -1}) {
      for (const int z : {1, -1}) {
        std::vector<PointId> outline{tip(0, x), tip(1, y), tip(2, z)};
        if (x * y * z < 0) {
          std::swap(outline[0], outline[1]);
        }
        maker.face(outline, material);
      }
    }
  }
}

/// The fractional part of x: multiples of an irrational number are evenly distributed (Kronecker).
double fraction(double x) { return x - std::floor(x); }

}  // namespace

void make_furnace(SceneMaker& maker, const ParameterValues&, const Cancellation&) {
  const int glowing = maker.material("glowing", {0.5, 0.5, 0.5}, {1, 1, 1});
  maker.block(upright({0, 0, 0}, {2, 2, 2}), SceneMaker::Facing::inward, glowing);
  maker.block(upright({0.5, 0.75, 0.625}, {0.75, 0.5, 1}), SceneMaker::Facing::outward, glowing);
}

void make_boards(SceneMaker& maker, const ParameterValues& values, const Cancellation&) {
  const int white = maker.material("white", {0.7, 0.7, 0.7});
  const int wood = maker.material("wood", {0.55, 0.4, 0.25});
  const int light = maker.material("light", {0.5, 0.5, 0.5}, {20, 18, 15});
  const SceneMaker::Block room = upright({-2.5, -2.5, 0}, {5, 5, 3});
  maker.walls(room, SceneMaker::Facing::inward, white);
  maker.face(std::vector<Vec3>{{-2.5, -2.5, 0}, {2.5, -2.5, 0}, {2.5, 2.5, 0}, {-2.5, 2.5, 0}},
             white);
  maker.lit_ceiling({-2.5, 2.5, -2.5, 2.5}, {-0.5, 0.5, -0.5, 0.5}, 3, white, light);
  const int n = values["n"];
  for (int k = 0; k < n; ++k) {
    maker.block(board(k, n, {0, 0, 1.25}), SceneMaker::Facing::outward, wood);
  }
}

void make_flatland(SceneMaker& maker, const ParameterValues&, const Cancellation&) {
  const int white = maker.material("white", {0.7, 0.7, 0.7});
  const int wood = maker.material("wood", {0.55, 0.4, 0.25});
  const int light = maker.material("light", {0.5, 0.5, 0.5}, {10, 9, 8});
  const int black = maker.material("black", {});
  constexpr double length = 6, depth = 1, height = 4;
  // A plate from x0 to x1 at height z; seen from above if `up`.
  const auto plate = [&](double x0, double x1, double z, bool up, int material) {
    std::vector<Vec3> outline{{x0, 0, z}, {x1, 0, z}, {x1, depth, z}, {x0, depth, z}};
    if (!up) {
      std::reverse(outline.begin(), outline.end());
    }
    maker.face(outline, material);
  };
  plate(0, length, 0, true, white);
  maker.face(std::vector<Vec3>{{0, 0, 0}, {0, depth, 0}, {0, depth, height}, {0, 0, height}},
             white);
  maker.face(
      std::vector<Vec3>{
          {length, 0, 0}, {length, 0, height}, {length, depth, height}, {length, depth, 0}},
      white);
  plate(0, 3, height, false, white);
  plate(3, 5, height, false, light);
  plate(5, length, height, false, white);
  constexpr double thickness = 0.2;
  for (const Vec3& board : {Vec3{2, 4, 2.5}, Vec3{1, 3, 1}}) {  // from x to y, its bottom at z
    const double bottom = board.z, top = board.z + thickness;
    plate(board.x, board.y, top, true, wood);
    plate(board.x, board.y, bottom, false, wood);
    maker.face(std::vector<Vec3>{{board.x, 0, bottom},
                                 {board.x, 0, top},
                                 {board.x, depth, top},
                                 {board.x, depth, bottom}},
               wood);
    maker.face(std::vector<Vec3>{{board.y, 0, bottom},
                                 {board.y, depth, bottom},
                                 {board.y, depth, top},
                                 {board.y, 0, top}},
               wood);
  }
  maker.face(std::vector<Vec3>{{0, 0, 0}, {0, 0, height}, {length, 0, height}, {length, 0, 0}},
             black);
  maker.face(
      std::vector<Vec3>{
          {0, depth, 0}, {length, depth, 0}, {length, depth, height}, {0, depth, height}},
      black);
}

void make_stars(SceneMaker& maker, const ParameterValues& values, const Cancellation&) {
  const int white = maker.material("white", {0.6, 0.6, 0.6});
  const int blue = maker.material("blue", {0.2, 0.3, 0.5});
  const int star = maker.material("star", {0.1, 0.1, 0.1}, {400, 380, 320});
  const std::vector<SceneMaker::Block> blocks{upright({0.75, 0.875, 0}, {0.5, 0.625, 1.25}),
                                              upright({2.5, 0.625, 0}, {0.875, 0.5, 0.75}),
                                              upright({1.875, 2.375, 0}, {0.625, 0.75, 1})};
  maker.walls(upright({0, 0, 0}, {4, 4, 3}), SceneMaker::Facing::inward, white);
  maker.face(std::vector<Vec3>{{0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}}, white);
  maker.floor({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, blocks, white);
  for (const SceneMaker::Block& block : blocks) {
    maker.standing_block(block, blue);
  }
  const int n = values["n"];
  const double radius = std::min(0.02, 0.1 / std::cbrt(n));
  for (int i = 0; i < n; ++i) {
    // Above the blocks; the three-dimensional analog of the golden ratio keeps them apart.
    const double step = 1.22074408460575947536;
    const Vec3 p{0.25 + 3.5 * fraction((i + 0.5) / step),
                 0.25 + 3.5 * fraction((i + 0.5) / (step * step)),
                 1.5 + 1.25 * fraction((i + 0.5) / (step * step * step))};
    add_octahedron(maker, p, radius, star);
  }
}

}  // namespace transillum
