// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "transillum/directions.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// RMS of 4 mean(max(n·omega, 0)) - 1 over normals: what the quadrature makes of a plain sky.
double sky_error(Sampling sampling, int count) {
  const auto directions = make_directions(sampling, count, 1);
  const auto normals = make_directions(Sampling::random, 500, 99);
  double squares = 0;
  for (const auto& n : normals) {
    double sum = 0;
    for (const auto& d : directions) sum += std::max(0.0, dot(n.direction, d.direction));
    const double error = 4 * sum / count - 1;
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(normals.size()));
}

TEST(Directions, ErrorsAreThoseMeasuredElsewhere) {
  // The table of the method, with a tenth for the choice of normals.
  EXPECT_NEAR(sky_error(Sampling::hammersley, 256), 4.7e-3, 5e-4);
  EXPECT_NEAR(sky_error(Sampling::hammersley, 1024), 1.2e-3, 1.2e-4);
  EXPECT_NEAR(sky_error(Sampling::fibonacci, 256), 6.6e-4, 1e-4);
  EXPECT_NEAR(sky_error(Sampling::fibonacci, 1024), 1.1e-4, 2e-5);
  EXPECT_GT(sky_error(Sampling::random, 1024), 3e-3);
}

TEST(Directions, AreUnitVectorsOfTheirPoints) {
  for (const auto& name : sampling_names()) {
    for (const auto& d : make_directions(sampling_from_name(name), 777, 5)) {
      EXPECT_NEAR(norm(d.direction), 1, 1e-15);
      EXPECT_NEAR(d.direction.z, 1 - 2 * d.v, 1e-15);  // eq. 13
      EXPECT_GE(d.u, 0);
      EXPECT_LT(d.u, 1);
      EXPECT_GE(d.v, 0);
      EXPECT_LE(d.v, 1);
    }
  }
}

TEST(Directions, HammersleyIsThePapers) {
  const auto points = make_directions(Sampling::hammersley, 8, 0);
  const double v[] = {0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(points[k].u, static_cast<double>(k) / 8);
    EXPECT_EQ(points[k].v, v[k]);
  }
}

TEST(Directions, RandomOnesFollowTheSeed) {
  const auto a = make_directions(Sampling::random, 10, 1);
  const auto b = make_directions(Sampling::random, 10, 1);
  const auto c = make_directions(Sampling::random, 10, 2);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].direction, b[k].direction);
  EXPECT_NE(a[0].direction, c[0].direction);
}

TEST(Directions, ProgressiveOrderIsAPermutationWithFairBeginnings) {
  for (const int count : {1, 2, 7, 100, 1024}) {
    const auto order = progressive_order(count);
    std::set<int> all(order.begin(), order.end());
    EXPECT_EQ(static_cast<int>(all.size()), count);
    EXPECT_EQ(*all.begin(), 0);
    EXPECT_EQ(*all.rbegin(), count - 1);
  }
  // Any beginning has about its share in each quarter.
  const auto order = progressive_order(1000);
  for (int begin = 8; begin < 1000; begin *= 2) {
    const auto in_first_quarter =
        std::count_if(order.begin(), order.begin() + begin, [](int k) { return k < 250; });
    EXPECT_NEAR(static_cast<double>(in_first_quarter), begin / 4.0, 2) << begin;
  }
}

TEST(Directions, RefusesWhatItCannotMake) {
  EXPECT_THROW(make_directions(Sampling::random, 0, 1), InputError);
  EXPECT_THROW(make_directions(Sampling::random, -3, 1), InputError);
  EXPECT_THROW(make_directions(Sampling::random, (1 << 24) + 1, 1), InputError);
  EXPECT_THROW(sampling_from_name("fibonaci"), InputError);
}

}  // namespace
}  // namespace transillum
