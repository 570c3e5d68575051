// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/rational.hpp>
#include <cstdint>
#include <vector>

namespace transillum::fuzz {

/// Every corner made by clipping is the intersection of the lines of two input edges, so on a small
/// grid its fractions fit into 64 bits (UBSan would report an overflow).
using Rational = boost::rational<std::int64_t>;

struct ExactPoint {
  Rational x, y;
};
/// A convex polygon, counter-clockwise.
using ExactPolygon = std::vector<ExactPoint>;

/// Twice the signed area of a, b, p.
inline Rational turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The parts of a polygon on both sides of a line. They may have fewer than three corners.
struct ExactHalves {
  ExactPolygon left, right;
};
inline ExactHalves halves(const ExactPolygon& polygon, const ExactPoint& a, const ExactPoint& b) {
  ExactHalves result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ExactPoint &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Rational here = turn(a, b, p), there = turn(a, b, q);
    if (here >= 0) {
      result.left.push_back(p);
    }
    if (here <= 0) {
      result.right.push_back(p);
    }
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
      const Rational t = here / (here - there);
      const ExactPoint crossing{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
      result.left.push_back(crossing);
      result.right.push_back(crossing);
    }
  }
  return result;
}

/// Each triangle of the fan is computed exactly and rounded once, since the denominator of their
/// exact sum could overflow.
inline long double area_of(const ExactPolygon& polygon) {
  long double twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    twice += boost::rational_cast<long double>(turn(polygon[0], polygon[k - 1], polygon[k]));
  }
  return twice / 2;
}

/// The part of `polygon` inside `window`, by Sutherland and Hodgman; parts outside are added to
/// `outside`.
inline ExactPolygon clip(ExactPolygon polygon, const ExactPolygon& window,
                         std::vector<ExactPolygon>& outside) {
  for (std::size_t k = 0; k < window.size() && !polygon.empty(); ++k) {
    ExactHalves cut = halves(polygon, window[k], window[(k + 1) % window.size()]);
    if (area_of(cut.right) > 0) {
      outside.push_back(std::move(cut.right));
    }
    polygon = std::move(cut.left);
  }
  return polygon;
}

}  // namespace transillum::fuzz
