// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Choice of a splitting plane for BspBuilder: collects candidate normals, and sweeps over the
// offsets along each. The cost of a plane is the number of polygons it cuts per bit of order gained
// (decisions/0004-choice-of-planes.md).
#include "visibility/bsp/plane_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr std::size_t largest_sample = 1024;
constexpr std::size_t polygon_normals = 8;
constexpr std::size_t edge_normals = 8;
constexpr std::size_t line_normals = 8;
/// Cost of a plane that cuts nothing, in cuts: keeps the tree from degenerating to a list of planes
/// that split off one polygon each.
constexpr double cost_of_a_node = 0.3;

/// Order gained by a plane, in bits: by how much it reduces the information that sorting the
/// polygons requires.
double bits(double below, double above) {
  const double n = below + above;
  const auto term = [n](double part) { return part > 0 ? part * std::log2(n / part) : 0.0; };
  return term(below) + term(above);
}

}  // namespace

void PlaneSearch::clear() {
  planes_.clear();
  begin_.clear();
  points_.clear();
}

void PlaneSearch::add_polygon(const BspTree::Plane& plane) {
  planes_.push_back(plane);
  begin_.push_back(static_cast<std::uint32_t>(points_.size()));
}

Vec3 PlaneSearch::center_of(std::int32_t polygon) const {
  const auto p = static_cast<std::size_t>(polygon);
  return 0.5 * (points_[begin_[p]] + points_[(begin_[p] + begin_[p + 1]) / 2]);
}

PlaneSearch::Choice PlaneSearch::best() {
  begin_.push_back(static_cast<std::uint32_t>(points_.size()));
  best_cost_ = std::numeric_limits<double>::infinity();
  // The plane of a polygon is always a valid choice.
  best_ = {planes_[0], 0};
  if (planes_.size() > 1) {
    collect_sample();
    collect_normals();
    for (const Vec3& normal : normals_) {
      sweep(normal);
    }
  }
  return best_;
}

void PlaneSearch::collect_sample() {
  sample_.clear();
  const std::size_t step = planes_.size() / largest_sample + 1;
  for (std::size_t p = 0; p < planes_.size(); p += step) {
    sample_.push_back(static_cast<std::int32_t>(p));
  }
}

void PlaneSearch::collect_normals() {
  normals_ = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::size_t n = sample_.size();
  const std::size_t own = std::min(n, polygon_normals);
  for (std::size_t k = 0; k < own; ++k) {
    normals_.push_back(at(planes_, sample_[k * n / own]).normal);
  }
  if (n <= 4) {
    return;
  }
  // Planes parallel to two edges: planes through rings of corners split round or box-like objects
  // without cuts.
  const auto edge = [&](std::size_t of_sample, std::size_t number) {
    const auto p = static_cast<std::size_t>(sample_[of_sample % n]);
    const std::uint32_t count = begin_[p + 1] - begin_[p];
    return points_[begin_[p] + (number + 1) % count] - points_[begin_[p] + number % count];
  };
  for (std::size_t k = 0; k < edge_normals; ++k) {
    const std::size_t here = (2 * k + 1) * n / (2 * edge_normals);
    const Vec3 a = edge(here, k);
    const Vec3 b = edge(here + 1 + k % 3, k / 2);
    const Vec3 across = cross(a, b);
    if (norm(across) > 1e-3 * norm(a) * norm(b)) {
      normals_.push_back(normalized(across));
    }
  }
  // Normals between polygons far apart in the list: neighbors in the list are often neighbors in
  // space.
  for (std::size_t k = 0; k < line_normals; ++k) {
    const std::size_t a = k * n / line_normals;
    const std::size_t b = (a + n / 2 + k * n / (3 * line_normals)) % n;
    const Vec3 between = center_of(sample_[a]) - center_of(sample_[b]);
    const double length = norm(between);
    if (length > thickness_) {
      normals_.push_back(between / length);
    }
  }
}

/// Collects the intervals that the sample's polygons cover along the normal, sorted by their lower
/// ends, and their upper ends, sorted.
void PlaneSearch::collect_intervals(const Vec3& normal) {
  intervals_.clear();
  ends_.clear();
  for (const std::int32_t p : sample_) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::uint32_t c = at(begin_, p); c < at(begin_, p + 1); ++c) {
      const double along = dot(normal, points_[c]);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    // A polygon that reaches beyond the plane by no more than the thickness does not cross it.
    if (high - low > 2 * thickness_) {
      low += thickness_;
      high -= thickness_;
    } else {
      low = high = 0.5 * (low + high);
    }
    intervals_.push_back({low, high, p});
    ends_.push_back(high);
  }
  std::sort(intervals_.begin(), intervals_.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::sort(ends_.begin(), ends_.end());
}

/// Considers all offsets along one normal.
void PlaneSearch::sweep(const Vec3& normal) {
  collect_intervals(normal);
  const std::size_t n = intervals_.size();
  std::size_t ended = 0;  // intervals that end at or below the start of the last one
  for (std::size_t started = 1; started <= n; ++started) {
    const Interval& last = intervals_[started - 1];
    if (last.high == last.low) {
      consider_plane_of(normal, last);
    }
    while (ended < n && ends_[ended] <= last.low) {
      ++ended;
    }
    consider_gap(normal, started, ended);
  }
}

/// Considers the plane of a polygon perpendicular to the normal.
void PlaneSearch::consider_plane_of(const Vec3& normal, const Interval& interval) {
  const std::size_t n = intervals_.size();
  const double offset = interval.low;
  const auto below = static_cast<std::size_t>(
      std::upper_bound(ends_.begin(), ends_.end(), offset + thickness_) - ends_.begin());
  const auto above_from = static_cast<std::size_t>(
      std::lower_bound(intervals_.begin(), intervals_.end(), offset - thickness_,
                       [](const Interval& i, double low) { return i.low < low; }) -
      intervals_.begin());
  // `below` and `above` both count the polygons in the plane.
  const double in_plane = static_cast<double>(below + (n - above_from)) - static_cast<double>(n);
  const double coplanar = std::max(1.0, in_plane);
  const double under = static_cast<double>(below) - coplanar;
  const double over = static_cast<double>(n - above_from) - coplanar;
  const double crossing = static_cast<double>(n) - under - over - coplanar;
  consider(normal, offset, interval.polygon, std::max(0.0, under), std::max(0.0, over),
           std::max(0.0, crossing));
}

/// Considers an offset between two successive ends of intervals, before the next interval starts:
/// `started` intervals start below it, of which `ended` end at or below the start of the last one.
void PlaneSearch::consider_gap(const Vec3& normal, std::size_t started, std::size_t ended) {
  const std::size_t n = intervals_.size();
  const double from = intervals_[started - 1].low;
  const double next_start = started < n ? intervals_[started].low : HUGE_VAL;
  // The last end before the next start: there the fewest intervals are crossed.
  while (ended < n && ends_[ended] <= next_start) {
    ++ended;
  }
  const double low = ended > 0 ? std::max(from, ends_[ended - 1]) : from;
  const double high = std::min(next_start, ended < n ? ends_[ended] : HUGE_VAL);
  if (high == HUGE_VAL) {
    return;
  }
  // The middle of the gap; between polygons with a ring of common corners it is at the corners.
  const double offset = 0.5 * (low + high);
  consider(normal, offset, -1, static_cast<double>(ended), static_cast<double>(n - started),
           static_cast<double>(started - ended));
}

/// Keeps the plane if it is the best so far.
void PlaneSearch::consider(const Vec3& normal, double offset, std::int32_t polygon, double below,
                           double above, double crossing) {
  if (polygon < 0 && (below == 0 || above == 0)) {
    return;
  }
  const double in_plane =
      polygon < 0 ? 0 : static_cast<double>(sample_.size()) - below - above - crossing;
  const double scale = static_cast<double>(planes_.size()) / static_cast<double>(sample_.size());
  const double gain = bits(below + 0.5 * crossing, above + 0.5 * crossing + in_plane) +
                      in_plane;  // polygons in the plane need no further order
  const double cost = (crossing * scale + cost_of_a_node) / (gain * scale);
  if (gain > 0 && cost < best_cost_) {
    best_cost_ = cost;
    best_ = {{normal, offset}, polygon};
  }
}

}  // namespace transillum
