// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Sides of lines and meetings of lines on the grid, against exact fractions.
#include "visibility/queries/exact_side.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace transillum::exact_side_test {
namespace {

using Fraction = boost::multiprecision::cpp_rational;
using Digits = boost::multiprecision::cpp_bin_float_100;

struct FractionPoint {
  Fraction x, y;
};

FractionPoint exact(const GridPoint& p) { return {p.x, p.y}; }
FractionPoint operator-(const FractionPoint& p, const FractionPoint& q) {
  return {p.x - q.x, p.y - q.y};
}
Fraction cross(const FractionPoint& p, const FractionPoint& q) { return p.x * q.y - p.y * q.x; }

Fraction true_side(const GridLine& line, const FractionPoint& p) {
  return cross(exact(line.b) - exact(line.a), p - exact(line.a));
}

bool are_parallel(const GridLine& p, const GridLine& q) {
  return cross(exact(p.b) - exact(p.a), exact(q.b) - exact(q.a)) == 0;
}

/// The point on p where it meets q.
FractionPoint true_meeting(const GridLine& p, const GridLine& q) {
  const FractionPoint along = exact(p.b) - exact(p.a), across = exact(q.b) - exact(q.a);
  const Fraction t = cross(exact(q.a) - exact(p.a), across) / cross(along, across);
  return {p.a.x + t * along.x, p.a.y + t * along.y};
}

int sign_of(long double value) { return (value > 0) - (value < 0); }

void expect_rounded(long double found, const Fraction& truth) {
  ASSERT_EQ(sign_of(found), truth.sign());
  const Digits expected = Digits(numerator(truth)) / Digits(denominator(truth));
  ASSERT_LE(abs(Digits(found) - expected), 1e-15 * abs(expected)) << found;
}

/// Random points and lines on the grid, of all sizes, most of them nearly degenerate.
class RandomGrid {
 public:
  std::int64_t number(int bits) {
    const auto size = std::int64_t{1} << bits;
    return std::uniform_int_distribution<std::int64_t>(-size, size)(generator_);
  }
  GridPoint point(int bits) {
    const std::int64_t x = number(bits), y = number(bits);
    return {x, y};
  }
  int size() { return std::uniform_int_distribution<int>(1, 59)(generator_); }
  /// The point, or one at most a grid unit away in x and y.
  GridPoint near(const GridPoint& p) { return clamped(p.x + number(1), p.y + number(1)); }
  GridLine line() {
    for (;;) {
      const int bits = size();
      const GridLine made{point(bits), point(bits)};
      if (made.a.x != made.b.x || made.a.y != made.b.y) {
        return made;
      }
    }
  }
  /// A point on p's line, up to the grid's resolution.
  GridPoint beside(const GridLine& p) {
    const long double t = 3 * static_cast<long double>(number(30)) * 0x1p-30L;
    const auto at = [t](std::int64_t a, std::int64_t b) {
      const auto along = static_cast<long double>(b) - static_cast<long double>(a);
      return std::llrint(std::clamp(static_cast<long double>(a) + t * along, -0x1p59L, 0x1p59L));
    };
    return near(clamped(at(p.a.x, p.b.x), at(p.a.y, p.b.y)));
  }
  /// A line through two such points: nearly the same line as p.
  GridLine along(const GridLine& p) {
    for (;;) {
      const GridLine made{beside(p), beside(p)};
      if (made.a.x != made.b.x || made.a.y != made.b.y) {
        return made;
      }
    }
  }
  /// A line exactly through a point.
  GridLine through(const GridPoint& p) {
    for (;;) {
      const std::int64_t dx = number(28), dy = number(28), back = number(29), on = number(29);
      if ((dx == 0 && dy == 0) || back == on) {
        continue;
      }
      return {{p.x + back * dx, p.y + back * dy}, {p.x + on * dx, p.y + on * dy}};
    }
  }

 private:
  static GridPoint clamped(std::int64_t x, std::int64_t y) {
    constexpr auto most = std::int64_t{1} << 59;
    return {std::clamp(x, -most, most), std::clamp(y, -most, most)};
  }
  std::mt19937_64 generator_{17};
};

constexpr int trials = 4000;

TEST(ExactSide, IsCorrectForPoints) {
  RandomGrid random;
  int on_line = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const GridLine line = random.line();
    for (const GridPoint& p :
         {random.point(random.size()), random.beside(line), random.near(line.a), line.b}) {
      const Fraction truth = true_side(line, exact(p));
      expect_rounded(exact_side(line, p), truth);
      on_line += truth == 0;
    }
  }
  EXPECT_GT(on_line, trials);
}

void expect_side_of_meeting(const GridLine& line, const GridLine& p, const GridLine& q) {
  if (are_parallel(p, q)) {
    ASSERT_EQ(exact_side(line, p, q), 0);
  } else {
    expect_rounded(exact_side(line, p, q), true_side(line, true_meeting(p, q)));
  }
}

TEST(ExactSide, IsCorrectForIntersectionsOfLines) {
  RandomGrid random;
  for (int trial = 0; trial < trials; ++trial) {
    const GridLine line = random.line(), p = random.line(), q = random.line();
    expect_side_of_meeting(line, p, q);
    // Small angles, between two of the lines and among all three.
    expect_side_of_meeting(line, p, random.along(p));
    expect_side_of_meeting(line, p, random.along(line));
    expect_side_of_meeting(line, random.along(line), random.along(line));
  }
}

TEST(ExactSide, IsZeroWhereThreeLinesMeet) {
  RandomGrid random;
  for (int trial = 0; trial < trials; ++trial) {
    const GridPoint at = random.point(58);
    const GridLine line = random.through(at), p = random.through(at), q = random.through(at);
    ASSERT_EQ(exact_side(line, p, q), 0);
    // One grid unit off, the side is decided again.
    const GridPoint beside = random.near(at);
    expect_side_of_meeting(random.through(beside), p, q);
  }
}

TEST(ExactSide, IsCorrectAtTheCornersOfTheGrid) {
  constexpr auto far = std::int64_t{1} << 59;
  const GridLine diagonal{{-far, -far}, {far, far}}, other{{-far, far}, {far, -far}};
  const GridLine nearly{{-far, -far}, {far, far - 1}}, top{{far, far}, {-far, far}};
  for (const GridLine& line : {diagonal, other, nearly, top}) {
    for (const GridPoint& p : {diagonal.a, diagonal.b, other.a, other.b, nearly.b}) {
      expect_rounded(exact_side(line, p), true_side(line, exact(p)));
    }
    for (const GridLine& p : {diagonal, other, nearly, top}) {
      for (const GridLine& q : {diagonal, other, nearly, top}) {
        expect_side_of_meeting(line, p, q);
      }
    }
  }
}

void expect_meeting(const GridLine& p, const GridLine& q, const GridPoint& origin) {
  const Meeting found = exact_meeting(p, q, origin);
  ASSERT_EQ(found.parallel, are_parallel(p, q));
  if (found.parallel) {
    return;
  }
  const FractionPoint truth = true_meeting(p, q) - exact(origin);
  expect_rounded(found.x, truth.x);
  expect_rounded(found.y, truth.y);
}

TEST(ExactMeeting, IsCorrectForAnyAngle) {
  RandomGrid random;
  for (int trial = 0; trial < trials; ++trial) {
    const GridLine p = random.line();
    for (const GridLine& q : {random.line(), random.along(p), GridLine{p.a, random.near(p.b)}}) {
      if (q.a.x == q.b.x && q.a.y == q.b.y) {
        continue;
      }
      expect_meeting(p, q, random.point(random.size()));
      expect_meeting(p, q, p.a);
    }
  }
}

TEST(ExactMeeting, DetectsParallelLines) {
  RandomGrid random;
  for (int trial = 0; trial < trials; ++trial) {
    const GridPoint origin = random.point(58), d = random.point(27);
    if (d.x == 0 && d.y == 0) {
      continue;
    }
    const auto made = [&] {
      const GridPoint a = random.point(58);
      const std::int64_t far = 1 + std::abs(random.number(30));
      return GridLine{a, {a.x + far * d.x, a.y + far * d.y}};
    };
    const GridLine p = made(), q = made();
    EXPECT_TRUE(exact_meeting(p, q, origin).parallel);
    EXPECT_TRUE(exact_meeting(p, {q.b, q.a}, origin).parallel);
    EXPECT_TRUE(exact_meeting(p, p, origin).parallel);
    EXPECT_EQ(exact_side(made(), p, q), 0);
    // One grid unit changes the direction.
    EXPECT_FALSE(
        exact_meeting(p, {q.a, {q.b.x + (d.y != 0), q.b.y + (d.y == 0)}}, origin).parallel);
  }
}

}  // namespace
}  // namespace transillum::exact_side_test
