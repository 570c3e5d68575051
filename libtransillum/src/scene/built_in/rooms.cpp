// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Built-in scene `rooms`: a row of equal rooms with doorways between them, a light in each ceiling,
// and boxes on the floors.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/built_in/built_in_makers.h"

namespace transillum {
namespace {

constexpr double length = 4, width = 5, height = 2.75;         // size of a room
constexpr double partition = 0.25;                             // thickness between two rooms
constexpr double door_left = 2, door_right = 3, door_top = 2;  // in a partition

struct Materials {
  int wall, floor, ceiling, light, red, blue;
};

double left_end(int room) { return room * (length + partition); }

/// A wall with a doorway at x, facing -x: one concave polygon.
std::vector<Vec3> doorway_wall(double x) {
  return {{x, 0, 0},
          {x, 0, height},
          {x, width, height},
          {x, width, 0},
          {x, door_right, 0},
          {x, door_right, door_top},
          {x, door_left, door_top},
          {x, door_left, 0}};
}

std::vector<Vec3> blank_wall(double x) {
  return {{x, 0, 0}, {x, 0, height}, {x, width, height}, {x, width, 0}};
}

std::vector<Vec3> reversed(std::vector<Vec3> outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

/// The floor has the corners of the doorways too, so no T-junctions form along them.
std::vector<Vec3> floor_outline(double x0, double x1, bool door_at_x0, bool door_at_x1) {
  std::vector<Vec3> outline{{x0, 0, 0}, {x1, 0, 0}};
  if (door_at_x1) {
    outline.insert(outline.end(), {{x1, door_left, 0}, {x1, door_right, 0}});
  }
  outline.insert(outline.end(), {{x1, width, 0}, {x0, width, 0}});
  if (door_at_x0) {
    outline.insert(outline.end(), {{x0, door_right, 0}, {x0, door_left, 0}});
  }
  return outline;
}

void add_room(SceneMaker& maker, int room, int rooms, const Materials& m) {
  const double x0 = left_end(room), x1 = x0 + length;
  const bool first = room == 0, last = room == rooms - 1;
  const double middle = (x0 + x1) / 2;
  maker.lit_ceiling({x0, x1, 0, width}, {middle - 0.5, middle + 0.5, 2, 3}, height, m.ceiling,
                    m.light);
  maker.face(std::vector<Vec3>{{x0, 0, 0}, {x0, 0, height}, {x1, 0, height}, {x1, 0, 0}}, m.wall);
  maker.face(
      std::vector<Vec3>{{x0, width, 0}, {x1, width, 0}, {x1, width, height}, {x0, width, height}},
      m.wall);
  maker.face(reversed(first ? blank_wall(x0) : doorway_wall(x0)), first ? m.red : m.wall);
  maker.face(last ? blank_wall(x1) : doorway_wall(x1), last ? m.blue : m.wall);
}

/// The passage through the partition between `room` and the next.
void add_passage(SceneMaker& maker, int room, const Materials& m) {
  const double x0 = left_end(room) + length, x1 = x0 + partition;
  const double l = door_left, r = door_right, t = door_top;
  maker.face(std::vector<Vec3>{{x0, l, 0}, {x1, l, 0}, {x1, r, 0}, {x0, r, 0}}, m.floor);
  maker.face(std::vector<Vec3>{{x0, l, t}, {x0, r, t}, {x1, r, t}, {x1, l, t}}, m.wall);
  maker.face(std::vector<Vec3>{{x0, l, 0}, {x0, l, t}, {x1, l, t}, {x1, l, 0}}, m.wall);
  maker.face(std::vector<Vec3>{{x0, r, 0}, {x1, r, 0}, {x1, r, t}, {x0, r, t}}, m.wall);
}

/// In [0,1); the same on every machine, unlike the distributions of the standard library.
double unit_random(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// A box rotated about the vertical, within a square cell of the floor.
SceneMaker::Block random_box(std::mt19937& random, const Vec3& middle, double cell) {
  const double reach = 0.45 * cell;  // from the middle to a corner, at most
  const double turn = 2 * std::numbers::pi * unit_random(random);
  const double shape = std::numbers::pi / 8 * (1 + 2 * unit_random(random));
  const Vec3 ahead{std::cos(turn), std::sin(turn), 0};
  const Vec3 side{-std::sin(turn), std::cos(turn), 0};
  const double half_a = reach * std::cos(shape), half_b = reach * std::sin(shape);
  const double tall = std::min(2.0, cell * (0.5 + 1.5 * unit_random(random)));
  return {
      middle - half_a * ahead - half_b * side, 2 * half_a * ahead, 2 * half_b * side, {0, 0, tall}};
}

/// The floor of a room and `count` boxes in rows, each on its own cell of the floor, so that only
/// this cell is cut around it.
void add_floor(SceneMaker& maker, int room, int rooms, int count, std::mt19937& random,
               const Materials& m) {
  const double x0 = left_end(room);
  if (count == 0) {
    maker.face(floor_outline(x0, x0 + length, room > 0, room + 1 < rooms), m.floor);
    return;
  }
  const int columns = static_cast<int>(std::ceil(std::sqrt(count * length / width)));
  const int rows = (count + columns - 1) / columns;
  const double cell = std::min(length / columns, width / rows);
  for (int i = 0; i < columns * rows; ++i) {
    const int column = i % columns, row = i / columns;
    const double left = x0 + length * column / columns,
                 right = x0 + length * (column + 1) / columns;
    const double near = width * row / rows, far = width * (row + 1) / rows;
    const std::vector<Vec3> outline{
        {left, near, 0}, {right, near, 0}, {right, far, 0}, {left, far, 0}};
    if (i >= count) {
      maker.face(outline, m.floor);
      continue;
    }
    const auto box = random_box(random, {(left + right) / 2, (near + far) / 2, 0}, cell);
    const double dice = unit_random(random);
    maker.floor(outline, {box}, m.floor);
    maker.standing_block(box, dice < 0.2 ? m.red : dice < 0.4 ? m.blue : m.wall);
  }
}

}  // namespace

void make_rooms(SceneMaker& maker, const ParameterValues& values,
                const Cancellation& cancellation) {
  const int rooms = values["rooms"], boxes = values["n"];
  Materials m{};
  m.wall = maker.material("wall", {0.7, 0.68, 0.65});
  m.floor = maker.material("floor", {0.45, 0.38, 0.3});
  m.ceiling = maker.material("ceiling", {0.75, 0.75, 0.75});
  m.light = maker.material("light", {0.5, 0.5, 0.5}, {15, 14, 12});
  m.red = maker.material("red", {0.6, 0.15, 0.1});
  m.blue = maker.material("blue", {0.1, 0.2, 0.6});
  std::mt19937 random(static_cast<std::uint32_t>(values["seed"]));
  for (int room = 0; room < rooms; ++room) {
    cancellation.throw_if_canceled();
    add_room(maker, room, rooms, m);
    if (room + 1 < rooms) {
      add_passage(maker, room, m);
    }
    add_floor(maker, room, rooms, boxes / rooms + (room < boxes % rooms ? 1 : 0), random, m);
  }
}

}  // namespace transillum
