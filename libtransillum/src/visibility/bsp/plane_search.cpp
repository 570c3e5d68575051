// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
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
/// What a plane costs that cuts nothing, in cuts: keeps the tree from being a list of planes that
/// split off one polygon each.
constexpr double cost_of_a_node = 0.3;

/// Order bought by a plane, in bits: what it then takes less to sort the polygons.
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
  // One polygon needs no choice, and a plane of its own is always a way on.
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
  // Planes along two edges: rings of corners, which part what is round or boxy without a cut.
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
  // Normals between places far apart in the list, which keeps neighbors together.
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

void PlaneSearch::sweep(const Vec3& normal) {
  intervals_.clear();
  ends_.clear();
  for (const std::int32_t p : sample_) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::uint32_t c = at(begin_, p); c < begin_[static_cast<std::size_t>(p) + 1]; ++c) {
      const double at = dot(normal, points_[c]);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    // What is on the plane within its thickness does not cross it.
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

  // An offset between two neighboring ends of intervals: `started` began below, of which
  // `ended` lie below altogether.
  const std::size_t n = intervals_.size();
  std::size_t ended = 0;
  for (std::size_t started = 1; started <= n; ++started) {
    const Interval& last = intervals_[started - 1];
    if (last.high == last.low) {
      // A polygon across the normal: its own plane.
      const double offset = last.low;
      const auto below = static_cast<std::size_t>(
          std::upper_bound(ends_.begin(), ends_.end(), offset + thickness_) - ends_.begin());
      const auto above_from = static_cast<std::size_t>(
          std::lower_bound(intervals_.begin(), intervals_.end(), offset - thickness_,
                           [](const Interval& i, double at) { return i.low < at; }) -
          intervals_.begin());
      // Polygons in the plane were counted with both.
      const double in_plane =
          static_cast<double>(below + (n - above_from)) - static_cast<double>(n);
      const double coplanar = std::max(1.0, in_plane);
      const double under = static_cast<double>(below) - coplanar;
      const double over = static_cast<double>(n - above_from) - coplanar;
      const double crossing = static_cast<double>(n) - under - over - coplanar;
      offer(normal, offset, last.polygon, std::max(0.0, under), std::max(0.0, over),
            std::max(0.0, crossing));
    }
    const double from = last.low;
    const double next_start = started < n ? intervals_[started].low : HUGE_VAL;
    while (ended < n && ends_[ended] <= from) {
      ++ended;
    }
    // The last end before the next start, where the fewest still cross.
    std::size_t ended_by_then = ended;
    while (ended_by_then < n && ends_[ended_by_then] <= next_start) {
      ++ended_by_then;
    }
    const double low = ended_by_then > 0 ? std::max(from, ends_[ended_by_then - 1]) : from;
    const double high = std::min(next_start, ended_by_then < n ? ends_[ended_by_then] : HUGE_VAL);
    if (high == HUGE_VAL) {
      continue;
    }
    // Halfway through the gap; along a ring of shared corners that is on the corners.
    const double offset = 0.5 * (low + high);
    offer(normal, offset, -1, static_cast<double>(ended_by_then), static_cast<double>(n - started),
          static_cast<double>(started - ended_by_then));
  }
}

void PlaneSearch::offer(const Vec3& normal, double offset, std::int32_t polygon, double below,
                        double above, double crossing) {
  if (polygon < 0 && (below == 0 || above == 0)) {
    return;
  }
  const double in_plane =
      polygon < 0 ? 0 : static_cast<double>(sample_.size()) - below - above - crossing;
  const double scale = static_cast<double>(planes_.size()) / static_cast<double>(sample_.size());
  const double gain = bits(below + 0.5 * crossing, above + 0.5 * crossing + in_plane) +
                      in_plane;  // what lies in the plane is done with
  const double cost = (crossing * scale + cost_of_a_node) / (gain * scale);
  if (gain > 0 && cost < best_cost_) {
    best_cost_ = cost;
    best_ = {{normal, offset}, polygon};
  }
}

}  // namespace transillum
