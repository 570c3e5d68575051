// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/edit/face_placement.h"

#include <array>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

/// Rows of a matrix.
using Matrix = std::array<Vec3, 3>;

/// Cosine and sine, exact at multiples of 90 degrees.
std::array<double, 2> cosine_and_sine(double degrees) {
  const double quarters = std::nearbyint(degrees / 90);
  const double rest = (degrees - 90 * quarters) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(std::fmod(quarters, 4) + 4) % 4) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

Vec3 about_axis(const Vec3& v, int axis, double degrees) {
  if (degrees == 0) {
    return v;
  }
  const auto [c, s] = cosine_and_sine(degrees);
  const int b = (axis + 1) % 3, d = (axis + 2) % 3;
  Vec3 out = v;
  coordinate(out, b) = c * coordinate(v, b) - s * coordinate(v, d);
  coordinate(out, d) = s * coordinate(v, b) + c * coordinate(v, d);
  return out;
}

double in_degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// The angles of a rotation Rz Ry Rx whose columns are the images of the axes.
Vec3 angles_of(const Matrix& columns) {
  const double sine = -columns[0].z;
  const double cosine = std::hypot(columns[0].x, columns[0].y);
  constexpr double locked = 1e-12;
  if (cosine < locked) {  // x and z turn about the same line: all of it is given to x
    const double sign = sine > 0 ? 1 : -1;
    return {in_degrees(std::atan2(sign * columns[1].x, columns[1].y)), sign * 90, 0};
  }
  return {in_degrees(std::atan2(columns[1].z, columns[2].z)), in_degrees(std::atan2(sine, cosine)),
          in_degrees(std::atan2(columns[0].y, columns[0].x))};
}

}  // namespace

Vec3 unit_of_axis(int axis) {
  return {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
}

double& coordinate(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

double coordinate(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 turned(const Vec3& v, const Vec3& turn) {
  return about_axis(about_axis(about_axis(v, 0, turn.x), 1, turn.y), 2, turn.z);
}

Vec3 turned_further(const Vec3& turn, int axis, double degrees) {
  Matrix columns;
  for (int k = 0; k < 3; ++k) {
    columns[static_cast<std::size_t>(k)] = about_axis(turned(unit_of_axis(k), turn), axis, degrees);
  }
  return angles_of(columns);
}

Vec3 placed(const Vec3& point, const Vec3& pivot, const FacePlacement& placement) {
  if (placement.turn == Vec3{} && placement.scale == Vec3{1, 1, 1}) {
    return point + placement.move;
  }
  const Vec3 arm = point - pivot;
  const Vec3 scaled{placement.scale.x * arm.x, placement.scale.y * arm.y,
                    placement.scale.z * arm.z};
  return pivot + placement.move + turned(scaled, placement.turn);
}

}  // namespace transillum
