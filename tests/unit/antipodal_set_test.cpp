// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sampling::antipodal: M directions that are evenly spread together with their opposites.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sampling/discrepancy.h"
#include "transillum/at.h"

namespace transillum::antipodal_set_test {
namespace {

std::vector<DirectionSample> axes(int count) {
  return make_directions(Sampling::antipodal, count, 1);
}

/// RMS of 2 mean(|n·omega|) - 1 over normals: the error of irradiance under a uniform sky, of
/// two-way passes.
double two_way_error(const std::vector<DirectionSample>& set) {
  return summary_of(quadrature_errors(spread_normals(2000), set, true)).rms / std::numbers::pi;
}

/// The mean of P_l over all pairs of directions: the sum of squares of the means of the harmonics
/// of degree l, over 2l + 1.
double power_of_degree(const std::vector<DirectionSample>& set, int degree) {
  double sum = 0;
  for (const auto& a : set) {
    for (const auto& b : set) {
      sum += std::legendre(static_cast<unsigned>(degree),
                           std::clamp(dot(a.direction, b.direction), -1.0, 1.0));
    }
  }
  return sum / static_cast<double>(set.size() * set.size());
}

TEST(AntipodalSet, HasTheCosineErrorsOfAnIndependentImplementation) {
  // Measured on a lattice on the half sphere, relaxed by repulsion; the last value with weights
  // that integrate harmonics to degree 22.
  EXPECT_LE(two_way_error(axes(64)), 2.2e-3);
  EXPECT_LE(two_way_error(axes(128)), 8.9e-4);
  EXPECT_LE(two_way_error(axes(256)), 3.7e-4);
  EXPECT_LE(two_way_error(axes(1024)), 6.6e-5);
}

TEST(AntipodalSet, IsMoreEvenThanAnyOtherSetWithItsOpposites) {
  for (const int count : {2, 3, 5, 8, 16, 50, 64, 100, 150, 333, 1024}) {
    const double error = two_way_error(axes(count));
    for (const std::string& name : names_of<Sampling>()) {
      const Sampling sampling = from_name<Sampling>(name);
      if (sampling != Sampling::antipodal) {
        EXPECT_LT(error, two_way_error(make_directions(sampling, count, 1))) << name << count;
      }
    }
  }
}

TEST(AntipodalSet, HasTheSmallestCapDiscrepancyWithItsOpposites) {
  for (const int count : {16, 32, 50, 64, 100}) {
    const CapDiscrepancy caps = cap_discrepancy(with_opposites(axes(count)));
    ASSERT_TRUE(caps.exact);
    for (const std::string& name : names_of<Sampling>()) {
      const Sampling sampling = from_name<Sampling>(name);
      if (sampling != Sampling::antipodal) {
        const auto others = with_opposites(make_directions(sampling, count, 1));
        EXPECT_LT(caps.value, cap_discrepancy(others).value) << name << count;
      }
    }
  }
}

TEST(AntipodalSet, KeepsDirectionsApart) {
  for (const int count : {2, 3, 6, 20, 100, 1000}) {
    const auto set = with_opposites(axes(count));
    double nearest = 2;
    for (std::size_t a = 0; a < set.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        nearest = std::min(nearest, norm(set[a].direction - set[b].direction));
      }
    }
    // A hexagonal lattice has 1.07.
    EXPECT_GT(nearest / std::sqrt(2 * std::numbers::pi / count), 0.75) << count;
  }
}

TEST(AntipodalSet, IntegratesEvenHarmonicsOfLowDegree) {
  for (const int count : {64, 256, 1024}) {
    const auto set = axes(count);
    const int degree = std::min(22, static_cast<int>(std::sqrt(count / 2.0)) / 2 * 2);
    for (int l = 2; l <= degree; l += 2) {
      EXPECT_LT(std::abs(power_of_degree(set, l)), 1e-7) << count << " directions, degree " << l;
    }
  }
}

TEST(AntipodalSet, GivesAxisParallelPatchesTheirProjectedArea) {
  const double limits[] = {1e-4, 1e-5, 1e-6};
  const int counts[] = {64, 256, 1024};
  for (int k = 0; k < 3; ++k) {
    for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      EXPECT_LT(std::abs(quadrature_error(normal, axes(counts[k]), true)),
                std::numbers::pi * limits[k])
          << counts[k];
    }
  }
}

TEST(AntipodalSet, HasAsManyDirectionsOnEitherSide) {
  for (const int count : {20, 64, 1000}) {
    const auto set = axes(count);
    const auto order = progressive_order(Sampling::antipodal, count);
    for (const int part : {count / 2, count}) {
      Vec3 sum;
      for (int k = 0; k < part; ++k) {
        sum = sum + at(set, at(order, k)).direction;
      }
      // Measured: at most 3.8. For independent directions, the value would be about the root of
      // their number.
      EXPECT_LT(norm(sum), 4) << part << " of " << count;
    }
  }
}

/// RMS of two_way_error() over parts of the set in its progressive order.
double error_of_parts(Sampling sampling, int count) {
  const auto set = make_directions(sampling, count, 1);
  const auto order = progressive_order(sampling, count);
  constexpr int parts = 8;
  double squares = 0;
  for (int part = 1; part <= parts; ++part) {
    std::vector<DirectionSample> first;
    for (int k = 0; k < part * count / parts; ++k) {
      first.push_back(at(set, at(order, k)));
    }
    squares += std::pow(two_way_error(first), 2) / parts;
  }
  return std::sqrt(squares);
}

TEST(AntipodalSet, IsAsEvenAsTheLatticeInItsProgressiveOrder) {
  for (const int count : {100, 128, 1000, 1024}) {
    EXPECT_LT(error_of_parts(Sampling::antipodal, count),
              error_of_parts(Sampling::fibonacci, count))
        << count;
  }
}

/// The set has the same bits on every machine: it uses no function of the C library whose last bit
/// is undefined.
TEST(AntipodalSet, HasKnownBits) {
  const auto set = axes(100);
  EXPECT_EQ(set[0].direction,
            (Vec3{0x1.97db1b1c951c1p-4, 0x1.7679a5ec304d7p-9, 0x1.fd740d8f9dc5fp-1}));
  EXPECT_EQ(set[57].direction,
            (Vec3{-0x1.cb95409331ce7p-4, -0x1.ca96797f51a2dp-1, -0x1.b8a3edd30355bp-2}));
  EXPECT_EQ(set[99].direction,
            (Vec3{-0x1.aaeb90b191cap-2, -0x1.d10c25e3a3e7p-1, -0x1.198d9de4b3081p-5}));
}

TEST(AntipodalSet, DoesNotDependOnTheSeed) {
  EXPECT_FALSE(is_seeded(Sampling::antipodal));
  EXPECT_FALSE(is_extensible(Sampling::antipodal));
  const auto other = make_directions(Sampling::antipodal, 30, 2);
  for (std::size_t k = 0; k < other.size(); ++k) {
    EXPECT_EQ(axes(30)[k].direction, other[k].direction);
  }
}

/// Beyond 65,536 directions there is no repulsion.
TEST(AntipodalSet, OfManyDirectionsIsEven) {
  const double limit = two_way_error(axes(4096)) / 10;
  EXPECT_LT(two_way_error(axes((1 << 16) + 1)), limit);
}

TEST(WithOpposites, AppendsExactOpposites) {
  const auto set = make_directions(Sampling::sobol, 20, 3);
  const auto both = with_opposites(set);
  ASSERT_EQ(both.size(), 40U);
  for (std::size_t k = 0; k < set.size(); ++k) {
    EXPECT_EQ(both[k].direction, set[k].direction);
    EXPECT_EQ(both[k + 20].direction, -set[k].direction);
    EXPECT_NEAR(both[k + 20].v, 1 - set[k].v, 1e-15);
  }
}

TEST(DefaultSampling, DependsOnWhatAPassServes) {
  EXPECT_EQ(default_sampling(true), Sampling::antipodal);
  EXPECT_EQ(default_sampling(false), Sampling::fibonacci);
}

}  // namespace
}  // namespace transillum::antipodal_set_test
