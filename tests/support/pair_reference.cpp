// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The exchange of two polygons by adaptive quadrature, as a reference for ExchangeFinder. Input:
// corners as they are given to a scene.
#include "support/pair_reference.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <queue>
#include <span>

namespace transillum::testing {
namespace {

using Real = long double;

struct Vec {
  Real x = 0, y = 0, z = 0;
};
Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(Real s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
Real dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real norm(const Vec& a) { return std::sqrt(dot(a, a)); }

using Polygon = std::vector<Vec>;

Polygon polygon_of(const ConvexPolygon& corners) {
  Polygon polygon;
  for (const Vec3& c : corners) {
    polygon.push_back({c.x, c.y, c.z});
  }
  return polygon;
}

Vec area_vector(std::span<const Vec> polygon) {
  Vec twice;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    twice = twice + cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  }
  return 0.5L * twice;
}

/// The part of a polygon with normal·x >= offset.
Polygon clipped(const Polygon& polygon, const Vec& normal, Real offset) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Real at_a = dot(normal, a) - offset, at_b = dot(normal, b) - offset;
    if (at_a >= 0) {
      kept.push_back(a);
    }
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      kept.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
  }
  return kept.size() < 3 ? Polygon{} : kept;
}

/// Lambert's sum for a polygon above the horizon of the origin.
Real lambert(const Vec& normal, const Polygon& polygon) {
  Real sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Vec across = cross(a, b);
    if (const Real sine = norm(across); sine > 0) {
      sum -= std::atan2(sine, dot(a, b)) * dot(normal, across) / sine;
    }
  }
  return sum / (2 * std::numbers::pi_v<Real>);
}

/// Points (s, t, weight) of a triangle with corners (0,0), (1,0), (0,1), weights sum to 1.
template <unsigned points>
const std::vector<Vec>& triangle_rule() {
  static const std::vector<Vec> rule = [] {
    using Gauss = boost::math::quadrature::gauss<Real, points>;
    std::vector<std::pair<Real, Real>> line;
    for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k) {
      const Real x = Gauss::abscissa()[k], weight = Gauss::weights()[k] / 2;
      line.emplace_back((1 + x) / 2, weight);
      if (x > 0) {
        line.emplace_back((1 - x) / 2, weight);
      }
    }
    std::vector<Vec> product;
    for (const auto& [u, weight_u] : line) {
      for (const auto& [v, weight_v] : line) {
        product.push_back({u * (1 - v), u * v, 2 * u * weight_u * weight_v});
      }
    }
    return product;
  }();
  return rule;
}

/// The cosines over pi r² integrated over a polygon that is small against its distance, as seen
/// from the origin: Lambert's sum would cancel.
Real small_form_factor(const Vec& normal, const Polygon& polygon) {
  const Vec whole = area_vector(polygon);
  const Real square_of_area = dot(whole, whole);
  if (square_of_area == 0) {
    return 0;  // a cut has left a line
  }
  Real sum = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec a = polygon[k] - polygon[0], b = polygon[k + 1] - polygon[0];
    const Real area = dot(cross(a, b), whole) / 2;  // times |whole|
    for (const Vec& at : triangle_rule<7>()) {
      const Vec y = polygon[0] + at.x * a + at.y * b;
      const Real square = dot(y, y);
      sum += at.z * area * dot(normal, y) * -dot(whole, y) / (square * square);
    }
  }
  return sum / (std::numbers::pi_v<Real> * square_of_area);
}

/// The part of q that a point sees past blockers.
class View {
 public:
  View(const Polygon& p, Polygon q, const std::vector<Polygon>& blockers)
      : normal_(area_vector(p)), q_(std::move(q)) {
    normal_ = 1 / norm(normal_) * normal_;
    const Vec whole = area_vector(q_);
    front_ = 1 / norm(whole) * whole;
    offset_ = dot(front_, q_[0]);
    for (const Polygon& blocker : blockers) {
      Polygon before = clipped(blocker, front_, offset_);
      if (!before.empty()) {
        blockers_.push_back(std::move(before));
      }
    }
  }

  Real operator()(const Vec& x) const {
    if (dot(front_, x) <= offset_) {
      return 0;
    }
    const auto from_x = [&](const Polygon& polygon) {
      Polygon moved;
      for (const Vec& corner : polygon) {
        moved.push_back(corner - x);
      }
      return clipped(moved, normal_, 0);
    };
    const Polygon above = from_x(q_);
    if (above.empty()) {
      return 0;
    }
    std::vector<Polygon> hiding;
    for (const Polygon& blocker : blockers_) {
      hiding.push_back(with_distinct_corners(from_x(blocker)));
    }
    return visible(above, hiding, 0);
  }

 private:
  /// The form factor to a part of q, past the blockers from number `first` on.
  Real visible(const Polygon& part, const std::vector<Polygon>& hiding, std::size_t first) const {
    if (part.empty()) {
      return 0;
    }
    Real sum = form_factor(part);
    for (std::size_t k = first; k < hiding.size(); ++k) {
      sum -= visible(hidden_by(hiding[k], part), hiding, k + 1);
    }
    return sum;
  }

  static Polygon hidden_by(const Polygon& blocker, Polygon part) {
    const Real orientation = blocker.empty() ? 0 : dot(area_vector(blocker), blocker[0]);
    if (orientation == 0) {
      return {};
    }
    const Real sign = orientation > 0 ? 1 : -1;
    for (std::size_t k = 0; k < blocker.size() && !part.empty(); ++k) {
      part = clipped(part, sign * cross(blocker[k], blocker[(k + 1) % blocker.size()]), 0);
    }
    return part;
  }

  /// A polygon without corners in the line of sight of the one before: a cut at a corner leaves an
  /// edge of next to no length, whose plane is rounding. Empty if it is seen edge-on.
  static Polygon with_distinct_corners(const Polygon& polygon) {
    const auto same = [](const Vec& a, const Vec& b) {
      return norm(cross(a, b)) <= 1e-14L * norm(a) * norm(b);
    };
    Polygon distinct;
    for (const Vec& corner : polygon) {
      if (distinct.empty() || !same(distinct.back(), corner)) {
        distinct.push_back(corner);
      }
    }
    while (distinct.size() > 1 && same(distinct.back(), distinct.front())) {
      distinct.pop_back();
    }
    return distinct.size() < 3 ? Polygon{} : distinct;
  }

  Real form_factor(const Polygon& part) const {
    constexpr Real small = 1e-2;
    Real radius = 0;
    for (const Vec& corner : part) {
      radius = std::max(radius, norm(corner - part[0]));
    }
    return radius < small * norm(part[0]) ? small_form_factor(normal_, part)
                                          : lambert(normal_, part);
  }

  Vec normal_, front_;
  Polygon q_;
  Real offset_ = 0;
  std::vector<Polygon> blockers_;
};

/// A triangle of p with the integral over it.
struct Cell {
  std::array<Vec, 3> corners;
  Real value = 0, error = 0;

  bool operator<(const Cell& other) const { return error < other.error; }
};

Cell integrated(const std::array<Vec, 3>& corners, const View& view) {
  const Vec a = corners[1] - corners[0], b = corners[2] - corners[0];
  const Real area = norm(cross(a, b)) / 2;
  const auto by_rule = [&](const std::vector<Vec>& rule) {
    Real sum = 0;
    for (const Vec& at : rule) {
      sum += at.z * view(corners[0] + at.x * a + at.y * b);
    }
    return area * sum;
  };
  Cell part{corners};
  part.value = by_rule(triangle_rule<7>());
  part.error = std::abs(part.value - by_rule(triangle_rule<4>()));
  return part;
}

/// The halves of a triangle, cut across its longest side.
std::array<std::array<Vec, 3>, 2> halves(const std::array<Vec, 3>& t) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (norm(t[(k + 1) % 3] - t[k]) > norm(t[(longest + 1) % 3] - t[longest])) {
      longest = k;
    }
  }
  const Vec &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
  const Vec middle = 0.5L * (a + b);
  return {{{a, middle, c}, {middle, b, c}}};
}

}  // namespace

ReferenceExchange reference_exchange(const ConvexPolygon& p, const ConvexPolygon& q,
                                     const std::vector<ConvexPolygon>& blockers, double relative,
                                     double absolute, int most_parts) {
  const Polygon of_p = polygon_of(p);
  std::vector<Polygon> hiding;
  for (const ConvexPolygon& blocker : blockers) {
    hiding.push_back(polygon_of(blocker));
  }
  const View view(of_p, polygon_of(q), hiding);
  // The cut by the plane of q is a kink.
  const Vec front = area_vector(polygon_of(q));
  const Polygon before = clipped(of_p, front, dot(front, polygon_of(q)[0]));
  std::priority_queue<Cell> cells;
  Real value = 0, error = 0;
  const auto add = [&](const std::array<Vec, 3>& corners) {
    const Cell part = integrated(corners, view);
    value += part.value;
    error += part.error;
    cells.push(part);
  };
  for (std::size_t k = 1; k + 1 < before.size(); ++k) {
    add({before[0], before[k], before[k + 1]});
  }
  const auto is_reached = [&] {
    return error <= std::max<Real>(absolute, relative * std::abs(value));
  };
  while (!is_reached() && static_cast<int>(cells.size()) < most_parts) {
    const Cell worst = cells.top();
    cells.pop();
    value -= worst.value;
    error -= worst.error;
    for (const auto& half : halves(worst.corners)) {
      add(half);
    }
  }
  return {static_cast<double>(value), static_cast<double>(error), is_reached()};
}

}  // namespace transillum::testing
