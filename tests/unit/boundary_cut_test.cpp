// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The inner loop of engine fast: known cuts, and all backends give the same bits.
#include "visibility/queries/boundary_cut.h"
#include "visibility/queries/simd_backend.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace transillum::boundary_cut_test {
namespace {

using Points = std::vector<std::pair<double, double>>;

void add(BoundarySegments& outline, const Points& polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& [ax, ay] = polygon[k];
    const auto& [bx, by] = polygon[(k + 1) % polygon.size()];
    outline.add(ax, ay, bx, by);
  }
}

/// A cutter with integer corners.
Cutter cutter_of(const SimdBackend& backend, const Points& polygon, double tolerance = 0) {
  std::vector<GridPoint> corners;
  for (const auto& [x, y] : polygon) {
    corners.push_back({std::llrint(x), std::llrint(y)});
  }
  Cutter cutter;
  backend.set(cutter, corners.data(), corners.size(), {0, 0}, HUGE_VAL);
  cutter.tolerance = tolerance;
  return cutter;
}

Points regular(std::size_t corners, double x, double y, double radius, double turn) {
  Points points;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle =
        turn + 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    points.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
  return points;
}

Points square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

class BoundaryCutBackends : public ::testing::TestWithParam<SimdBackend> {
 protected:
  bool cut(const BoundarySegments& outline, const Cutter& cutter) {
    return GetParam().cut(outline, cutter, cut_, outside_);
  }
  std::uint64_t all_in() const {
    std::uint64_t bits = 0;
    for (std::size_t m = 0; m < 4; ++m) {
      bits |= cut_.enters[m];
    }
    return bits;
  }
  BoundaryCut cut_;
  BoundarySegments outside_;
};

/// The cutter overlaps the square's right side: three segments remain whole, the fourth becomes two
/// outside parts and one inside part.
TEST_P(BoundaryCutBackends, ACutterAcrossASide) {
  BoundarySegments outline;
  add(outline, square(0, 0, 4));
  const Cutter cutter = cutter_of(GetParam(), {{3, 1}, {6, 1}, {6, 2}, {3, 2}});
  ASSERT_TRUE(cut(outline, cutter));
  // Segment 1 goes up along x = 4: it enters through the lower edge and leaves through the upper
  // one.
  EXPECT_THAT(std::vector(cut_.enters.begin(), cut_.enters.begin() + 4),
              ::testing::ElementsAre(2, 0, 0, 0));
  EXPECT_THAT(std::vector(cut_.leaves.begin(), cut_.leaves.begin() + 4),
              ::testing::ElementsAre(0, 0, 2, 0));
  EXPECT_EQ(cut_.in_x[1], 4);
  EXPECT_EQ(cut_.in_y[1], 1);
  EXPECT_EQ(cut_.out_x[1], 4);
  EXPECT_EQ(cut_.out_y[1], 2);
  // The cutter's left corners are in the square, its right ones are not.
  EXPECT_THAT(std::vector(cut_.winding.begin(), cut_.winding.begin() + 4),
              ::testing::ElementsAre(1, 0, 0, 1));
  EXPECT_EQ(cut_.twice_area, 4);  // about (0, 0): from (4, 1) to (4, 2)
  EXPECT_EQ(outside_.count, 5U);
  EXPECT_EQ(GetParam().extent(outside_), (Extent{4, 4, 8, 4, 0, 0, 0, 4}));
}

TEST_P(BoundaryCutBackends, ACutterInsideTheRegion) {
  BoundarySegments outline;
  add(outline, square(0, 0, 4));
  ASSERT_TRUE(cut(outline, cutter_of(GetParam(), square(1, 1, 1))));
  EXPECT_EQ(all_in(), 0U);
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_EQ(cut_.winding[m], 1);
  }
  EXPECT_EQ(outside_.count, 4U);
}

TEST_P(BoundaryCutBackends, ARegionInsideTheCutter) {
  BoundarySegments outline;
  add(outline, square(1, 1, 1));
  ASSERT_TRUE(cut(outline, cutter_of(GetParam(), square(0, 0, 4))));
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_EQ(cut_.winding[m], 0);
  }
  EXPECT_EQ(cut_.twice_area, 2);
  EXPECT_EQ(outside_.count, 0U);
}

TEST_P(BoundaryCutBackends, NoCommonArea) {
  BoundarySegments outline;
  add(outline, square(0, 0, 4));
  EXPECT_FALSE(cut(outline, cutter_of(GetParam(), square(5, 0, 4))));
  // No line of the cutter separates them.
  ASSERT_TRUE(cut(outline, cutter_of(GetParam(), {{5, 2}, {20, 1}, {20, 3}})));
  EXPECT_EQ(all_in(), 0U);
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_EQ(cut_.winding[m], 0);
  }
}

/// Points within the tolerance of a line are treated as on its inner side; segments are cut at such
/// end points.
TEST_P(BoundaryCutBackends, PointsOnLines) {
  BoundarySegments outline;
  add(outline, square(0, 0, 4));
  ASSERT_TRUE(cut(outline, cutter_of(GetParam(), square(5, 0, 4), 1)));
  // Segment 1 is on the cutter's left line, 0 and 2 end there.
  EXPECT_EQ(cut_.enters[3], 1U);
  EXPECT_EQ(cut_.leaves[3], 4U);
  EXPECT_EQ(cut_.in_x[0], 4);
  EXPECT_EQ(cut_.out_x[2], 4);
  EXPECT_EQ(outside_.count, 3U);
}

INSTANTIATE_TEST_SUITE_P(All, BoundaryCutBackends, ::testing::ValuesIn(simd_backends()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

struct Input {
  Points polygon;
  double tolerance, pivot_x;
};

struct Result {
  Cutter cutter;
  bool cut = false;
  BoundaryCut found;
  BoundarySegments outside;
  Extent extent;
};

Result result_of(const SimdBackend& backend, const BoundarySegments& outline, const Input& input) {
  Result result;
  result.cutter = cutter_of(backend, input.polygon, input.tolerance);
  result.cutter.pivot_x = input.pivot_x;
  result.cut = backend.cut(outline, result.cutter, result.found, result.outside);
  result.extent = backend.extent(outline);
  return result;
}

void expect_same(const Result& a, const Result& b) {
  const std::size_t lines = a.cutter.count;
  for (std::size_t m = 0; m < lines; ++m) {
    ASSERT_EQ(a.cutter.x[m], b.cutter.x[m]);
    ASSERT_EQ(a.cutter.y[m], b.cutter.y[m]);
    ASSERT_EQ(a.cutter.dx[m], b.cutter.dx[m]);
    ASSERT_EQ(a.cutter.dy[m], b.cutter.dy[m]);
    ASSERT_EQ(a.cutter.c[m], b.cutter.c[m]);
    ASSERT_EQ(a.cutter.middle[m], b.cutter.middle[m]);
    ASSERT_EQ(a.cutter.length[m], b.cutter.length[m]);
  }
  ASSERT_EQ(a.cutter.perimeter, b.cutter.perimeter);
  ASSERT_EQ(a.extent, b.extent);
  ASSERT_EQ(a.cut, b.cut);
  if (!a.cut) {
    return;
  }
  ASSERT_EQ(a.found.twice_area, b.found.twice_area);
  for (std::size_t m = 0; m < lines; ++m) {
    ASSERT_EQ(a.found.enters[m], b.found.enters[m]);
    ASSERT_EQ(a.found.leaves[m], b.found.leaves[m]);
    ASSERT_EQ(a.found.winding[m], b.found.winding[m]);
    for (std::size_t k = 0; k < BoundarySegments::max_count; ++k) {
      if ((a.found.enters[m] >> k & 1) != 0) {
        ASSERT_EQ(a.found.in_x[k], b.found.in_x[k]);
        ASSERT_EQ(a.found.in_y[k], b.found.in_y[k]);
      }
      if ((a.found.leaves[m] >> k & 1) != 0) {
        ASSERT_EQ(a.found.out_x[k], b.found.out_x[k]);
        ASSERT_EQ(a.found.out_y[k], b.found.out_y[k]);
      }
    }
  }
  ASSERT_EQ(a.outside.count, b.outside.count);
  for (std::size_t k = 0; k < a.outside.count; ++k) {
    ASSERT_EQ(a.outside.ax[k], b.outside.ax[k]);
    ASSERT_EQ(a.outside.ay[k], b.outside.ay[k]);
    ASSERT_EQ(a.outside.bx[k], b.outside.bx[k]);
    ASSERT_EQ(a.outside.by[k], b.outside.by[k]);
  }
}

/// Polygons of up to 64 segments; in every other round with small integers, so that points lie on
/// lines.
TEST(BoundaryCut, AllBackendsGiveTheSameBits) {
  const auto backends = simd_backends();
  EXPECT_STREQ(backends.back().name, "scalar");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  int cuts = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const bool small = trial % 2 == 0;
    const double size = small ? 3 : 0x1p40;
    const auto number = [&] { return std::round(size * place(random)); };
    Points star;
    const std::size_t corners = 3 + random() % 62;
    for (std::size_t k = 0; k < corners; ++k) {
      star.emplace_back(number(), number());
    }
    BoundarySegments outline;
    add(outline, star);
    const Input input{
        small ? square(number(), number(), 2)
              : regular(3 + random() % 14, number(), number(), 0.7 * size, place(random)),
        small ? 0.5 : 0.01 * size, number()};
    const Result expected = result_of(backends.back(), outline, input);
    cuts += expected.cut;
    for (const SimdBackend& backend : backends) {
      SCOPED_TRACE(backend.name);
      expect_same(expected, result_of(backend, outline, input));
      if (HasFatalFailure()) {
        return;
      }
    }
  }
  EXPECT_GT(cuts, 10000);
}

/// Near the region, a line through far points is as accurate as one through near points.
TEST(BoundaryCut, FarLines) {
  constexpr std::int64_t far = std::int64_t{1} << 56;
  const std::vector<GridPoint> corners{{-far - 1, -far + 2}, {far - 3, far + 1}, {-far, far}};
  for (const SimdBackend& backend : simd_backends()) {
    Cutter cutter;
    backend.set(cutter, corners.data(), corners.size(), {0, 0}, 1000);
    // dy x - dx y, both of 113 bits, comes to 5 - 7 far.
    EXPECT_NEAR(cutter.c[0], -7 * static_cast<double>(far), 0x1p50) << backend.name;
  }
}

}  // namespace
}  // namespace transillum::boundary_cut_test
