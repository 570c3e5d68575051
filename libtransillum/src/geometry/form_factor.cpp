// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// See form_factor.h. p and q are the two polygons.
#include "geometry/form_factor.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "geometry/edge_integral.h"

namespace transillum {
namespace {

constexpr double pi = std::numbers::pi;

/// A lower bound of the distance from x to the polygon.
double distance_bound(const Vec3& x, Outline polygon, const HalfSpace& before) {
  Bounds box;
  for (const Vec3& corner : polygon) {
    box.add(corner);
  }
  const auto outside = [](double low, double at, double high) {
    return std::max({low - at, at - high, 0.0});
  };
  const Vec3 gap{outside(box.low.x, x.x, box.high.x), outside(box.low.y, x.y, box.high.y),
                 outside(box.low.z, x.z, box.high.z)};
  return std::max(norm(gap), std::abs(before.distance(x)));
}

/// Gauss' rule on the unit interval: calls visit(abscissa, weight).
template <class Visit>
void for_gauss_points(Visit&& visit) {
  using Rule = boost::math::quadrature::gauss<double, 5>;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    const double x = Rule::abscissa()[k], weight = Rule::weights()[k] / 2;
    visit((1 + x) / 2, weight);
    if (x > 0) {
      visit((1 - x) / 2, weight);
    }
  }
}

/// Upper bound of the error of distances due to the rounding of coordinates.
double rounding_of(Outline p, Outline q) {
  double largest = 0;
  for (const Outline polygon : {p, q}) {
    for (const Vec3& corner : polygon) {
      largest = std::max({largest, max_abs(corner), max_abs(corner - p[0])});
    }
  }
  return 1e-14 * largest;
}

/// For a p that is small against its distance from q: the point form factor integrated over the
/// triangles of p from its first corner.
double exchange_of_small(Outline p, const Vec3& normal, Outline q) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    const Vec3 a = p[k] - p[0], b = p[k + 1] - p[0];
    const double twice_area = dot(cross(a, b), normal);
    for_gauss_points([&](double u, double weight_u) {
      for_gauss_points([&](double v, double weight_v) {
        const Vec3 x = p[0] + u * ((1 - v) * a + v * b);
        sum += twice_area * u * weight_u * weight_v * point_form_factor(x, normal, q);
      });
    });
  }
  return sum;
}

/// Terms of the closed form.
struct EdgeSum {
  double area = 0;
  double terms = 0;  ///< sum of the absolute values

  /// Whether less is left than half of the digits.
  bool cancels() const {
    constexpr double left = 1e-8;
    return area <= left * terms;
  }
};

EdgeSum exchange_by_edges(Outline p, Outline q) {
  EdgeSum sum;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Edge a(p[i], p[(i + 1) % p.size()]);
    for (std::size_t j = 0; j < q.size(); ++j) {
      const Edge b(q[j], q[(j + 1) % q.size()]);
      const double term = edge_pair_integral(a, b);
      sum.area += term;
      sum.terms += std::abs(term);
    }
  }
  sum.area /= 2 * pi;
  return sum;
}

/// exchange_of_small() for any p, in triangles divided until the integral does not change, or by
/// less than rounding.
double exchange_of_divided(Outline p, const Vec3& normal, Outline q, int most_divisions) {
  constexpr double converged = 1e-10, nothing = 1e-15;
  double sum = 0;
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    const Vec3 &a = p[0], &b = p[k], &c = p[k + 1];
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    const std::array<std::array<Vec3, 3>, 4> parts{
        {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    double divided = 0;
    for (const auto& part : parts) {
      divided += exchange_of_small(part, normal, q);
    }
    const double whole = exchange_of_small(std::array{a, b, c}, normal, q);
    const double tolerated =
        std::max(converged * std::abs(divided), nothing * norm(0.5 * cross(b - a, c - a)));
    if (most_divisions > 1 && std::abs(divided - whole) > tolerated) {
      divided = 0;
      for (const auto& part : parts) {
        divided += exchange_of_divided(part, normal, q, most_divisions - 1);
      }
    }
    sum += divided;
  }
  return sum;
}

}  // namespace

Vec3 middle_of(Outline polygon) {
  Vec3 sum;
  for (const Vec3& corner : polygon) {
    sum = sum + (corner - polygon[0]);
  }
  return polygon[0] + sum / static_cast<double>(polygon.size());
}

double radius_about(const Vec3& center, Outline polygon) {
  double radius = 0;
  for (const Vec3& corner : polygon) {
    radius = std::max(radius, norm(corner - center));
  }
  return radius;
}

Vec3 area_vector(Outline polygon) {
  Vec3 twice;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    twice = twice + cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  }
  return 0.5 * twice;
}

HalfSpace lit_half_space(Outline polygon) {
  const Vec3 normal = normalized(area_vector(polygon));
  return {normal, dot(normal, middle_of(polygon))};
}

Corners clipped(Outline polygon, const HalfSpace& space, double tolerance) {
  Corners kept;
  if (polygon.empty()) {
    return kept;
  }
  const auto distance_to = [&](const Vec3& x) {
    const double distance = space.distance(x);
    return std::abs(distance) <= tolerance ? 0.0 : distance;
  };
  Vec3 last = polygon.back();
  double last_distance = distance_to(last);
  for (const Vec3& corner : polygon) {
    const double distance = distance_to(corner);
    if ((last_distance > 0 && distance < 0) || (last_distance < 0 && distance > 0)) {
      kept.push_back(last + last_distance / (last_distance - distance) * (corner - last));
    }
    if (distance >= 0) {
      kept.push_back(corner);
    }
    last = corner;
    last_distance = distance;
  }
  if (kept.size() < 3) {
    kept.clear();
  }
  return kept;
}

double point_form_factor(const Vec3& x, const Vec3& normal, Outline polygon) {
  Corners above;
  for (const Vec3& corner : polygon) {
    above.push_back(corner - x);
  }
  if (std::any_of(above.begin(), above.end(), [&](const Vec3& r) { return dot(normal, r) < 0; })) {
    above = clipped(above, {normal, 0});
  }
  double sum = 0;
  for (std::size_t k = 0; k < above.size(); ++k) {
    const Vec3 &a = above[k], &b = above[k + 1 < above.size() ? k + 1 : 0];
    const Vec3 across = cross(a, b);
    const double sine = norm(across);
    // Seen from the receiving area the polygon's corners run clockwise.
    if (sine > 0) {
      sum -= std::atan2(sine, dot(a, b)) * dot(normal, across) / sine;
    }
  }
  return std::max(0.0, sum / (2 * pi));
}

FacingPolygons::FacingPolygons(Outline whole_p, Outline whole_q)
    : FacingPolygons(whole_p, whole_q, rounding_of(whole_p, whole_q)) {}

FacingPolygons::FacingPolygons(Outline whole_p, Outline whole_q, double tolerance)
    : FacingPolygons(whole_p, lit_half_space(whole_p), whole_q, lit_half_space(whole_q),
                     tolerance) {}

FacingPolygons::FacingPolygons(Outline whole_p, const HalfSpace& front_p, Outline whole_q,
                               const HalfSpace& front_q, double tolerance)
    : before_p(front_p), before_q(front_q) {
  const auto reaches_before = [tolerance](Outline polygon, const HalfSpace& space) {
    return std::any_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& x) { return space.distance(x) > tolerance; });
  };
  if (!reaches_before(whole_p, before_q) || !reaches_before(whole_q, before_p)) {
    return;
  }
  p = clipped(whole_p, before_q, tolerance);
  q = clipped(whole_q, before_p, tolerance);
}

double polygon_exchange(const FacingPolygons& facing, bool* integrated) {
  constexpr double small = 1.0 / 25;
  const auto set_integrated = [&](bool value) {
    if (integrated != nullptr) {
      *integrated = value;
    }
  };
  set_integrated(false);
  if (facing.empty()) {
    return 0;
  }
  const auto is_small = [](Outline a, Outline b, const HalfSpace& before_b) {
    const Vec3 center = middle_of(a);
    return radius_about(center, a) <= small * distance_bound(center, b, before_b);
  };
  const auto& [before_p, before_q, p, q] = facing;
  set_integrated(true);
  if (is_small(p, q, before_q)) {
    return exchange_of_small(p, before_p.normal, q);
  }
  if (is_small(q, p, before_p)) {
    return exchange_of_small(q, before_q.normal, p);
  }
  const EdgeSum by_edges = exchange_by_edges(p, q);
  if (by_edges.cancels()) {
    constexpr int most_divisions = 5;
    return norm(area_vector(p)) < norm(area_vector(q))
               ? exchange_of_divided(p, before_p.normal, q, most_divisions)
               : exchange_of_divided(q, before_q.normal, p, most_divisions);
  }
  set_integrated(false);
  return by_edges.area;
}

}  // namespace transillum
