// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "transillum/at.h"
#include "transillum/directions.h"
#include "transillum/errors.h"

namespace transillum::directions_test {
namespace {

/// RMS of 4 mean(max(n·omega, 0)) - 1 over normals: the error of irradiance under a uniform sky.
double sky_error(Sampling sampling, int count) {
  const auto directions = make_directions(sampling, count, 1);
  const auto normals = make_directions(Sampling::random, 500, 99);
  double squares = 0;
  for (const auto& n : normals) {
    double sum = 0;
    for (const auto& d : directions) {
      sum += std::max(0.0, dot(n.direction, d.direction));
    }
    const double error = 4 * sum / count - 1;
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(normals.size()));
}

TEST(Directions, ErrorsMatchReferenceValues) {
  // Reference values from an independent implementation; a tenth for the choice of normals.
  EXPECT_NEAR(sky_error(Sampling::hammersley, 256), 4.7e-3, 5e-4);
  EXPECT_NEAR(sky_error(Sampling::hammersley, 1024), 1.2e-3, 1.2e-4);
  EXPECT_NEAR(sky_error(Sampling::centered_hammersley, 256), 1.3e-3, 1.3e-4);
  EXPECT_NEAR(sky_error(Sampling::centered_hammersley, 1024), 2.1e-4, 2.5e-5);
  EXPECT_NEAR(sky_error(Sampling::fibonacci, 256), 6.6e-4, 1e-4);
  EXPECT_NEAR(sky_error(Sampling::fibonacci, 1024), 1.1e-4, 2e-5);
  EXPECT_GT(sky_error(Sampling::random, 1024), 3e-3);
  EXPECT_LT(sky_error(Sampling::scrambled_hammersley, 1024), 8e-4);
  EXPECT_LT(sky_error(Sampling::sobol, 1024), 8e-4);
  EXPECT_LT(sky_error(Sampling::halton, 1024), 8e-3);
}

/// Scripts written for earlier versions use the British spelling.
TEST(Directions, AcceptTheFormerSpellingOfCentered) {
  EXPECT_EQ(from_name<Sampling>("centred-hammersley"), Sampling::centered_hammersley);
  EXPECT_EQ(name_of(Sampling::centered_hammersley), "centered-hammersley");
}

TEST(Directions, AreUnitVectorsByEquation13) {
  for (const auto& name : names_of<Sampling>()) {
    for (const auto& d : make_directions(from_name<Sampling>(name), 777, 5)) {
      EXPECT_NEAR(norm(d.direction), 1, 1e-15);
      EXPECT_NEAR(d.direction.z, 1 - 2 * d.v, 1e-15);  // eq. 13
      EXPECT_GE(d.u, 0);
      EXPECT_LT(d.u, 1);
      EXPECT_GE(d.v, 0);
      EXPECT_LE(d.v, 1);
    }
  }
}

TEST(Directions, HammersleyMatchesThePaper) {
  const auto points = make_directions(Sampling::hammersley, 8, 0);
  const double v[] = {0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(points[k].u, static_cast<double>(k) / 8);
    EXPECT_EQ(points[k].v, v[k]);
  }
}

TEST(Directions, HaltonIsBasesTwoAndThree) {
  const auto points = make_directions(Sampling::halton, 10, 0);
  const double v[] = {0, 1. / 3, 2. / 3, 1. / 9, 4. / 9, 7. / 9, 2. / 9, 5. / 9, 8. / 9, 1. / 27};
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(points[k].u, make_directions(Sampling::hammersley, 10, 0)[k].v);
    EXPECT_DOUBLE_EQ(points[k].v, v[k]);
  }
}

TEST(Directions, DependOnTheSeedIfSeeded) {
  for (const auto& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    const auto a = make_directions(sampling, 10, 1);
    const auto b = make_directions(sampling, 10, 1);
    const auto c = make_directions(sampling, 10, 2);
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].direction, b[k].direction);
    }
    EXPECT_EQ(a[3].direction != c[3].direction, is_seeded(sampling)) << name;
  }
}

TEST(Directions, ExtensibleSequencesContinue) {
  for (const auto& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    const auto few = make_directions(sampling, 100, 4), many = make_directions(sampling, 300, 4);
    bool beginning = true;
    for (std::size_t k = 0; k < few.size(); ++k) {
      beginning = beginning && few[k].direction == many[k].direction;
    }
    EXPECT_EQ(beginning, is_extensible(sampling)) << name;
    if (!is_extensible(sampling)) {
      EXPECT_THROW(make_directions(sampling, 0, 10, 4), InputError) << name;
      continue;
    }
    const auto part = make_directions(sampling, 37, 211, 4);
    ASSERT_EQ(part.size(), 211U - 37U);
    for (std::size_t k = 0; k < part.size(); ++k) {
      EXPECT_EQ(part[k].direction, many[k + 37].direction) << name << k;
    }
    EXPECT_THROW(make_directions(sampling, 5, 4, 1), InputError);
    EXPECT_THROW(make_directions(sampling, -1, 4, 1), InputError);
    EXPECT_THROW(make_directions(sampling, 0, max_directions + 1, 1), InputError);
  }
}

/// Owen-scrambled nets: each of the 2^m boxes 2^-a x 2^-(m-a) holds one of 2^m points.
TEST(Directions, ScrambledPointsHaveOneInEachDyadicBox) {
  constexpr int m = 8;
  for (const Sampling sampling : {Sampling::scrambled_hammersley, Sampling::sobol}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto points = make_directions(sampling, 1 << m, seed);
      for (int a = 0; a <= m; ++a) {
        std::set<std::pair<int, int>> boxes;
        for (const auto& p : points) {
          boxes.emplace(static_cast<int>(std::ldexp(p.u, a)),
                        static_cast<int>(std::ldexp(p.v, m - a)));
        }
        EXPECT_EQ(boxes.size(), points.size()) << name_of(sampling) << seed << a;
      }
    }
  }
}

/// Each single scrambled point is uniform: moments over seeds, within five standard deviations.
TEST(Directions, ScrambledPointsAreUniformOverSeeds) {
  constexpr int seeds = 4000;
  for (const Sampling sampling : {Sampling::scrambled_hammersley, Sampling::sobol}) {
    for (const std::size_t k : {0U, 1U, 6U}) {
      double u = 0, v = 0, uu = 0, uv = 0;
      for (int seed = 0; seed < seeds; ++seed) {
        const auto p = make_directions(sampling, 7, static_cast<std::uint64_t>(seed))[k];
        u += p.u / seeds;
        v += p.v / seeds;
        uu += p.u * p.u / seeds;
        uv += p.u * p.v / seeds;
      }
      const double five = 5 / std::sqrt(seeds);
      EXPECT_NEAR(u, 1. / 2, five * 0.289);
      EXPECT_NEAR(v, 1. / 2, five * 0.289);
      EXPECT_NEAR(uu, 1. / 3, five * 0.298);
      EXPECT_NEAR(uv, 1. / 4, five * 0.221) << "coordinates are scrambled equally";
    }
  }
}

TEST(Directions, RotationsPreserveAnglesAndMatchTheirPoints) {
  const auto before = make_directions(Sampling::halton, 40, 0);
  const auto after = rotated(before, 5);
  for (std::size_t a = 0; a < before.size(); ++a) {
    EXPECT_NEAR(norm(after[a].direction), 1, 1e-15);
    EXPECT_NEAR(after[a].direction.z, 1 - 2 * after[a].v, 1e-15);
    const double s = std::sqrt(4 * after[a].v * (1 - after[a].v));
    EXPECT_NEAR(after[a].direction.x, s * std::cos(2 * M_PI * after[a].u), 1e-14);
    EXPECT_NEAR(after[a].direction.y, s * std::sin(2 * M_PI * after[a].u), 1e-14);
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_NEAR(dot(before[a].direction, before[b].direction),
                  dot(after[a].direction, after[b].direction), 2e-15);
    }
  }
  const auto volume = [](const std::vector<DirectionSample>& d) {
    return dot(cross(d[1].direction, d[2].direction), d[3].direction);
  };
  EXPECT_NEAR(volume(after), volume(before), 2e-15) << "a mirror image";
}

/// Uniform among rotations: the image of an axis has mean 0 and second moments 1/3, and the trace
/// has mean 0 and variance 1, which rotation angles uniform in [0, 2 pi) would not give.
TEST(Directions, RotationsAreUniform) {
  constexpr int seeds = 20000;
  const std::vector<DirectionSample> axes{
      {0, 0.5, {1, 0, 0}}, {0.25, 0.5, {0, 1, 0}}, {0, 0, {0, 0, 1}}};
  double mean = 0, mean_square = 0, trace = 0, trace2 = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto turned = rotated(axes, static_cast<std::uint64_t>(seed));
    const Vec3 z = turned[2].direction;
    mean += z.x / seeds;
    mean_square += z.x * z.x / seeds;
    const double t = turned[0].direction.x + turned[1].direction.y + turned[2].direction.z;
    trace += t / seeds;
    trace2 += t * t / seeds;
  }
  const double five = 5 / std::sqrt(seeds);
  EXPECT_NEAR(mean, 0, five * 0.58);
  EXPECT_NEAR(mean_square, 1. / 3, five * 0.3);
  EXPECT_NEAR(trace, 0, five * 1);
  EXPECT_NEAR(trace2, 1, five * 1.5);
}

TEST(Directions, ProgressiveOrderIsAPermutationWithUniformPrefixes) {
  const auto normals = make_directions(Sampling::fibonacci, 50, 0);
  for (const auto& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    for (const int count : {1, 2, 7, 100, 1024}) {
      const auto order = progressive_order(sampling, count);
      const std::set<int> all(order.begin(), order.end());
      EXPECT_EQ(static_cast<int>(all.size()), count);
      EXPECT_EQ(*all.begin(), 0);
      EXPECT_EQ(*all.rbegin(), count - 1);
    }
    // After any prefix, two-way, the cosine integral of each normal is about correct.
    const auto samples = make_directions(sampling, 1024, 3);
    const auto order = progressive_order(sampling, 1024);
    for (const auto& n : normals) {
      double sum = 0;
      for (std::size_t done = 1; done <= 1024; ++done) {
        sum += std::abs(dot(n.direction, at(samples, order[done - 1]).direction));
        if (done < 64) {
          continue;
        }
        const double error = 2 * sum / static_cast<double>(done) - 1;
        ASSERT_LT(std::abs(error), sampling == Sampling::random ? 0.5 : 0.2) << name << done;
      }
    }
  }
}

/// P_n f for f = max(n·omega, 0) and for the indicator of a cap, over set n of a scheme; the exact
/// means of both are known.
struct StepMeans {
  double cosine = 0, cap = 0;
};
constexpr double cosine_integral = 0.25, cap_integral = 0.3;

StepMeans means_over(const std::vector<DirectionSample>& set) {
  const Vec3 a = normalized({1, 2, 3}), b = normalized({-2, 1, 1});
  StepMeans means;
  for (const auto& d : set) {
    means.cosine += std::max(0.0, dot(a, d.direction)) / static_cast<double>(set.size());
    means.cap += (dot(b, d.direction) > 1 - 2 * cap_integral) / static_cast<double>(set.size());
  }
  return means;
}

/// The relative difference of the sides of eq. 46, for products of two and three consecutive
/// iterations.
double eq_46_defect(const std::vector<StepMeans>& steps) {
  double two = 0, three = 0;
  const auto count = static_cast<double>(steps.size() - 2);
  for (std::size_t n = 2; n < steps.size(); ++n) {
    two += steps[n].cap * steps[n - 1].cap / count;
    three += steps[n].cap * steps[n - 1].cosine * steps[n - 2].cap / count;
  }
  return std::max(std::abs(two / (cap_integral * cap_integral) - 1),
                  std::abs(three / (cap_integral * cosine_integral * cap_integral) - 1));
}

TEST(DirectionsOfIteration, SatisfyEquation46UnlessPlainHammersley) {
  constexpr int count = 4, steps = 4096;
  for (const auto& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    std::vector<StepMeans> means;
    for (int step = 0; step < steps; ++step) {
      means.push_back(means_over(directions_of_iteration(sampling, count, 5, step)));
    }
    const bool fails =
        sampling == Sampling::hammersley || sampling == Sampling::centered_hammersley;
    if (fails) {
      EXPECT_GT(eq_46_defect(means), 0.1) << name;
    } else {
      EXPECT_LT(eq_46_defect(means), 0.03) << name;
    }
  }
}

/// The paper's example: consecutive parts of one Hammersley sequence. The test also uses Sobol's
/// points in their order, which are as uniform but not independent.
TEST(DirectionsOfIteration, ConsecutivePartsOfASequenceViolateEquation46) {
  constexpr int count = 4, steps = 4096;
  for (const Sampling sampling : {Sampling::hammersley, Sampling::sobol}) {
    const auto all = make_directions(sampling, count * steps, 5);
    EXPECT_NEAR(means_over(all).cap, cap_integral, 1e-3);
    std::vector<StepMeans> means;
    for (auto at = all.begin(); at != all.end(); at += count) {
      means.push_back(means_over({at, at + count}));
    }
    EXPECT_GT(eq_46_defect(means), 0.05) << name_of(sampling);
  }
}

TEST(DirectionsOfIteration, DifferWhereTheySaySo) {
  for (const std::string& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    const Vec3 first = directions_of_iteration(sampling, 16, 1, 0).front().direction;
    const Vec3 second = directions_of_iteration(sampling, 16, 1, 1).front().direction;
    EXPECT_EQ(differs_by_iteration(sampling), !(first == second)) << name;
  }
}

/// The mean over iterations then has the error of all points of the sequence together.
TEST(DirectionsOfIteration, SetsOfOneSequenceUseEveryPointOnce) {
  for (const Sampling sampling : {Sampling::halton, Sampling::sobol}) {
    std::set<std::pair<double, double>> used, expected;
    for (int step = 0; step < 64; ++step) {
      for (const auto& d : directions_of_iteration(sampling, 5, 9, step)) {
        used.emplace(d.u, d.v);
      }
    }
    for (const auto& d : make_directions(sampling, 64 * 5, 9)) {
      expected.emplace(d.u, d.v);
    }
    EXPECT_EQ(used, expected) << name_of(sampling);
  }
}

TEST(Directions, RejectsInvalidCountsAndNames) {
  for (const auto& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    for (const int count : {0, -3, max_directions + 1}) {
      EXPECT_THROW(make_directions(sampling, count, 1), InputError);
      EXPECT_THROW(directions_of_iteration(sampling, count, 1, 1), InputError);
    }
  }
  EXPECT_THROW(directions_of_iteration(Sampling::random, 4, 1, -1), InputError);
  EXPECT_THROW(from_name<Sampling>("fibonaci"), InputError);
}

}  // namespace
}  // namespace transillum::directions_test
