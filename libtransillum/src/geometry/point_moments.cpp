// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// See point_moments.h. An edge runs from p to q along (tu, tv), with the outward normal (nu, nv) of
// a counter-clockwise polygon; its points are d (nu, nv) + t (tu, tv), and r² = 1 + d².
#include "geometry/point_moments.h"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace transillum {
namespace {

/// Integrals over a polygon, counter-clockwise.
struct Integrals {
  double w0 = 0;                        ///< integral of 1 / (1 + s²)²
  double w_u = 0, w_v = 0;              ///< integrals of u and v / (1 + s²)²
  double w_uu = 0, w_uv = 0, w_vv = 0;  ///< integrals of their products / (1 + s²)²
};

/// ln(1 + x) / x, x >= 0.
double log_ratio(double x) { return x > 1e-300 ? std::log1p(x) / x : 1; }

/// The integral of f from begin to end, by a Gauss rule.
template <unsigned points, class Function>
double gauss_integral(double begin, double end, Function f) {
  using Rule = boost::math::quadrature::gauss<double, points>;
  const double middle = (begin + end) / 2, half = (end - begin) / 2;
  double sum = 0;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    const double offset = half * Rule::abscissa()[k];
    const double values = offset == 0 ? f(middle) : f(middle - offset) + f(middle + offset);
    sum += Rule::weights()[k] * values;
  }
  return half * sum;
}

/// Integral of ln(1 + x) / x dt, x = d² + t², from t = begin to end. Its nearest singularities are
/// at t = ± i r. With t = r sinh y they are at y = ± i pi / 2, wherever the edge is.
double log_integral(double d, double r, double begin, double end) {
  constexpr double shortest = 0.25, longest = 1.5;
  if (end - begin < shortest * r) {
    return gauss_integral<5>(begin, end, [&](double t) { return log_ratio(d * d + t * t); });
  }
  const double y0 = std::asinh(begin / r), y1 = std::asinh(end / r);
  const int count = std::max(1, static_cast<int>(std::ceil((y1 - y0) / longest)));
  const double step = (y1 - y0) / count;
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    sum += gauss_integral<10>(y0 + k * step, y0 + (k + 1) * step, [&](double y) {
      const double sinh = std::sinh(y), t = r * sinh;
      return log_ratio(d * d + t * t) * r * std::sqrt(1 + sinh * sinh);
    });
  }
  return sum;
}

void add_edge(const PlaneRegion::Point& p, const PlaneRegion::Point& q, Integrals& sum) {
  const double du = q.u - p.u, dv = q.v - p.v, length = std::hypot(du, dv);
  if (length == 0) {
    return;
  }
  const double tu = du / length, tv = dv / length, nu = tv, nv = -tu;
  const double d = nu * p.u + nv * p.v, r = std::sqrt(1 + d * d);
  const double begin = tu * p.u + tv * p.v, end = begin + length;
  // Integrals of 1 and t over r² + t².
  const double i0 = std::atan2(length * r, r * r + begin * end) / r;
  const double i1 = 0.5 * std::log((r * r + end * end) / (r * r + begin * begin));
  sum.w0 += d * i0 / 2;
  sum.w_u -= nu * i0 / 2;
  sum.w_v -= nv * i0 / 2;
  const double plain = d * log_integral(d, r, begin, end) / 2;  // integral of 1 / (1 + s²)
  const double along_u = d * nu * i0 + tu * i1, along_v = d * nv * i0 + tv * i1;
  sum.w_uu += (plain - nu * along_u) / 2;
  sum.w_vv += (plain - nv * along_v) / 2;
  sum.w_uv -= (nu * along_v + nv * along_u) / 4;
}

}  // namespace

PointMoments point_moments(const Vec3& normal, std::span<const PlaneRegion::Point> polygon) {
  Integrals w;
  for (std::size_t k = polygon.size(); k-- > 0;) {
    add_edge(polygon[k + 1 < polygon.size() ? k + 1 : 0], polygon[k], w);
  }
  const double scale = 1 / std::numbers::pi;
  return {scale * (normal.z * w.w0 + normal.x * w.w_u + normal.y * w.w_v),
          scale * (normal.z * w.w_u + normal.x * w.w_uu + normal.y * w.w_uv),
          scale * (normal.z * w.w_v + normal.x * w.w_uv + normal.y * w.w_vv)};
}

}  // namespace transillum
