// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of the fast engine, one segment at a time.
#include <algorithm>
#include <cmath>

#include "visibility/fast/simd_backend.h"

namespace transillum {

namespace {

void set_scalar(Cutter& cutter, const GridPoint* corners, std::size_t count,
                const GridPoint& origin, double far) {
  cutter.count = count;
  std::array<double, 8> perimeter{};
  bool any_far = false;
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint &a = corners[k], &b = corners[k + 1 < count ? k + 1 : 0];
    const auto x = static_cast<double>(a.x - origin.x), y = static_cast<double>(a.y - origin.y);
    const auto dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    cutter.x[k] = x;
    cutter.y[k] = y;
    cutter.dx[k] = dx;
    cutter.dy[k] = dy;
    cutter.c[k] = dy * x - dx * y;
    cutter.middle[k] = (dx * x + dy * y) + 0.5 * (dx * dx + dy * dy);
    cutter.length[k] = std::abs(dx) + std::abs(dy);
    perimeter[k % 8] += cutter.length[k];
    any_far = any_far || std::abs(x) + std::abs(y) > far;
  }
  cutter.perimeter = sum_of_eight(perimeter);
  if (any_far) {
    recompute_far_lines(cutter, corners, origin, far);
  }
}

bool cut_scalar(const BoundarySegments& outline, const Cutter& cutter, BoundaryCut& cut,
                BoundarySegments& outside) {
  LineCrossings lines{};
  std::array<double, 8> twice_area{};
  std::uint64_t inside = 0, starts = 0, ends = 0;
  for (std::size_t m = 0; m < cutter.count; ++m) {
    cut.enters[m] = cut.leaves[m] = 0;
  }
  for (std::size_t k = 0; k < outline.count; ++k) {
    const std::uint64_t bit = std::uint64_t{1} << k;
    const double ax = outline.ax[k], ay = outline.ay[k], bx = outline.bx[k], by = outline.by[k];
    const double ux = bx - ax, uy = by - ay;
    double first = 0, last = 1;
    std::size_t first_line = Cutter::max_edges, last_line = Cutter::max_edges;
    bool outer = false;
    for (std::size_t m = 0; m < cutter.count; ++m) {
      Crossings& crossings = lines[m];
      const double dx = cutter.dx[m], dy = cutter.dy[m];
      const double tolerance = cutter.tolerance * cutter.length[m];
      const double a = (dx * ay - dy * ax) + cutter.c[m], b = (dx * by - dy * bx) + cutter.c[m];
      const bool a_in = a >= -tolerance, b_in = b >= -tolerance;
      outer = outer || (!a_in && !b_in);
      if (a_in || b_in) {
        crossings.inner |= bit;
      }
      if (a_in == b_in) {
        continue;
      }
      double t = a / (a - b);
      if (a_in) {
        if (a <= tolerance) {
          t = 0;
        }
        crossings.out |= bit;
        if (t < last) {
          last = t;
          last_line = m;
        }
      } else {
        if (b <= tolerance) {
          t = 1;
        }
        crossings.in |= bit;
        if (t > first) {
          first = t;
          first_line = m;
        }
      }
      const double along = (dx * ax + dy * ay) + t * (dx * ux + dy * uy);
      if (along < cutter.middle[m]) {
        crossings.low |= bit;
      }
    }
    if (outer || first > last) {
      continue;
    }
    inside |= bit;
    if (first_line < Cutter::max_edges) {
      cut.enters[first_line] |= bit;
      starts |= bit;
    }
    if (last_line < Cutter::max_edges) {
      cut.leaves[last_line] |= bit;
      ends |= bit;
    }
    const double in_x = first < 1 ? ax + first * ux : bx, in_y = first < 1 ? ay + first * uy : by;
    const double out_x = last < 1 ? ax + last * ux : bx, out_y = last < 1 ? ay + last * uy : by;
    twice_area[k % 8] += (in_x - cutter.pivot_x) * (out_y - cutter.pivot_y) -
                         (in_y - cutter.pivot_y) * (out_x - cutter.pivot_x);
    cut.in_x[k] = in_x;
    cut.in_y[k] = in_y;
    cut.out_x[k] = out_x;
    cut.out_y[k] = out_y;
  }
  for (std::size_t m = 0; m < cutter.count; ++m) {
    if (lines[m].inner == 0) {
      return false;
    }
  }
  // Of eight segments first what comes before their parts inside, or all, then what comes behind.
  outside.count = 0;
  for (std::size_t g = 0; g < outline.count; g += 8) {
    const std::size_t end = std::min(g + 8, outline.count);
    for (std::size_t k = g; k < end; ++k) {
      if ((inside >> k & 1) == 0) {
        outside.add(outline.ax[k], outline.ay[k], outline.bx[k], outline.by[k]);
      } else if ((starts >> k & 1) != 0) {
        outside.add(outline.ax[k], outline.ay[k], cut.in_x[k], cut.in_y[k]);
      }
    }
    for (std::size_t k = g; k < end; ++k) {
      if ((ends >> k & 1) != 0) {
        outside.add(cut.out_x[k], cut.out_y[k], outline.bx[k], outline.by[k]);
      }
    }
  }
  cut.twice_area = sum_of_eight(twice_area);
  find_windings(lines, cutter.count, cut);
  return true;
}

Extent extent_scalar(const BoundarySegments& outline) {
  Extent most;
  most.fill(-HUGE_VAL);
  for (std::size_t k = 0; k < outline.count; ++k) {
    const double x = outline.ax[k], y = outline.ay[k];
    const std::array<double, 4> along{x, y, x + y, x - y};
    for (std::size_t d = 0; d < 4; ++d) {
      most[d] = std::max(most[d], along[d]);
      most[d + 4] = std::max(most[d + 4], -along[d]);
    }
  }
  return most;
}

}  // namespace

SimdBackend scalar_backend() { return {"scalar", set_scalar, cut_scalar, extent_scalar}; }

}  // namespace transillum
