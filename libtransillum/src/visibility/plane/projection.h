// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/visibility_map.h"
#include "visibility/plane/map_number.h"

namespace transillum {

/// A point of the transillumination plane.
template <class Number>
struct BasicPlanePoint {
  Number x{}, y{};

  friend BasicPlanePoint operator-(const BasicPlanePoint& a, const BasicPlanePoint& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend BasicPlanePoint operator+(const BasicPlanePoint& a, const BasicPlanePoint& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend Number cross(const BasicPlanePoint& a, const BasicPlanePoint& b) {
    return a.x * b.y - a.y * b.x;
  }
  /// The point at a + t (b - a).
  friend BasicPlanePoint between(const BasicPlanePoint& a, const BasicPlanePoint& b,
                                 const Number& t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }
};
using PlanePoint = BasicPlanePoint<Real>;

/// A line of the tree seen along the direction, as an oriented line of the plane.
template <class Number>
struct BasicPlaneLine {
  BasicPlanePoint<Number> origin, along;

  /// Twice the area of the triangle of `along` and p: > 0 if p lies left of the line.
  Number side(const BasicPlanePoint<Number>& p) const { return cross(along, p - origin); }
};
using PlaneLine = BasicPlaneLine<Real>;

/// All points and lines of a tree, projected along one direction.
///
/// Every point is projected once, and cut points are interpolated from projected ones, so that
/// points that coincide in space coincide here: bit for bit or to the last place. In exact numbers
/// every corner of a fragment also lies exactly on the lines of both its edges.
template <class Number>
class BasicProjection {
 public:
  PlaneFrame frame;
  std::vector<BasicPlanePoint<Number>> points;
  std::vector<BasicPlaneLine<Number>> lines;  ///< by LineId, from the line's a to its b

  /// @throws Canceled
  BasicProjection(const Scene& scene, const BspTree& tree, const Vec3& omega,
                  const Cancellation& cancellation = {})
      : frame(plane_frame(scene, omega)) {
    const auto check_cancellation = [&cancellation](std::size_t done) {
      if (done % 256 == 0) {
        cancellation.throw_if_canceled();
      }
    };
    points.reserve(tree.points().size());
    for (const Vec3& p : scene.points()) {
      check_cancellation(points.size());
      points.push_back({along(frame.u, p), along(frame.v, p)});
    }
    for (const BspTree::CutPoint& cut : tree.cut_points()) {
      check_cancellation(points.size());
      points.push_back(between(point(cut.a), point(cut.b), static_cast<Number>(cut.t)));
    }
    lines.reserve(tree.lines().size());
    for (const BspTree::Line& line : tree.lines()) {
      check_cancellation(lines.size());
      const BasicPlanePoint<Number>& a = point(line.a);
      lines.push_back({a, point(line.b) - a});
    }
  }

  const BasicPlanePoint<Number>& point(PointId p) const { return at(points, p); }
  /// A point of space, projected as the others.
  BasicPlanePoint<Number> project(const Vec3& p) const {
    return {along(frame.u, p), along(frame.v, p)};
  }
  const BasicPlaneLine<Number>& line(LineId l) const { return at(lines, l); }

 private:
  Number along(const Vec3& axis, const Vec3& p) const {
    const auto product = [](double of_axis, double of_point, double of_origin) {
      return static_cast<Number>(of_axis) *
             (static_cast<Number>(of_point) - static_cast<Number>(of_origin));
    };
    return product(axis.x, p.x, frame.origin.x) + product(axis.y, p.y, frame.origin.y) +
           product(axis.z, p.z, frame.origin.z);
  }
};
using Projection = BasicProjection<Real>;

}  // namespace transillum
