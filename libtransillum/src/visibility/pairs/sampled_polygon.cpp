// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/sampled_polygon.h"

#include <algorithm>
#include <cmath>

namespace transillum {
namespace {

double distance_to(const Vec3& begin, const Vec3& end, const Vec3& x) {
  const Vec3 along = end - begin;
  const double square = dot(along, along);
  const double part = square > 0 ? std::clamp(dot(x - begin, along) / square, 0.0, 1.0) : 0;
  return norm(x - begin - part * along);
}

double distance_to(Outline polygon, const Vec3& x) {
  const HalfSpace front = lit_half_space(polygon);
  bool is_above = true;
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &begin = polygon[k], &end = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    is_above = is_above && dot(cross(front.normal, end - begin), x - begin) >= 0;
    nearest = std::min(nearest, distance_to(begin, end, x));
  }
  return is_above ? std::abs(front.distance(x)) : nearest;
}

/// To the nearest polygon; HUGE_VAL without any.
double distance_to(const std::vector<Corners>& polygons, const Vec3& x) {
  double nearest = HUGE_VAL;
  for (const Corners& polygon : polygons) {
    nearest = std::min(nearest, distance_to(Outline(polygon), x));
  }
  return nearest;
}

}  // namespace

/// Where two polygons and their blockers are.
struct SampledPolygon::Places {
  double radius_p, radius_q;
  double distance;        ///< from middle to middle
  double seen_p, seen_q;  ///< radius over the distance from the nearest blocker

  Places(const FacingPolygons& facing, double tolerance, const std::vector<Corners>& blockers) {
    const Vec3 p = middle_of(facing.p), q = middle_of(facing.q);
    radius_p = radius_about(p, facing.p);
    radius_q = radius_about(q, facing.q);
    distance = std::max(norm(p - q), tolerance);
    seen_p = radius_p / std::max(distance_to(blockers, p), tolerance);
    seen_q = radius_q / std::max(distance_to(blockers, q), tolerance);
  }
  bool is_p_sampled() const {
    // Compared with 1, 2 and 8, this has the least errors in rooms.
    constexpr double much = 4;
    return radius_p < radius_q ? seen_p <= much * seen_q : seen_q > much * seen_p;
  }
};

SampledPolygon::SampledPolygon(const FacingPolygons& facing, double tolerance,
                               const std::vector<Corners>& blockers)
    : SampledPolygon(facing, Places(facing, tolerance, blockers)) {}

SampledPolygon::SampledPolygon(const FacingPolygons& facing, const Places& places)
    : p_is_sampled(places.is_p_sampled()),
      polygon(p_is_sampled ? facing.p : facing.q),
      other(p_is_sampled ? facing.q : facing.p),
      normal((p_is_sampled ? facing.before_p : facing.before_q).normal),
      size((p_is_sampled ? places.radius_p : places.radius_q) / places.distance) {}

}  // namespace transillum
