// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// BoundaryView: dividing a region that has more segments than BoundaryCut has bits. A line divides
// it in two; both parts have the points where segments cross the line, to the last bit.
#include <algorithm>
#include <array>

#include "visibility/queries/boundary_view.h"

namespace transillum {
namespace {

/// A crossing of the region's boundary and the dividing line.
struct LineCrossing {
  double along;  ///< position on the line
  int change;    ///< winding number after it minus before, in the order of `along`
};

using Coordinates = std::array<double, BoundarySegments::capacity>;

/// A line across an axis, and the number of segments that cross it.
struct DividingLine {
  double at;
  std::size_t crossings;
};

/// The line through the median of the segments' first points.
DividingLine median_line(const Coordinates& a, const Coordinates& b, std::size_t count) {
  Coordinates sorted = a;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(count));
  DividingLine line{*middle, 0};
  for (std::size_t k = 0; k < count; ++k) {
    line.crossings += (a[k] < line.at) != (b[k] < line.at) ? 1 : 0;
  }
  return line;
}

double twice_area_of(const BoundarySegments& segments) {
  double twice_area = 0;
  const double x = segments.ax[0], y = segments.ay[0];
  for (std::size_t k = 0; k < segments.count; ++k) {
    twice_area +=
        (segments.ax[k] - x) * (segments.by[k] - y) - (segments.ay[k] - y) * (segments.bx[k] - x);
  }
  return twice_area;
}

}  // namespace

bool BoundaryView::divide() {
  constexpr int most_parts = 16;
  for (int part = 0; is_crowded(); ++part) {
    Waiting high;
    if (part == most_parts || !halve(high.segments, high.area)) {
      failure_ = QueryFailure::crowded;
      return false;
    }
    waiting_.push_back(high);
  }
  find_window();
  return true;
}

void BoundaryView::next_part() {
  *region_ = waiting_.back().segments;
  region_area_ = waiting_.back().area;
  waiting_.pop_back();
  if (!done()) {
    find_window();
  }
}

/// Leaves the part of the region below a line along an axis, and returns the part above. Returns
/// false if the parts have too many segments or overlap themselves by rounding.
bool BoundaryView::halve(BoundarySegments& high, double& high_area) {
  const BoundarySegments& whole = *region_;
  BoundarySegments& low = *next_region_;
  const DividingLine across_x = median_line(whole.ax, whole.bx, whole.count);
  const DividingLine across_y = median_line(whole.ay, whole.by, whole.count);
  const bool by_x = across_x.crossings <= across_y.crossings;
  const double limit = by_x ? across_x.at : across_y.at;
  std::array<LineCrossing, BoundarySegments::capacity> crossings;
  std::size_t crossing_count = 0;
  low.count = high.count = 0;
  for (std::size_t k = 0; k < whole.count; ++k) {
    const double ax = whole.ax[k], ay = whole.ay[k], bx = whole.bx[k], by = whole.by[k];
    const double a = by_x ? ax : ay, b = by_x ? bx : by;
    if (low.count + 2 > BoundarySegments::capacity || high.count + 2 > BoundarySegments::capacity) {
      return false;
    }
    if ((a < limit) == (b < limit)) {
      (a < limit ? low : high).add(ax, ay, bx, by);
      continue;
    }
    const double t = (limit - a) / (b - a);
    const double x = by_x ? limit : ax + t * (bx - ax), y = by_x ? ay + t * (by - ay) : limit;
    (a < limit ? low : high).add(ax, ay, x, y);
    (a < limit ? high : low).add(x, y, bx, by);
    // The region is on the left of the segment.
    crossings[crossing_count++] = {by_x ? y : x, (a < limit) == by_x ? 1 : -1};
  }
  std::sort(crossings.begin(), crossings.begin() + static_cast<std::ptrdiff_t>(crossing_count),
            [](const LineCrossing& p, const LineCrossing& q) {
              return p.along != q.along ? p.along < q.along : p.change > q.change;
            });
  int winding = 0;
  for (std::size_t k = 0; k + 1 < crossing_count; ++k) {
    winding += crossings[k].change;
    const double from = crossings[k].along, to = crossings[k + 1].along;
    if (winding == 0 || from == to) {
      continue;
    }
    if (winding != 1 || low.count == BoundarySegments::capacity ||
        high.count == BoundarySegments::capacity) {
      return false;
    }
    if (by_x) {
      low.add(limit, from, limit, to);
      high.add(limit, to, limit, from);
    } else {
      low.add(to, limit, from, limit);
      high.add(from, limit, to, limit);
    }
  }
  if (low.count == 0 || high.count == 0 || high.count >= whole.count || low.count >= whole.count) {
    return false;
  }
  high_area = per_area_ * 0.5 * twice_area_of(high);
  region_area_ -= high_area;
  std::swap(region_, next_region_);
  return true;
}

}  // namespace transillum
