// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/refined_cells.h"

#include <gtest/gtest.h>

#include <cmath>

namespace transillum::smooth_cells_test {
namespace {

constexpr double tolerance = 1e-12;

/// A square about (0.5, 0.5, z), turned by `angle`.
Corners square(double side, double z, double angle = 0) {
  Corners corners;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double c = 0.5 * side * std::cos(angle), s = 0.5 * side * std::sin(angle);
    corners.push_back({0.5 + c * u - s * v, 0.5 + s * u + c * v, z});
  }
  return corners;
}

double area(const std::vector<Corners>& cells) {
  double sum = 0;
  for (const Corners& cell : cells) {
    sum += norm(area_vector(cell));
  }
  return sum;
}

/// Edges at 0.25 and 0.75, half way to edges at 0 and 1: both are in line at 0.5.
TEST(SmoothCells, AreCutWhereParallelEdgesAreInLine) {
  const auto cells = smooth_cells(square(1, 0), square(1, 2), {square(0.5, 1)}, tolerance);
  ASSERT_EQ(cells.size(), 4U);
  for (const Corners& cell : cells) {
    EXPECT_NEAR(area({cell}), 0.25, 1e-12);
  }
}

TEST(SmoothCells, AreThePolygonItselfWithoutParallelEdges) {
  EXPECT_EQ(smooth_cells(square(1, 0), square(1, 2), {square(0.5, 1, 0.3)}, tolerance).size(), 1U);
  EXPECT_EQ(smooth_cells(square(1, 0), square(1, 2), {}, tolerance).size(), 1U);
}

TEST(SmoothCells, AreNotCutByShadowsThatMissThePolygon) {
  const auto cells = smooth_cells(square(0.2, 0), square(1, 2), {square(3, 1)}, tolerance);
  EXPECT_EQ(cells.size(), 1U);
}

/// Walls through a square, on it, above it and beside it.
TEST(SmoothCells, AreCutWhereBlockersMeetThePolygon) {
  const auto wall = [](double x, double low, double y = 0.2) {
    Corners corners;
    for (const auto& [along, z] : {std::pair{0.0, low}, {0.4, low}, {0.4, 1.0}, {0.0, 1.0}}) {
      corners.push_back({x, y + along, z});
    }
    return corners;
  };
  for (const double low : {-0.3, 0.0}) {
    const auto cells = smooth_cells(square(1, 0), square(0.3, 3, 0.2), {wall(0.9, low)}, tolerance);
    ASSERT_EQ(cells.size(), 2U) << low;
    EXPECT_NEAR(std::min(area({cells[0]}), area({cells[1]})), 0.1, 1e-12);
    EXPECT_NEAR(area(cells), 1, 1e-12);
  }
  for (const Corners& apart : {wall(0.9, 0.1), wall(0.9, 0, 1.1), wall(1.1, 0), wall(1, 0)}) {
    EXPECT_EQ(smooth_cells(square(1, 0), square(0.3, 3, 0.2), {apart}, tolerance).size(), 1U);
  }
}

TEST(SmoothCells, AreFewAndMakeUpThePolygon) {
  std::vector<Corners> blockers;
  for (int k = 0; k < 20; ++k) {
    const auto cells = smooth_cells(square(1, 0), square(1, 2), blockers, tolerance);
    EXPECT_NEAR(area(cells), 1, 1e-12);
    EXPECT_LE(cells.size(), 79U);  // 12 lines cut a convex polygon into at most 79 parts
    blockers.push_back(square(0.3 + 0.03 * k, 0.7 + 0.03 * k));
  }
}

}  // namespace
}  // namespace transillum::smooth_cells_test
