// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sampling/discrepancy.h"
#include "support/canceled.h"

namespace transillum::discrepancy_test {
namespace {

/// All boxes whose upper sides are at a point or at 1, with and without their upper sides.
double star_by_exhaustive_search(const std::vector<DirectionSample>& points) {
  std::vector<double> us{1}, vs{1};
  for (const auto& p : points) {
    us.push_back(p.u);
    vs.push_back(p.v);
  }
  double largest = 0;
  for (const double u : us) {
    for (const double v : vs) {
      int closed = 0, open = 0;
      for (const auto& p : points) {
        closed += p.u <= u && p.v <= v;
        open += p.u < u && p.v < v;
      }
      const auto count = static_cast<double>(points.size());
      largest = std::max({largest, closed / count - u * v, u * v - open / count});
    }
  }
  return largest;
}

TEST(StarDiscrepancy, EqualsExhaustiveSearch) {
  for (const auto& name : names_of<Sampling>()) {
    for (const int count : {1, 2, 3, 10, 33, 64, 120}) {
      const auto points = make_directions(from_name<Sampling>(name), count, 7);
      EXPECT_NEAR(star_discrepancy(points), star_by_exhaustive_search(points), 1e-14)
          << name << count;
    }
  }
}

TEST(StarDiscrepancy, HandlesCollinearAndCoincidentPoints) {
  auto points = make_directions(Sampling::random, 60, 3);
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].u = std::floor(4 * points[k].u) / 4;
    points[k].v = std::floor(5 * points[k].v) / 5;
    if (k % 7 == 0) {
      points[k].v = 1;
    }
  }
  EXPECT_NEAR(star_discrepancy(points), star_by_exhaustive_search(points), 1e-14);
  const std::vector<DirectionSample> heap(9, {0.25, 0.5, {1, 0, 0}});
  EXPECT_NEAR(star_discrepancy(heap), 1 - 0.25 * 0.5, 1e-15);
  EXPECT_EQ(star_discrepancy({}), 0);
}

TEST(StarDiscrepancy, OfHammersleyPointsSatisfiesEquation20) {
  for (int count = 1; count <= 4096; count *= 2) {
    const double measured = star_discrepancy(make_directions(Sampling::hammersley, count, 0));
    EXPECT_LE(measured, (std::log2(count) + 7) / (2 * count)) << count;
    EXPECT_GE(measured, 1. / count) << count;
  }
  // 10,000 points take 0.1 s; an exhaustive search takes hours.
  const auto points = make_directions(Sampling::fibonacci, 10000, 0);
  EXPECT_LT(star_discrepancy(points), 6e-4);
}

/// Caps through all triples and about the midpoints of all pairs, both sides of each.
double cap_by_exhaustive_search(const std::vector<DirectionSample>& set) {
  const auto count = static_cast<double>(set.size());
  double largest = 0;
  const auto try_rim = [&](const Vec3& center, double height) {
    for (const double side : {1.0, -1.0}) {
      int closed = 0;
      for (const auto& s : set) {
        closed += side * (dot(center, s.direction) - height) >= -1e-13;
      }
      largest = std::max(largest, closed / count - (1 - side * height) / 2);
    }
  };
  for (std::size_t a = 0; a < set.size(); ++a) {
    largest = std::max(largest, 1 / count);
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 middle = normalized(set[a].direction + set[b].direction);
      try_rim(middle, dot(middle, set[a].direction));
      for (std::size_t c = 0; c < b; ++c) {
        const Vec3 n = normalized(
            cross(set[b].direction - set[a].direction, set[c].direction - set[a].direction));
        try_rim(n, dot(n, set[a].direction));
      }
    }
  }
  return largest;
}

TEST(CapDiscrepancy, OfFewDirectionsEqualsExhaustiveSearch) {
  for (const auto& name : names_of<Sampling>()) {
    for (const int count : {1, 2, 3, 5, 20}) {
      const auto set = make_directions(from_name<Sampling>(name), count, 7);
      const CapDiscrepancy caps = cap_discrepancy(set);
      EXPECT_TRUE(caps.exact);
      EXPECT_NEAR(caps.value, cap_by_exhaustive_search(set), 1e-12) << name << count;
    }
  }
}

TEST(CapDiscrepancy, HandlesOppositeAndEqualDirections) {
  std::vector<DirectionSample> axes;
  for (const double s : {1.0, -1.0}) {
    for (const Vec3& d : {Vec3{s, 0, 0}, Vec3{0, s, 0}, Vec3{0, 0, s}}) {
      axes.push_back({0, 0, d});
    }
  }
  // The closed hemisphere about an axis contains 5 of 6 on half of the sphere: 1/3, the maximum.
  EXPECT_NEAR(cap_discrepancy(axes).value, 5. / 6 - 1. / 2, 1e-12);
  axes.insert(axes.end(), 4, axes[0]);
  EXPECT_NEAR(cap_discrepancy(axes).value, 9. / 10 - 1. / 2, 0.1 + 1e-12);
  EXPECT_GE(cap_discrepancy(axes).value, 5. / 10);  // five coincide, a cap of area 0
  EXPECT_EQ(cap_discrepancy({}).value, 0);
}

/// For many directions, the value is a lower bound, and a close one.
TEST(CapDiscrepancy, OfManyDirectionsIsACloseLowerBound) {
  const auto few = make_directions(Sampling::sobol, max_exact_cap_directions, 2);
  // The same directions, each twice, have the same discrepancy.
  auto twice = few;
  twice.insert(twice.end(), few.begin(), few.end());
  const CapDiscrepancy exact = cap_discrepancy(few), bound = cap_discrepancy(twice);
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(bound.exact);
  EXPECT_LE(bound.value, exact.value + 1e-12);
  EXPECT_GT(bound.value, 0.75 * exact.value);
}

TEST(QuadratureError, MatchesEquation17) {
  const std::vector<DirectionSample> one{{0, 0, {0, 0, 1}}};
  EXPECT_DOUBLE_EQ(quadrature_error({0, 0, 1}, one, false), 3 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(quadrature_error({0, 0, -1}, one, false), -std::numbers::pi);
  EXPECT_DOUBLE_EQ(quadrature_error({0, 0, -1}, one, true), std::numbers::pi);
  // Bound of eq. 21: Hammersley points and a patch whose normal is the axis of eq. 13, as in
  // eq. 19.
  for (int count = 1; count <= 1 << 14; count *= 4) {
    const auto set = make_directions(Sampling::hammersley, count, 0);
    EXPECT_LE(std::abs(quadrature_error({0, 0, 1}, set, false)),
              2 * std::numbers::pi / count * (std::log2(count) + 7));
  }
  const auto set = make_directions(Sampling::random, 100, 0);
  const auto normals = spread_normals(10);
  ASSERT_EQ(normals.size(), 16U);
  const auto errors = quadrature_errors(normals, set, true);
  double squares = 0, largest = 0;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const double e = quadrature_error(normals[k], set, true);
    EXPECT_EQ(errors[k], e);
    squares += e * e;
    largest = std::max(largest, std::abs(e));
  }
  EXPECT_DOUBLE_EQ(summary_of(errors).rms, std::sqrt(squares / 16));
  EXPECT_EQ(summary_of(errors).max, largest);
}

TEST(Discrepancies, CanBeCanceled) {
  const auto set = make_directions(Sampling::sobol, 500, 1);
  EXPECT_THROW(star_discrepancy(set, testing::canceled()), Canceled);
  EXPECT_THROW(cap_discrepancy(set, testing::canceled()), Canceled);
  EXPECT_THROW(quadrature_errors(spread_normals(3), set, true, testing::canceled()), Canceled);
}

}  // namespace
}  // namespace transillum::discrepancy_test
