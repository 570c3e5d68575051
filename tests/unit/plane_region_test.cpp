// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "geometry/plane_region.h"

#include <gtest/gtest.h>

#include <random>

namespace transillum::plane_region_test {
namespace {

struct Polygon {
  std::vector<PlaneRegion::Point> corners;

  std::vector<PlaneRegion::Side> sides() const {
    std::vector<PlaneRegion::Side> sides;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const PlaneRegion::Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
      const double length = std::hypot(b.u - a.u, b.v - a.v);
      sides.push_back(
          {(a.v - b.v) / length, (b.u - a.u) / length, (a.u * b.v - a.v * b.u) / length});
    }
    return sides;
  }
  PlaneRegion::Box box() const {
    PlaneRegion::Box box;
    for (const PlaneRegion::Point& p : corners) {
      box.add(p);
    }
    return box;
  }
  bool holds(const PlaneRegion::Point& p) const {
    for (const PlaneRegion::Side& side : sides()) {
      if (side.distance(p) <= 0) {
        return false;
      }
    }
    return true;
  }
};

double area(std::span<const PlaneRegion::Point> corners) {
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const PlaneRegion::Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
    twice +=
        (a.u - corners[0].u) * (b.v - corners[0].v) - (a.v - corners[0].v) * (b.u - corners[0].u);
  }
  return twice / 2;
}

double area(const PlaneRegion& region) {
  double sum = 0;
  region.for_each([&](std::span<const PlaneRegion::Point> part) { sum += area(part); });
  return sum;
}

Polygon rectangle(double u, double v, double width, double height) {
  return {{{u, v}, {u + width, v}, {u + width, v + height}, {u, v + height}}};
}

/// Convex, counter-clockwise: random points of an ellipse.
Polygon random_polygon(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const PlaneRegion::Point center{unit(random), unit(random)};
  const double a = 0.6 * unit(random), b = 0.6 * unit(random) * unit(random);
  std::vector<double> angles(3 + random() % 6);
  for (double& angle : angles) {
    angle = 6.28 * unit(random);
  }
  std::sort(angles.begin(), angles.end());
  Polygon polygon;
  for (const double angle : angles) {
    polygon.corners.push_back({center.u + a * std::cos(angle), center.v + b * std::sin(angle)});
  }
  return polygon;
}

TEST(PlaneRegion, HasTheRemainingArea) {
  PlaneRegion region;
  region.assign(rectangle(0, 0, 2, 1).corners);
  EXPECT_DOUBLE_EQ(area(region), 2);
  const auto take = [&](const Polygon& polygon) {
    region.subtract(polygon.sides(), polygon.box());
  };
  take(rectangle(0.5, 0.25, 0.5, 0.5));
  EXPECT_DOUBLE_EQ(area(region), 1.75);
  take(rectangle(0.5, 0.25, 0.5, 0.5));
  EXPECT_DOUBLE_EQ(area(region), 1.75) << "the same again";
  take(rectangle(2, 0, 1, 1));
  take(rectangle(-1, -1, 4, 1));
  EXPECT_DOUBLE_EQ(area(region), 1.75) << "touching from outside";
  take(rectangle(1, -1, 9, 9));
  EXPECT_DOUBLE_EQ(area(region), 0.75);
  take(rectangle(-1, -1, 9, 9));
  EXPECT_TRUE(region.empty());
}

TEST(PlaneRegion, ContainsThePointsOutsideAllSubtractedPolygons) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int left = 0;
  for (int trial = 0; trial < 100; ++trial) {
    PlaneRegion region;
    const Polygon whole = random_polygon(random);
    region.assign(whole.corners);
    std::vector<Polygon> taken;
    for (int k = 0; k < 8; ++k) {
      taken.push_back(random_polygon(random));
    }
    for (const Polygon& polygon : taken) {
      region.subtract(polygon.sides(), polygon.box());
    }
    for (int k = 0; k < 200; ++k) {
      const PlaneRegion::Point p{unit(random), unit(random)};
      bool expected = whole.holds(p);
      for (const Polygon& polygon : taken) {
        expected = expected && !polygon.holds(p);
      }
      int parts = 0;
      region.for_each([&](std::span<const PlaneRegion::Point> part) {
        parts += Polygon{{part.begin(), part.end()}}.holds(p);
      });
      ASSERT_EQ(parts, expected ? 1 : 0) << trial;
      left += parts;
    }
  }
  EXPECT_GT(left, 200);
}

/// The area does not depend on the order, although edges of the polygons nearly coincide.
TEST(PlaneRegion, DoesNotDependOnTheOrder) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> noise(-1e-15, 1e-15);
  std::vector<Polygon> grid;
  for (int k = 0; k < 25; ++k) {
    const int column = k % 5, row = k / 5;
    grid.push_back(rectangle(0.1 * column, 0.1 * row, 0.1, 0.1));
    for (PlaneRegion::Point& p : grid.back().corners) {
      p.u += noise(random), p.v += noise(random);
    }
  }
  for (int trial = 0; trial < 20; ++trial) {
    PlaneRegion region;
    region.assign(rectangle(0, 0, 1, 1).corners);
    std::shuffle(grid.begin(), grid.end(), random);
    for (const Polygon& cell : grid) {
      region.subtract(cell.sides(), cell.box());
    }
    EXPECT_NEAR(area(region), 0.75, 1e-13);
  }
}

}  // namespace
}  // namespace transillum::plane_region_test
