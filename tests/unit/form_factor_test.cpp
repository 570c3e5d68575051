// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "geometry/form_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/edge_integral.h"
#include "support/scenes.h"

namespace transillum::form_factor_test {
namespace {

using Polygon = std::vector<Vec3>;
constexpr double pi = std::numbers::pi;
constexpr long double pi_l = std::numbers::pi_v<long double>;

double form_factor(const Polygon& p, const Polygon& q) {
  return polygon_exchange(p, q) / norm(area_vector(p));
}

Polygon rectangle(const Vec3& corner, const Vec3& x, const Vec3& y) {
  return {corner, corner + x, corner + x + y, corner + y};
}

/// Catalog (Howell C-11): equal rectangles x by y, `distance` apart.
double parallel_rectangles(long double x, long double y, long double distance) {
  x /= distance;
  y /= distance;
  const long double x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
  return static_cast<double>(2 / (pi_l * x * y) *
                             (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) +
                              x * y1 * std::atan(x / y1) + y * x1 * std::atan(y / x1) -
                              x * std::atan(x) - y * std::atan(y)));
}

/// Catalog (Howell C-14): from a rectangle `common` by w to one `common` by h, at right angles.
double perpendicular_rectangles(long double common, long double w, long double h) {
  w /= common;
  h /= common;
  const long double ww = w * w, hh = h * h, r = std::sqrt(ww + hh);
  return static_cast<double>(1 / (pi_l * w) *
                             (w * std::atan(1 / w) + h * std::atan(1 / h) - r * std::atan(1 / r) +
                              0.25 * (std::log((1 + ww) * (1 + hh) / (1 + ww + hh)) +
                                      ww * std::log(ww * (1 + ww + hh) / ((1 + ww) * (ww + hh))) +
                                      hh * std::log(hh * (1 + ww + hh) / ((1 + hh) * (ww + hh))))));
}

/// Sum of the form factors from the first polygon of a closed convex room to the others.
double row_sum(const std::vector<Polygon>& room) {
  double sum = 0;
  for (std::size_t j = 1; j < room.size(); ++j) {
    sum += form_factor(room[0], room[j]);
  }
  return sum;
}

/// Cuts a polygon in two by a plane through its middle.
void split(std::vector<Polygon>& polygons, std::size_t k, const Vec3& normal) {
  const Polygon whole = polygons[k];
  Vec3 middle;
  for (const Vec3& corner : whole) {
    middle = middle + corner / static_cast<double>(whole.size());
  }
  const HalfSpace space{normal, dot(normal, middle)};
  const Corners front = clipped(whole, space), back = clipped(whole, {-normal, -space.offset});
  polygons[k].assign(front.begin(), front.end());
  polygons.emplace_back(back.begin(), back.end());
}

TEST(PointFormFactor, OfARectangleOverItsCorner) {
  // Catalog (Howell B-3).
  const double a = 0.7, b = 1.9, c = 1.3, x = a / c, y = b / c;
  const double expected = 1 / (2 * pi) *
                          (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
                           y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)));
  const Polygon above = rectangle({0, 0, c}, {0, b, 0}, {a, 0, 0});
  EXPECT_NEAR(point_form_factor({0, 0, 0}, {0, 0, 1}, above), expected, 1e-15);
  EXPECT_EQ(point_form_factor({0, 0, 2 * c}, {0, 0, -1}, above), 0) << "behind";
  EXPECT_EQ(point_form_factor({0, 0, 0}, {0, 0, -1}, above), 0) << "below the horizon";
  // A concave case: an L over the corner is two rectangles minus one.
  const Polygon ell{{0, 0, c},     {0, b, c},         {a, b, c},
                    {a, b / 2, c}, {2 * a, b / 2, c}, {2 * a, 0, c}};
  EXPECT_NEAR(point_form_factor({0, 0, 0}, {0, 0, 1}, ell),
              expected + point_form_factor({0, 0, 0}, {0, 0, 1},
                                           rectangle({a, 0, c}, {0, b / 2, 0}, {a, 0, 0})),
              1e-15);
}

TEST(PointFormFactor, FromInsideAClosedBoxSumsToOneForAnyNormal) {
  testing::Sketch sketch;
  const auto box = sketch.box({0, 0, 0}, {1, 2, 3}, true, sketch.material(0, 0)).scene();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x{unit(random), 2 * unit(random), 3 * unit(random)};
    const Vec3 normal = normalized({gauss(random), gauss(random), gauss(random)});
    double sum = 0;
    for (PatchId i = 0; i < box->patch_count(); ++i) {
      Polygon side;
      for (const PointId p : box->outline(i)) {
        side.push_back(box->point(p));
      }
      sum += point_form_factor(x, normal, side);
    }
    EXPECT_NEAR(sum, 1, 1e-13);
  }
}

TEST(PolygonExchange, MatchesTheCatalog) {
  const Polygon floor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(form_factor(floor, rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0})), 0.1998248957, 5e-11);
  EXPECT_NEAR(form_factor(floor, rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1})), 0.2000437761, 5e-11);
  for (const double d : {0.01, 0.3, 1.0, 7.0, 19.0, 100.0}) {
    const Polygon low = rectangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0});
    const Polygon high = rectangle({0, 0, d}, {0, 3, 0}, {2, 0, 0});
    const double expected = parallel_rectangles(2, 3, d);
    EXPECT_NEAR(form_factor(low, high), expected, 2e-13) << d;
    EXPECT_EQ(form_factor(low, {high.rbegin(), high.rend()}), 0) << "a back";
  }
  for (const double w : {0.02, 0.5, 1.0, 30.0}) {
    for (const double h : {0.05, 1.0, 4.0}) {
      const Polygon lying = rectangle({0, 0, 0}, {w, 0, 0}, {0, 2, 0});
      const Polygon standing = rectangle({0, 0, 0}, {0, 2, 0}, {0, 0, h});
      const double expected = perpendicular_rectangles(2, w, h);
      EXPECT_NEAR(form_factor(lying, standing), expected, 1e-13) << w << " " << h;
      EXPECT_NEAR(polygon_exchange(standing, lying), 2 * w * expected, 1e-13 * (1 + w))
          << w << " " << h;
    }
  }
}

/// From inside a convex room, everything visible belongs to the room. Covers shared edges and
/// corners and skew lines, for any subdivision of the sides.
TEST(PolygonExchange, RowsOfConvexRoomsSumToOne) {
  const double w = 1 / std::sqrt(2.0);
  const Vec3 a{1, 0, -w}, b{-1, 0, -w}, c{0, 1, w}, d{0, -1, w};
  std::vector<Polygon> tetrahedron{{c, b, a}, {d, c, a}, {b, d, a}, {c, d, b}};
  for (std::size_t j = 1; j < 4; ++j) {
    EXPECT_NEAR(form_factor(tetrahedron[0], tetrahedron[j]), 1.0 / 3, 1e-14);
  }
  std::mt19937_64 random(8);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Polygon> room = tetrahedron;
    const Vec3 stretch{1, trial % 3 ? 1 : 0.03, trial % 5 ? 1.0 : 20};
    for (Polygon& side : room) {
      for (Vec3& x : side) {
        x = {x.x * stretch.x, x.y * stretch.y, x.z * stretch.z};
      }
    }
    for (int cut = 0; cut < trial / 4; ++cut) {
      split(room, random() % room.size(),
            normalized({gauss(random), gauss(random), gauss(random)}));
    }
    std::swap(room[0], room[random() % room.size()]);
    // Coplanar parts exchange nothing.
    EXPECT_NEAR(row_sum(room), 1, 2e-12) << trial;
  }
}

/// Two nearly parallel rectangles with a shared edge, or with a small gap between them.
TEST(PolygonExchange, OfNearlyParallelNeighbors) {
  for (const double angle : {1e-9, 1e-6, 1e-3, 0.1, 3.0, 3.1415}) {
    const Vec3 leaf{std::cos(angle), 0, std::sin(angle)};
    const Polygon lying = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Polygon other = rectangle({0, 0, 0}, {0, 1, 0}, leaf);
    // The third side of the wedge and its two ends.
    const Vec3 tip{1, 0, 0}, y{0, 1, 0};
    const std::vector<Polygon> wedge{lying,
                                     other,
                                     {tip, leaf, leaf + y, tip + y},
                                     {{0, 0, 0}, leaf, tip},
                                     {y, tip + y, leaf + y}};
    EXPECT_NEAR(row_sum(wedge), 1, 1e-12) << angle;
    // The rectangle has a gap and is rotated in its plane, so that its edges are nearly parallel to
    // the others.
    const double turn = 1e-4;
    const Vec3 along = std::cos(turn) * leaf + std::sin(turn) * y;
    const Vec3 aside = std::cos(turn) * y - std::sin(turn) * leaf;
    std::vector<Polygon> parts{rectangle({0, 0, 1e-5}, aside, along)};
    const double whole = form_factor(lying, parts[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      split(parts, k, normalized({1, 0.3, 0.1}));
    }
    double sum = 0;
    for (const Polygon& part : parts) {
      sum += form_factor(lying, part);
    }
    EXPECT_NEAR(sum, whole, 1e-12) << angle;
  }
}

TEST(PolygonExchange, IsAdditiveAndReciprocal) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // The polygons are distant, close and intersecting.
    const double apart = trial % 4 * trial % 7;
    const Polygon p{point(), point(), point()};
    const Vec3 off{apart, 0, 0};
    const Polygon q{point() + off, point() + off, point() + off};
    const double whole = polygon_exchange(p, q);
    EXPECT_NEAR(whole, polygon_exchange(q, p), 5e-13);
    std::vector<Polygon> parts{q};
    for (int cut = 0; cut < 3; ++cut) {
      split(parts, random() % parts.size(), normalized(point()));
    }
    double sum = 0;
    for (const Polygon& part : parts) {
      sum += part.empty() ? 0 : polygon_exchange(p, part);
    }
    EXPECT_NEAR(sum, whole, 5e-13) << trial;
    seen += whole > 0;
  }
  EXPECT_GT(seen, 80);
}

TEST(PolygonExchange, OfConcavePolygonsIsTheSumOfTheirParts) {
  // A U, cut by the plane of the other polygon into two separate towers.
  const Polygon u{{0, 0, -1},  {5, 0, -1},  {5, 0, 2}, {4, 0, 2},
                  {4, 0, -.5}, {1, 0, -.5}, {1, 0, 2}, {0, 0, 2}};
  const Polygon floor = rectangle({0, -3, 0}, {5, 0, 0}, {0, 2, 0});
  const double towers = polygon_exchange(floor, rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, 2})) +
                        polygon_exchange(floor, rectangle({4, 0, 0}, {1, 0, 0}, {0, 0, 2}));
  EXPECT_GT(towers, 0.1);
  EXPECT_NEAR(polygon_exchange(floor, u), towers, 1e-13);
}

/// Compares skew edges, close and distant, with Simpson's rule on a fine grid.
TEST(EdgePairIntegral, IsTheDoubleIntegralOfTheLogarithm) {
  std::mt19937_64 random(16);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  for (int trial = 0; trial < 20; ++trial) {
    const Edge a(point(), point());
    const Vec3 off{3, 0, trial % 2 ? 0.0 : 30.0};
    const Edge b(point() + off, point() + off);
    constexpr int n = 64;
    const auto weight = [](int k) { return (k % n == 0 ? 1 : k % 2 ? 4 : 2) / (3.0 * n); };
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        sum +=
            weight(i) * weight(j) * std::log(norm(a.at(a.length * i / n) - b.at(b.length * j / n)));
      }
    }
    sum *= a.length * b.length * dot(a.direction, b.direction);
    EXPECT_NEAR(edge_pair_integral(a, b), sum, 1e-7);
    EXPECT_NEAR(edge_pair_integral(a, b), edge_pair_integral(b, a), 1e-13 * (1 + std::abs(sum)));
  }
}

}  // namespace
}  // namespace transillum::form_factor_test
