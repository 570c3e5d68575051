// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner integral of polygon_exchange() (form_factor.h): ln r along two edges, in closed form
// where one exists (decisions/0020-exact-form-factors.md).
//
// Notation: s and t are the coordinates along the lines of edges a and b, measured from the points
// where the lines are nearest; h is the distance of the lines; then
//   r² = h² + s² + t² - 2 s t cos.
#include "geometry/edge_integral.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace transillum {
namespace {

/// The integral of ln sqrt(u² + h²) from u0 to u1.
double log_integral(double u0, double u1, double h) {
  const auto primitive = [h](double u) {
    const double square = u * u + h * h;
    if (square == 0) {
      return 0.0;
    }
    return u * (0.5 * std::log(square) - 1) + (h > 0 ? h * std::atan(u / h) : 0.0);
  };
  return primitive(u1) - primitive(u0);
}

/// The integral of ln r along edge b, r measured from a point.
double log_integral(const Vec3& point, const Edge& b) {
  const Vec3 to = b.begin - point;
  const double u = dot(to, b.direction);
  return log_integral(u, u + b.length, norm(cross(to, b.direction)));
}

/// A function whose second derivative is ln sqrt(u² + h²).
double second_log_integral(double u, double h) {
  const double square = u * u + h * h;
  if (square == 0) {
    return 0;
  }
  return 0.25 * (u * u - h * h) * std::log(square) - 0.75 * u * u +
         (h > 0 ? h * u * std::atan(u / h) : 0.0);
}

/// For parallel edges of the same direction.
double along_parallel(const Edge& a, const Edge& b) {
  const Vec3 to = b.begin - a.begin;
  const double u = dot(to, a.direction), h = norm(cross(to, a.direction));
  return second_log_integral(u + b.length, h) - second_log_integral(u + b.length - a.length, h) -
         second_log_integral(u, h) + second_log_integral(u - a.length, h);
}

/// The relative position of two edges that are not parallel.
struct Crossing {
  Crossing(const Edge& a, const Edge& b, double cosine_of, double sine_of)
      : cosine(cosine_of), sine(sine_of) {
    const Vec3 to = b.begin - a.begin;
    const Vec3 across = cross(a.direction, b.direction) / sine;
    s0 = -dot(cross(to, b.direction), across) / sine;
    t0 = -dot(cross(to, a.direction), across) / sine;
    h = std::abs(dot(to, across));
    s1 = s0 + a.length;
    t1 = t0 + b.length;
  }

  double cosine, sine;
  double s0, s1;  ///< ends of a
  double t0, t1;  ///< ends of b
  double h;       ///< distance of the lines
};

/// For lines that intersect. As div((s, t) ln r) = 2 ln r + 1, twice the integral is an integral
/// along the border of the rectangle of s and t minus the rectangle's area.
double along_meeting(const Crossing& c) {
  const auto side = [&](double at, double from, double to) {
    const double foot = at * c.cosine;
    return at * log_integral(from - foot, to - foot, std::abs(at) * c.sine);
  };
  const double border = side(c.s1, c.t0, c.t1) - side(c.s0, c.t0, c.t1) + side(c.t1, c.s0, c.s1) -
                        side(c.t0, c.s0, c.s1);
  return 0.5 * (border - (c.s1 - c.s0) * (c.t1 - c.t0));
}

/// For skew lines: Gauss' rule for the outer integral. The inner integral has singularities in the
/// complex s plane, where r is 0 at an end of b and at s = ± i h / sine. Half the length of an
/// interval is at most `reach` times the distance to the nearest of them.
struct SkewIntegral {
  const Edge& a;
  const Edge& b;
  const Crossing& c;
  double begin;   ///< coordinate of a.begin
  double offset;  ///< to be added to a coordinate for s

  double operator()(double from, double to) const {
    constexpr double reach = 0.6, least = 1e-13;
    using Rule = boost::math::quadrature::gauss<double, 16>;
    const double half = (to - from) / 2, middle = from + half;
    const Vec3 center = a.at(middle - begin);
    const double nearest = std::min(
        {norm(b.begin - center), norm(b.end - center), std::hypot(offset + middle, c.h / c.sine)});
    if (half > reach * nearest && half > least * a.length) {
      return (*this)(from, middle) + (*this)(middle, to);
    }
    double sum = 0;
    for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
      const Vec3 off = half * Rule::abscissa()[k] * a.direction;
      sum += Rule::weights()[k] * (log_integral(center + off, b) + log_integral(center - off, b));
    }
    return half * sum;
  }
};

double along_skew(const Edge& a, const Edge& b, const Crossing& c) {
  // So far from the intersection, s has too few digits for places on the edge.
  constexpr double far = 1e3;
  if (std::abs(c.s0) > far * a.length) {
    return SkewIntegral{a, b, c, 0, c.s0}(0, a.length);
  }
  return SkewIntegral{a, b, c, c.s0, 0}(c.s0, c.s1);
}

}  // namespace

double edge_pair_integral(const Edge& a, const Edge& b) {
  constexpr double negligible = 1e-15, parallel = 1e-12;
  if (a.length == 0 || b.length == 0) {
    return 0;
  }
  const double cosine = dot(a.direction, b.direction);
  if (std::abs(cosine) < negligible) {
    return 0;
  }
  const double sine = norm(cross(a.direction, b.direction));
  if (sine < parallel) {
    return cosine * along_parallel(a, cosine > 0 ? b : Edge(b.end, b.begin));
  }
  const Crossing c(a, b, cosine, sine);
  // Far from the intersection, the parts of the border integral cancel.
  constexpr double loss = 1e3;
  const double area = a.length * b.length;
  const double s = std::max(std::abs(c.s0), std::abs(c.s1));
  const double t = std::max(std::abs(c.t0), std::abs(c.t1));
  const bool meet = c.h * c.h <= negligible * sine * area && std::max(s * s, t * t) <= loss * area;
  return cosine * (meet ? along_meeting(c) : along_skew(a, b, c));
}

}  // namespace transillum
