// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/adaptive_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace transillum {
namespace {

/// The halves of a triangle, on both sides of the middle of its longest edge.
std::array<std::array<Vec3, 3>, 2> halves_of(const std::array<Vec3, 3>& triangle) {
  std::size_t first = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = triangle[(k + 1) % 3] - triangle[k];
    if (dot(edge, edge) > longest) {
      longest = dot(edge, edge);
      first = k;
    }
  }
  const Vec3 &a = triangle[first], &b = triangle[(first + 1) % 3], &c = triangle[(first + 2) % 3];
  const Vec3 middle = 0.5 * (a + b);
  return {{{c, a, middle}, {b, c, middle}}};
}

}  // namespace

double AdaptivePoints::operator()(Outline polygon, int divisions) {
  constexpr std::size_t most_triangles = 4096;
  constexpr int most_rounds = 24;
  // With smooth functions, the rule of three points has a far smaller error than the rule of
  // corners.
  constexpr double doubt_per_error = 8;
  triangles_.clear();
  const int bisections = static_cast<int>(std::lround(2 * std::log2(std::max(divisions, 1))));
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    add({polygon[0], polygon[k], polygon[k + 1]}, bisections);
  }
  // Points and corners may agree by chance.
  for (std::size_t k = triangles_.size(); k-- > 0;) {
    divide(k);
  }
  for (int round = 0;; ++round) {
    double seen = 0, doubt = 0;
    for (const Triangle& each : triangles_) {
      seen += each.seen;
      doubt += each.doubt;
    }
    if (round == most_rounds || triangles_.size() > most_triangles ||
        doubt <= doubt_per_error * tolerated_(seen)) {
      return seen;
    }
    divide_doubtful(doubt);
  }
}

void AdaptivePoints::add(const std::array<Vec3, 3>& triangle, int bisections) {
  if (bisections > 0) {
    for (const auto& half : halves_of(triangle)) {
      add(half, bisections - 1);
    }
    return;
  }
  const Seen seen = see_(triangle);
  triangles_.push_back({triangle, seen.by_points, std::abs(seen.by_points - seen.by_corners)});
}

/// Replaces a triangle by its halves. Their doubt is at least the change that dividing it has made.
void AdaptivePoints::divide(std::size_t number) {
  const Triangle whole = triangles_[number];
  const auto halves = halves_of(whole.corners);
  add(halves[0], 0);
  triangles_[number] = triangles_.back();
  triangles_.pop_back();
  add(halves[1], 0);
  Triangle &a = triangles_[number], &b = triangles_.back();
  const double change = std::abs(a.seen + b.seen - whole.seen) / 2;
  a.doubt = std::max(a.doubt, change);
  b.doubt = std::max(b.doubt, change);
}

/// Divides the triangles that most of the doubt is about.
/// @param doubt of all
void AdaptivePoints::divide_doubtful(double doubt) {
  constexpr double most = 0.75;
  std::vector<std::size_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return triangles_[a].doubt != triangles_[b].doubt ? triangles_[a].doubt > triangles_[b].doubt
                                                      : a < b;
  });
  double divided = 0;
  for (const std::size_t k : order) {
    if (divided >= most * doubt) {
      break;
    }
    divided += triangles_[k].doubt;
    divide(k);
  }
}

}  // namespace transillum
