// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr double max_divisions = 1e8;

/// An area that exceeds its limit by rounding only needs no further division.
constexpr double slack = 1 - 1e-9;

double length(const std::vector<Vec3>& points, PointId a, PointId b) {
  return norm(at(points, a) - at(points, b));
}

int divisions(double required) {
  return static_cast<int>(std::clamp(std::ceil(required * slack), 1.0, max_divisions));
}

Vec3 bilinear(const std::array<Vec3, 4>& c, double u, double v) {
  return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
}

/// The largest cell is at a corner, since the Jacobian of the bilinear map is linear.
double largest_cell_area(const std::array<Vec3, 4>& c, int columns, int rows) {
  const double du = 1.0 / columns, dv = 1.0 / rows;
  double largest = 0;
  for (const double u : {0.0, 1 - du}) {
    for (const double v : {0.0, 1 - dv}) {
      const Vec3 diagonal = bilinear(c, u + du, v + dv) - bilinear(c, u, v);
      const Vec3 other = bilinear(c, u, v + dv) - bilinear(c, u + du, v);
      largest = std::max(largest, 0.5 * norm(cross(diagonal, other)));
    }
  }
  return largest;
}

std::array<Vec3, 4> four_corners(const std::vector<Vec3>& points,
                                 const std::vector<PointId>& outline) {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = at(points, outline[i]);
  }
  return corners;
}

/// The point a + k/n (b - a), computed from the end with the smaller number.
PointId point_on_edge(PointTable& table, PointId a, PointId b, int k, int n) {
  if (k == 0) {
    return a;
  }
  if (k == n) {
    return b;
  }
  if (a > b) {
    std::swap(a, b);
    k = n - k;
  }
  const Vec3 from = at(table.points(), a);
  const Vec3 to = at(table.points(), b);
  return table.id_of(from + (static_cast<double>(k) / n) * (to - from));
}

std::vector<std::vector<PointId>> quadrilateral_cells(PointTable& table, const CellGrid& grid) {
  const std::vector<PointId>& o = grid.outline;
  const std::array<Vec3, 4> corners = four_corners(table.points(), o);
  const int n = grid.columns, m = grid.rows;
  const auto point = [&](int i, int j) {
    if (j == 0) {
      return point_on_edge(table, o[0], o[1], i, n);
    }
    if (j == m) {
      return point_on_edge(table, o[3], o[2], i, n);
    }
    if (i == 0) {
      return point_on_edge(table, o[0], o[3], j, m);
    }
    if (i == n) {
      return point_on_edge(table, o[1], o[2], j, m);
    }
    return table.id_of(bilinear(corners, static_cast<double>(i) / n, static_cast<double>(j) / m));
  };
  std::vector<std::vector<PointId>> cells;
  std::vector<PointId> below, above;
  for (int i = 0; i <= n; ++i) {
    above.push_back(point(i, 0));
  }
  for (int j = 0; j < m; ++j) {
    below.swap(above);
    above.clear();
    for (int i = 0; i <= n; ++i) {
      above.push_back(point(i, j + 1));
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      cells.push_back({below[i], below[i + 1], above[i + 1], above[i]});
    }
  }
  return cells;
}

std::vector<std::vector<PointId>> triangle_cells(PointTable& table, const CellGrid& grid) {
  const std::vector<PointId>& o = grid.outline;
  const auto corner = [&](int i) { return at(table.points(), at(o, i)); };
  const Vec3 a = corner(0), b = corner(1), c = corner(2);
  const int n = grid.columns;
  // Row j has n - j + 1 points; point (i, j) is a + i/n (b - a) + j/n (c - a).
  const auto point = [&](int i, int j) {
    if (j == 0) {
      return point_on_edge(table, o[0], o[1], i, n);
    }
    if (i == 0) {
      return point_on_edge(table, o[0], o[2], j, n);
    }
    if (i + j == n) {
      return point_on_edge(table, o[1], o[2], j, n);
    }
    return table.id_of(a + (static_cast<double>(i) / n) * (b - a) +
                       (static_cast<double>(j) / n) * (c - a));
  };
  std::vector<std::vector<PointId>> cells;
  std::vector<PointId> below, above;
  for (int i = 0; i <= n; ++i) {
    above.push_back(point(i, 0));
  }
  for (int j = 0; j < n; ++j) {
    below.swap(above);
    above.clear();
    for (int i = 0; i <= n - j - 1; ++i) {
      above.push_back(point(i, j + 1));
    }
    for (std::size_t i = 0; i < above.size(); ++i) {
      cells.push_back({below[i], below[i + 1], above[i]});
      if (i + 1 < above.size()) {
        cells.push_back({below[i + 1], above[i + 1], above[i]});
      }
    }
  }
  return cells;
}

}  // namespace

CellGrid choose_grid(const std::vector<Vec3>& points, std::vector<PointId> outline, double area,
                     double max_area) {
  CellGrid grid{std::move(outline)};
  const std::vector<PointId>& o = grid.outline;
  const double cells = area / max_area;
  if (o.size() == 3) {
    grid.columns = divisions(std::sqrt(cells));
    return grid;
  }
  const double width = std::max(length(points, o[0], o[1]), length(points, o[2], o[3]));
  const double height = std::max(length(points, o[1], o[2]), length(points, o[3], o[0]));
  grid.columns = divisions(std::sqrt(cells * (width / height)));
  grid.rows = divisions(cells / grid.columns);
  const std::array<Vec3, 4> corners = four_corners(points, o);
  while (grid.columns < max_divisions && grid.rows < max_divisions &&
         largest_cell_area(corners, grid.columns, grid.rows) * slack > max_area) {
    // Grow by a factor, so that a very fine grid takes few rounds.
    int& coarser = width / grid.columns > height / grid.rows ? grid.columns : grid.rows;
    coarser += 1 + coarser / 64;
  }
  return grid;
}

std::vector<std::vector<PointId>> make_cells(PointTable& table, const CellGrid& grid) {
  return grid.outline.size() == 3 ? triangle_cells(table, grid) : quadrilateral_cells(table, grid);
}

}  // namespace transillum
