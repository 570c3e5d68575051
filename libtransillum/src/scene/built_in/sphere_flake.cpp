// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Built-in scene `sphere-flake`: a sphere with 12 spheres of a third of its size on it, 11 on each
// of those, and so on, inside an emitting sky sphere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/built_in/built_in_makers.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using std::numbers::pi;
constexpr double child_size = 1.0 / 3;
constexpr double sky_radius = 3;
constexpr int sky_slices = 32, sky_stacks = 8;
constexpr std::int64_t max_faces = 50'000'000;

struct Ball {
  Vec3 center;
  double radius;
  Vec3 u, v, axis;  // right-handed, orthonormal; the axis points away from the parent
};

Vec3 point_of(const Ball& ball, double latitude_from_pole, double longitude) {
  const double s = std::sin(latitude_from_pole);
  return s * std::cos(longitude) * ball.u + s * std::sin(longitude) * ball.v +
         std::cos(latitude_from_pole) * ball.axis;
}

/// Points of a latitude-longitude sphere; each pole is one point.
class BallPoints {
 public:
  BallPoints(SceneMaker& maker, const Ball& ball, int slices, int stacks) : slices_(slices) {
    for (int j = 0; j <= stacks; ++j) {
      for (int i = 0; i < slices; ++i) {
        const bool pole = j == 0 || j == stacks;
        if (pole && i > 0) {
          points_.push_back(points_.back());
          continue;
        }
        const Vec3 direction = pole ? (j == 0 ? ball.axis : -ball.axis)
                                    : point_of(ball, pi * j / stacks, 2 * pi * i / slices);
        points_.push_back(maker.point(ball.center + ball.radius * direction));
      }
    }
  }
  PointId point(int stack, int slice) const {
    return at(points_, stack * slices_ + slice % slices_);
  }

 private:
  int slices_;
  std::vector<PointId> points_;
};

/// Corners of one face, counter-clockwise from outside; three if it touches a pole.
std::vector<PointId> face_of(const BallPoints& points, int stack, int slice, int stacks) {
  std::vector<PointId> outline{points.point(stack, slice), points.point(stack + 1, slice)};
  if (stack + 1 < stacks) {
    outline.push_back(points.point(stack + 1, slice + 1));
  }
  if (stack > 0) {
    outline.push_back(points.point(stack, slice + 1));
  }
  return outline;
}

void add_ball(SceneMaker& maker, const Ball& ball, int slices, int stacks, int material) {
  const BallPoints points(maker, ball, slices, stacks);
  for (int j = 0; j < stacks; ++j) {
    for (int i = 0; i < slices; ++i) {
      maker.face(face_of(points, j, i, stacks), material);
    }
  }
}

void add_sky(SceneMaker& maker) {
  const int warm = maker.material("warm-sky", {}, {1.2, 0.85, 0.5});
  const int cool = maker.material("cool-sky", {}, {0.35, 0.55, 1.0});
  const Ball sky{{}, sky_radius, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const BallPoints points(maker, sky, sky_slices, sky_stacks);
  for (int j = 0; j < sky_stacks; ++j) {
    for (int i = 0; i < sky_slices; ++i) {
      std::vector<PointId> outline = face_of(points, j, i, sky_stacks);
      std::reverse(outline.begin(), outline.end());
      maker.face(outline, i < sky_slices / 2 ? warm : cool);
    }
  }
}

Ball child_of(const Ball& parent, const Vec3& direction) {
  Ball child;
  child.radius = child_size * parent.radius;
  child.center = parent.center + (parent.radius + child.radius) * direction;
  child.axis = direction;
  const Vec3 side = cross(parent.axis, direction);
  child.u = norm(side) > 1e-6 ? normalized(side) : parent.u;
  child.v = cross(child.axis, child.u);
  return child;
}

/// Directions to the corners of an icosahedron about the ball's axis; the last points to the
/// parent.
std::vector<Vec3> icosahedron(const Ball& ball) {
  const double ring = std::atan(2.0);  // angle between neighboring corners
  std::vector<Vec3> directions{ball.axis};
  for (int i = 0; i < 5; ++i) {
    directions.push_back(point_of(ball, ring, 2 * pi * i / 5));
  }
  for (int i = 0; i < 5; ++i) {
    directions.push_back(point_of(ball, pi - ring, 2 * pi * (i + 0.5) / 5));
  }
  directions.push_back(-ball.axis);
  return directions;
}

std::int64_t ball_count(int levels) {
  std::int64_t count = 1, generation = 12;
  for (int l = 0; l < levels; ++l, generation *= 11) {
    count += generation;
  }
  return count;
}

}  // namespace

void make_sphere_flake(SceneMaker& maker, const ParameterValues& values,
                       const Cancellation& cancellation) {
  const int levels = values["levels"], slices = values["slices"], stacks = values["stacks"];
  const std::int64_t faces = ball_count(levels) * slices * stacks;
  if (faces > max_faces) {
    throw InputError(
        fmt::format("sphere-flake: {} faces exceed the limit of {}", faces, max_faces));
  }
  const int gray = maker.material("gray", {0.6, 0.6, 0.6});
  std::vector<Ball> generation{{{}, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int level = 0;; ++level) {
    std::vector<Ball> next;
    for (const Ball& ball : generation) {
      cancellation.throw_if_canceled();
      add_ball(maker, ball, slices, stacks, gray);
      if (level == levels) {
        continue;
      }
      std::vector<Vec3> directions = icosahedron(ball);
      if (level > 0) {
        directions.pop_back();
      }
      for (const Vec3& d : directions) {
        next.push_back(child_of(ball, d));
      }
    }
    if (level == levels) {
      break;
    }
    generation = std::move(next);
  }
  add_sky(maker);
}

}  // namespace transillum
