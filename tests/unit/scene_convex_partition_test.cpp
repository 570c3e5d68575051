// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/convex_partition.h"

namespace transillum::scene_convex_partition_test {
namespace {

using Outline = std::vector<PlanePoint>;

const Outline square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const Outline pentagram{{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}};

double area(const Outline& outline, const auto& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlanePoint& a = outline[corners[i]];
    const PlanePoint& b = outline[corners[(i + 1) % corners.size()]];
    sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return sum;
}

TEST(ConvexPartition, RecognizesConvexOutlines) {
  EXPECT_TRUE(is_convex(square));
  EXPECT_TRUE(is_convex(Outline{{0, 0}, {.5, 0}, {1, 0}, {1, 1}, {0, 1}, {0, .5}}));
  EXPECT_FALSE(is_convex(Outline(square.rbegin(), square.rend()))) << "clockwise";
  EXPECT_FALSE(is_convex(pentagram)) << "turns left everywhere, but winds twice";
  EXPECT_FALSE(is_convex(Outline{{0, 0}, {2, 0}, {1, 0}, {1, 1}})) << "a spike";
  EXPECT_FALSE(is_convex(Outline{{0, 0}, {1, 0}, {2, 0}})) << "no area";
  EXPECT_FALSE(is_convex(Outline{{0, 0}, {2, 0}, {1, .5}, {2, 2}, {0, 2}}));
}

TEST(ConvexPartition, IsExactWhereRoundingDecides) {
  // The third point is off the line by less than the rounding of the products.
  const double up = std::nextafter(0.5, 1.0);
  EXPECT_EQ(exact_turn({0, 0}, {12, 12}, {0.5, up}), 1);
  EXPECT_EQ(exact_turn({0, 0}, {12, 12}, {up, 0.5}), -1);
  EXPECT_EQ(exact_turn({0, 0}, {12, 12}, {0.5, 0.5}), 0);
  EXPECT_EQ(exact_turn({1e30, 1e30}, {2e30, 2e30}, {3e30, std::nextafter(3e30, 1e31)}), 1);
}

TEST(ConvexPartition, RecognizesSimpleOutlines) {
  EXPECT_TRUE(is_simple(square));
  EXPECT_FALSE(is_simple(pentagram));
}

TEST(ConvexPartition, SplitsConcaveOutlinesIntoFewConvexParts) {
  const int n = 200;
  Outline star;
  for (int i = 0; i < n; ++i) {
    const double r = i % 2 == 0 ? 1 : 0.7, angle = 2 * std::numbers::pi * i / n;
    star.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  const std::vector<CornerList> parts = convex_partition(star);
  EXPECT_LE(parts.size(), 4u * (n / 4 + 1)) << "half the corners are reflex; 2 per cut";
  double sum = 0;
  for (const CornerList& part : parts) {
    Outline corners;
    for (const std::uint32_t c : part) {
      corners.push_back(star[c]);
    }
    EXPECT_TRUE(is_convex(corners));
    sum += area(star, part);
  }
  CornerList all(star.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<std::uint32_t>(i);
  }
  EXPECT_NEAR(sum, area(star, all), 1e-12);
}

TEST(ConvexPartition, TriangulatesOutlinesThatTouchThemselves) {
  // A corner of the notch lies on the bottom edge.
  const Outline touching{{0, 0}, {4, 0}, {4, 2}, {3, 2}, {2, 0}, {1, 2}, {0, 2}};
  double sum = 0;
  for (const auto& t : triangulate(touching)) {
    sum += area(touching, t);
  }
  EXPECT_DOUBLE_EQ(sum, 8 - 2);
}

TEST(ConvexPartition, IsEmptyForCrossingOutlines) {
  EXPECT_TRUE(triangulate(pentagram).empty());
  EXPECT_TRUE(convex_partition(pentagram).empty());
  EXPECT_TRUE(triangulate(Outline{{0, 0}, {1, 1}, {2, 2}}).empty());
}

}  // namespace
}  // namespace transillum::scene_convex_partition_test
