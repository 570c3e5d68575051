// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/exact_side.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace transillum {
namespace {

using boost::multiprecision::int256_t;

/// a x + b y + c = twice the area of the triangle of the line's points and (x, y). With
/// coordinates of 60 bits, a and b take 61 and c 123, and a determinant of three lines 248.
struct Coefficients {
  std::int64_t a, b;
  WideInteger c;

  explicit Coefficients(const GridLine& line)
      : a(line.a.y - line.b.y),
        b(line.b.x - line.a.x),
        c(-(static_cast<WideInteger>(a) * line.a.x + static_cast<WideInteger>(b) * line.a.y)) {}
};

/// The point where two lines meet, in homogeneous coordinates.
struct HomogeneousPoint {
  int256_t x, y;
  WideInteger w;

  HomogeneousPoint(const Coefficients& m, const Coefficients& n)
      : x(int256_t(n.c) * m.b - int256_t(m.c) * n.b),
        y(int256_t(m.c) * n.a - int256_t(n.c) * m.a),
        w(static_cast<WideInteger>(m.a) * n.b - static_cast<WideInteger>(n.a) * m.b) {}
};

GridPoint moved(const GridPoint& p, const GridPoint& origin) {
  return {p.x - origin.x, p.y - origin.y};
}

}  // namespace

long double exact_side(const GridLine& line, const GridPoint& p) {
  return static_cast<long double>(exact_turn(line.a, line.b, p));
}

long double exact_side(const GridLine& line, const GridLine& p, const GridLine& q) {
  const Coefficients l(line);
  const HomogeneousPoint point{Coefficients(p), Coefficients(q)};
  if (point.w == 0) {
    return 0;
  }
  const int256_t value = point.x * l.a + point.y * l.b + int256_t(point.w) * int256_t(l.c);
  return value.convert_to<long double>() / static_cast<long double>(point.w);
}

Meeting exact_meeting(const GridLine& p, const GridLine& q, const GridPoint& origin) {
  const HomogeneousPoint point{Coefficients({moved(p.a, origin), moved(p.b, origin)}),
                               Coefficients({moved(q.a, origin), moved(q.b, origin)})};
  if (point.w == 0) {
    return {true, 0, 0};
  }
  const auto w = static_cast<long double>(point.w);
  return {false, point.x.convert_to<long double>() / w, point.y.convert_to<long double>() / w};
}

}  // namespace transillum
