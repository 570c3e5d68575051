// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/adaptive_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace transillum::adaptive_points_test {
namespace {

/// The points of a triangle see all on one side of the edge of a shadow, and nothing on the other.
/// Three points and three corners often say the same part of it, a third or two thirds.
TEST(AdaptivePoints, FindTheEdgeOfAShadowWherePointsAndCornersAgreeByChance) {
  const std::array<Vec3, 3> whole{{{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0}}};
  constexpr double tolerated = 0.001;  // of an area of 0.5
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  int divided = 0;
  double squares = 0;
  for (int k = 0; k < 1000; ++k) {
    const double angle = 6.2832 * uniform(random);
    const Vec3 normal{std::cos(angle), std::sin(angle), 0};
    const HalfSpace lit{normal, dot(normal, {uniform(random), uniform(random), 0})};
    const Corners seen = clipped(whole, lit);
    const double exact = seen.empty() ? 0 : norm(area_vector(seen));
    if (exact < 0.1 || exact > 0.4) {
      continue;
    }
    const auto see = [&](Outline triangle) {
      const Vec3 middle = middle_of(triangle);
      int points = 0, corners = 0;
      for (const Vec3& corner : triangle) {
        points += lit.distance(middle + 0.5 * (corner - middle)) > 0 ? 1 : 0;
        corners += lit.distance(corner) > 0 ? 1 : 0;
      }
      const double area = norm(area_vector(triangle)), third = area / 3;
      const bool all = points + corners == 6, none = points + corners == 0;
      return AdaptivePoints::Seen{points * third, corners * third, all || none ? 0 : area};
    };
    AdaptivePoints adaptive(see, [](double) { return tolerated; });
    const double found = adaptive(whole, 1);
    ++divided;
    squares += (found - exact) * (found - exact);
    EXPECT_NEAR(found, exact, 5 * tolerated) << angle << ", " << lit.offset;
  }
  EXPECT_GT(divided, 300);
  EXPECT_LE(std::sqrt(squares / divided), tolerated);
}

}  // namespace
}  // namespace transillum::adaptive_points_test
