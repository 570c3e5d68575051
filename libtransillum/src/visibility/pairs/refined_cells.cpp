// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/refined_cells.h"

#include <array>
#include <cmath>
#include <utility>

namespace transillum {

RefinedCells::RefinedCells(const FacingPolygons& facing, bool p_is_sampled, ByPoints by_points)
    : RefinedCells(facing, p_is_sampled, std::move(by_points), polygon_exchange(facing)) {}

RefinedCells::RefinedCells(const FacingPolygons& facing, bool p_is_sampled, ByPoints by_points,
                           double whole)
    : facing_(facing),
      p_is_sampled_(p_is_sampled),
      whole_(whole),
      by_points_(std::move(by_points)) {}

double RefinedCells::exact(Outline cell) {
  (p_is_sampled_ ? facing_.p : facing_.q).assign(cell.begin(), cell.end());
  return polygon_exchange(facing_);
}

bool RefinedCells::misses(double free, double exact) const {
  constexpr double tolerated = 0.01;
  return std::abs(free - exact) > tolerated * whole_;
}

RefinedCells::Exchange RefinedCells::operator()(Outline cell) {
  constexpr int most_divisions = 8;
  Exchange sum;
  for (std::size_t k = 1; k + 1 < cell.size(); ++k) {
    add(std::array{cell[0], cell[k], cell[k + 1]}, most_divisions, sum);
  }
  return sum;
}

void RefinedCells::add(Outline triangle, int most_divisions, Exchange& sum) {
  constexpr double tolerated = 1e-3;
  constexpr int divisions = 4;
  const PointSums found = by_points_(triangle, divisions);
  const double free = exact(triangle);
  if (most_divisions > 0 && std::abs(found.free - free) > tolerated * whole_) {
    const Vec3 &a = triangle[0], &b = triangle[1], &c = triangle[2];
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    const std::array<std::array<Vec3, 3>, 4> parts{
        {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    for (const auto& part : parts) {
      add(part, most_divisions - 1, sum);
    }
    return;
  }
  const auto area_of = [&](const PointSums& sums) {
    return sums.free > 0 ? free * sums.seen / sums.free : 0.0;
  };
  const double area = area_of(found);
  const PointSums half = by_points_(triangle, divisions / 2);
  sum.area += area;
  sum.error += std::abs(area - area_of(half)) / 3;
  for (std::size_t a = 0; a < 2; ++a) {
    const auto moment_of = [&](const PointSums& sums) {
      return sums.free > 0 ? free * sums.moments[a] / sums.free : 0.0;
    };
    const double moment = moment_of(found);
    sum.moments[a] += moment;
    sum.moment_errors[a] += std::abs(moment - moment_of(half)) / 3;
  }
}

}  // namespace transillum
