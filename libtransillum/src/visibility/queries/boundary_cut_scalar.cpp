// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of engine fast without SIMD instructions, one segment at a time. Each segment is
// clipped by all lines of the cutter (Cyrus and Beck's line clipping); what is left of it is its
// inside part, the rest goes into the outside segments. Crossings with each line are recorded, so
// that winding numbers at the cutter's corners follow (find_windings()).
#include <algorithm>
#include <cmath>

#include "visibility/queries/simd_backend.h"

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

/// A segment, clipped by the lines of the cutter one after another. The part inside the lines so
/// far runs from a + first u to a + last u, where u = b - a.
struct ClippedSegment {
  double ax, ay, bx, by;
  double first = 0, last = 1;
  /// The lines on which that part starts and ends, if any.
  std::size_t first_line = Cutter::max_edges, last_line = Cutter::max_edges;
  bool outer = false;  ///< wholly outside one of the lines
};

/// Clips a segment by line m and records how it meets the line, under the segment's `bit`.
void clip_by_line(const Cutter& cutter, std::size_t m, std::uint64_t bit, ClippedSegment& segment,
                  Crossings& crossings) {
  const double ax = segment.ax, ay = segment.ay, bx = segment.bx, by = segment.by;
  const double ux = bx - ax, uy = by - ay;
  const double dx = cutter.dx[m], dy = cutter.dy[m];
  const double tolerance = cutter.tolerance * cutter.length[m];
  const double a = (dx * ay - dy * ax) + cutter.c[m], b = (dx * by - dy * bx) + cutter.c[m];
  const bool a_in = a >= -tolerance, b_in = b >= -tolerance;
  segment.outer = segment.outer || (!a_in && !b_in);
  if (a_in || b_in) {
    crossings.inner |= bit;
  }
  if (a_in == b_in) {
    return;
  }
  double t = a / (a - b);
  if (a_in) {
    if (a <= tolerance) {
      t = 0;
    }
    crossings.out |= bit;
    if (t < segment.last) {
      segment.last = t;
      segment.last_line = m;
    }
  } else {
    if (b <= tolerance) {
      t = 1;
    }
    crossings.in |= bit;
    if (t > segment.first) {
      segment.first = t;
      segment.first_line = m;
    }
  }
  const double along = (dx * ax + dy * ay) + t * (dx * ux + dy * uy);
  if (along < cutter.middle[m]) {
    crossings.low |= bit;
  }
}

/// Stores the inside part of segment k, and returns its contribution to twice the area.
double store_inside(const ClippedSegment& segment, std::size_t k, const Cutter& cutter,
                    BoundaryCut& cut) {
  const double ax = segment.ax, ay = segment.ay, bx = segment.bx, by = segment.by;
  const double ux = bx - ax, uy = by - ay;
  const double first = segment.first, last = segment.last;
  const double in_x = first < 1 ? ax + first * ux : bx, in_y = first < 1 ? ay + first * uy : by;
  const double out_x = last < 1 ? ax + last * ux : bx, out_y = last < 1 ? ay + last * uy : by;
  cut.in_x[k] = in_x;
  cut.in_y[k] = in_y;
  cut.out_x[k] = out_x;
  cut.out_y[k] = out_y;
  return (in_x - cutter.pivot_x) * (out_y - cutter.pivot_y) -
         (in_y - cutter.pivot_y) * (out_x - cutter.pivot_x);
}

/// Which segments have a part inside the cutter, and where that starts or ends on one of its lines;
/// one bit per segment.
struct InsideParts {
  std::uint64_t inside = 0, starts = 0, ends = 0;
};

/// Appends the parts outside the cutter, in the order of the SIMD backends: of each eight segments,
/// first the parts before their inside parts, or the whole segments, then the parts after them.
void append_outside(const BoundarySegments& region, const InsideParts& parts,
                    const BoundaryCut& cut, BoundarySegments& outside) {
  for (std::size_t g = 0; g < region.count; g += 8) {
    const std::size_t end = std::min(g + 8, region.count);
    for (std::size_t k = g; k < end; ++k) {
      if ((parts.inside >> k & 1) == 0) {
        outside.add(region.ax[k], region.ay[k], region.bx[k], region.by[k]);
      } else if ((parts.starts >> k & 1) != 0) {
        outside.add(region.ax[k], region.ay[k], cut.in_x[k], cut.in_y[k]);
      }
    }
    for (std::size_t k = g; k < end; ++k) {
      if ((parts.ends >> k & 1) != 0) {
        outside.add(cut.out_x[k], cut.out_y[k], region.bx[k], region.by[k]);
      }
    }
  }
}

bool cut_scalar(const BoundarySegments& region, const Cutter& cutter, BoundaryCut& cut,
                BoundarySegments& outside) {
  LineCrossings lines;
  reset(lines, cut, cutter.count);
  std::array<double, 8> twice_area{};
  InsideParts parts;
  for (std::size_t k = 0; k < region.count; ++k) {
    const std::uint64_t bit = std::uint64_t{1} << k;
    ClippedSegment segment{region.ax[k], region.ay[k], region.bx[k], region.by[k]};
    for (std::size_t m = 0; m < cutter.count; ++m) {
      clip_by_line(cutter, m, bit, segment, lines[m]);
    }
    if (segment.outer || segment.first > segment.last) {
      continue;
    }
    parts.inside |= bit;
    if (segment.first_line < Cutter::max_edges) {
      cut.enters[segment.first_line] |= bit;
      parts.starts |= bit;
    }
    if (segment.last_line < Cutter::max_edges) {
      cut.leaves[segment.last_line] |= bit;
      parts.ends |= bit;
    }
    twice_area[k % 8] += store_inside(segment, k, cutter, cut);
  }
  if (is_outside(lines, cutter.count)) {
    return false;
  }
  cut.inside = parts.inside;
  outside.count = 0;
  append_outside(region, parts, cut, outside);
  cut.twice_area = sum_of_eight(twice_area);
  find_windings(lines, cutter.count, cut);
  return true;
}

Extent extent_scalar(const BoundarySegments& region) {
  Extent most;
  most.fill(-HUGE_VAL);
  for (std::size_t k = 0; k < region.count; ++k) {
    const double x = region.ax[k], y = region.ay[k];
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
