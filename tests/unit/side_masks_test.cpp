// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The inner loop of the fast engine: all ways give the same bits.
#include "visibility/side_masks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace transillum {
namespace {

constexpr std::size_t most_corners = 40, most_lines = 8;

template <class Real>
struct Input {
  alignas(64) std::array<Real, most_corners> x, y;
  std::size_t corner_count, line_count;
  std::array<DirectedLine<Real>, most_lines> lines;
  std::array<DirectedRef, most_lines> refs;
  Real error;
};

struct Result {
  std::size_t looked_at = 0;
  std::array<Sides, most_lines> sides;  ///< untouched beyond the line where it stopped
};

constexpr Sides untouched{0x5555555555555555, 0xaaaaaaaaaaaaaaaa};

void expect_same(const Result& a, const Result& b) {
  ASSERT_EQ(a.looked_at, b.looked_at);
  for (std::size_t k = 0; k < most_lines; ++k) {
    ASSERT_EQ(a.sides[k].left, b.sides[k].left) << "line " << k;
    ASSERT_EQ(a.sides[k].right, b.sides[k].right) << "line " << k;
  }
}

template <class Real, class Find>
Result found(Find find, const Input<Real>& input) {
  Result result;
  result.sides.fill(untouched);
  result.looked_at = find(input.x.data(), input.y.data(), input.corner_count, input.lines.data(),
                          input.refs.data(), input.line_count, input.error, result.sides.data());
  return result;
}

/// What is asked for, corner by corner.
template <class Real>
Result plain(const Input<Real>& input) {
  Result result;
  result.sides.fill(untouched);
  for (std::size_t k = 0; k < input.line_count; ++k) {
    const auto& line = input.lines[static_cast<std::size_t>(input.refs[k] / 2)];
    const bool turned = input.refs[k] % 2 != 0;
    Sides sides;
    std::size_t on_right = 0;
    for (std::size_t g = 0; g < input.corner_count; ++g) {
      const Real determinant = line.dx * input.y[g] - line.dy * input.x[g] + line.c;
      if (std::abs(determinant) <= line.length * (line.slack + input.error)) continue;
      const bool left = (determinant > 0) != turned;
      (left ? sides.left : sides.right) |= std::uint64_t{1} << g;
      on_right += !left;
    }
    result.sides[k] = sides;
    if (on_right == input.corner_count) {
      result.looked_at = k;
      return result;
    }
  }
  result.looked_at = input.line_count;
  return result;
}

/// Small whole numbers, so that determinants lie exactly on the bound at times, or any numbers, so
/// that they are rounded; behind the last corner lies what must not count.
template <class Real>
class InputGame {
 public:
  Input<Real> input(std::size_t corner_count, std::size_t line_count) {
    Input<Real> made;
    made.corner_count = corner_count;
    made.line_count = line_count;
    is_whole_ = pick(2) == 0;
    made.x.fill(std::numeric_limits<Real>::quiet_NaN());
    made.y.fill(pick(2) == 0 ? Real{1e300} : -std::numeric_limits<Real>::infinity());
    for (std::size_t g = 0; g < corner_count; ++g) {
      made.x[g] = number();
      made.y[g] = number();
    }
    made.error = is_whole_ ? 1 : Real{0.5};
    for (std::size_t k = 0; k < most_lines; ++k) {
      const Real dx = number(), dy = number(), slack = is_whole_ ? pick(3) : Real{0.01};
      // Far to one side are lines that have all corners on their left or on their right.
      const Real c = pick(4) == 0 ? (pick(2) == 0 ? 1000 : -1000) : number();
      made.lines[k] = {dx, dy, c, std::abs(dx) + std::abs(dy), slack, 0, 0, 0};
    }
    for (DirectedRef& ref : made.refs) ref = pick(2 * most_lines);
    return made;
  }

 private:
  int pick(int count) { return static_cast<int>(generator_() % static_cast<unsigned>(count)); }
  Real number() {
    if (is_whole_) return static_cast<Real>(pick(11) - 5);
    return std::uniform_real_distribution<Real>(-5, 5)(generator_);
  }
  std::mt19937_64 generator_{5};
  bool is_whole_ = false;
};

/// How often what ought to be met was met.
struct Met {
  int stops = 0, unsure = 0, exactly_on_bound = 0;

  template <class Real>
  void take(const Input<Real>& input, const Result& result) {
    stops += result.looked_at < input.line_count;
    for (std::size_t k = 0; k < result.looked_at; ++k) {
      const auto& line = input.lines[static_cast<std::size_t>(input.refs[k] / 2)];
      for (std::size_t g = 0; g < input.corner_count; ++g) {
        const Real size = std::abs(line.dx * input.y[g] - line.dy * input.x[g] + line.c);
        const Real bound = line.length * (line.slack + input.error);
        unsure += size <= bound;
        exactly_on_bound += size == bound && bound > 0;
      }
    }
  }
};

template <class Real, class Find>
void expect_sides(Find find) {
  InputGame<Real> game;
  Met met;
  for (std::size_t corner_count = 1; corner_count <= most_corners; ++corner_count) {
    for (std::size_t line_count = 1; line_count <= most_lines; ++line_count) {
      for (int round = 0; round < 20; ++round) {
        SCOPED_TRACE(corner_count);
        const Input<Real> input = game.input(corner_count, line_count);
        const Result result = found(find, input);
        expect_same(result, plain(input));
        met.take(input, result);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(met.stops, 1000);
  EXPECT_GT(met.unsure, 10000);
  EXPECT_GT(met.exactly_on_bound, 1000);
}

TEST(SideMasks, AreThoseOfAPlainLoopInLongDoubles) {
  expect_sides<long double>(find_sides<long double>);
}

TEST(SideMasks, AreThoseOfAPlainLoopInDoubles) { expect_sides<double>(find_sides<double>); }

TEST(SideMasks, AreTheSameInEveryWayThatTheProcessorHas) {
  const std::vector<FindSidesWay> ways = find_sides_ways();
  ASSERT_FALSE(ways.empty());
  EXPECT_STREQ(ways.back().name, "one by one");
  for (const FindSidesWay& way : ways) {
    SCOPED_TRACE(way.name);
    expect_sides<double>(way.find);
  }
}

}  // namespace
}  // namespace transillum
