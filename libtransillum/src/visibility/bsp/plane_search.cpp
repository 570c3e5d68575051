// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Choice of a splitting plane for BspBuilder: collects candidate normals, and sweeps over the
// offsets along each. The cost of a plane is the number of polygons it cuts per bit of order gained
// (decisions/0004-choice-of-planes.md).
#include "visibility/bsp/plane_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr std::size_t largest_sample = 1024;
constexpr std::size_t polygon_normals = 8;
constexpr std::size_t edge_normals = 8;
constexpr std::size_t line_normals = 8;
constexpr std::size_t polygons_per_bin = 8;
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

PlaneSearch::Choice PlaneSearch::best(const PolygonSet& set, bool one_sided) {
  set_ = &set;
  one_sided_ = one_sided;
  best_cost_ = std::numeric_limits<double>::infinity();
  // The plane of a polygon is always a valid choice.
  best_ = {at(planes_, set.polygons[0].plane), 0, false};
  if (set.size() > 1) {
    collect_sample(set);
    collect_normals();
    for (const Vec3& normal : normals_) {
      sweep(normal);
    }
  }
  return best_;
}

void PlaneSearch::collect_sample(const PolygonSet& set) {
  sample_.clear();
  begin_.clear();
  x_.clear();
  y_.clear();
  z_.clear();
  const std::size_t step = set.size() / largest_sample + 1;
  for (std::size_t p = 0; p < set.size(); p += step) {
    sample_.push_back(static_cast<std::int32_t>(p));
    begin_.push_back(static_cast<std::uint32_t>(x_.size()));
    for (std::uint32_t c = set.polygons[p].begin; c < set.polygons[p].end; ++c) {
      x_.push_back(set.places[c].x);
      y_.push_back(set.places[c].y);
      z_.push_back(set.places[c].z);
    }
  }
  begin_.push_back(static_cast<std::uint32_t>(x_.size()));
  along_.resize(x_.size());
  intervals_.resize(sample_.size());
  starts_.resize(sample_.size());
  ends_.resize(sample_.size());
}

Vec3 PlaneSearch::center_of(std::size_t sampled) const {
  return 0.5 * (point(begin_[sampled]) + point((begin_[sampled] + begin_[sampled + 1]) / 2));
}

void PlaneSearch::collect_normals() {
  normals_ = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::size_t n = sample_.size();
  const std::size_t own = std::min(n, polygon_normals);
  for (std::size_t k = 0; k < own; ++k) {
    normals_.push_back(at(planes_, at(set_->polygons, sample_[k * n / own]).plane).normal);
  }
  if (n <= 4) {
    return;
  }
  // Planes parallel to two edges: planes through rings of corners split round or box-like objects
  // without cuts.
  const auto edge = [&](std::size_t of_sample, std::size_t number) {
    const std::size_t p = of_sample % n;
    const std::uint32_t count = begin_[p + 1] - begin_[p];
    return point(begin_[p] + (number + 1) % count) - point(begin_[p] + number % count);
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
    const Vec3 between = center_of(a) - center_of(b);
    const double length = norm(between);
    if (length > thickness_) {
      normals_.push_back(between / length);
    }
  }
}

/// Collects the intervals that the sample's polygons cover along the normal.
void PlaneSearch::collect_intervals(const Vec3& normal) {
  for (std::size_t c = 0; c < x_.size(); ++c) {
    along_[c] = normal.x * x_[c] + normal.y * y_[c] + normal.z * z_[c];
  }
  for (std::size_t k = 0; k < sample_.size(); ++k) {
    double low = along_[begin_[k]], high = low;
    for (std::uint32_t c = begin_[k] + 1; c < begin_[k + 1]; ++c) {
      low = std::min(low, along_[c]);
      high = std::max(high, along_[c]);
    }
    // A polygon that reaches beyond the plane by no more than the thickness does not cross it.
    if (high - low > 2 * thickness_) {
      low += thickness_;
      high -= thickness_;
    } else {
      low = high = 0.5 * (low + high);
    }
    intervals_[k] = {low, high};
  }
}

/// Counts ends of intervals in bins. Returns whether some bin may hold a better plane; open_bins_
/// lists these.
bool PlaneSearch::count_in_bins() {
  lowest_ = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (const Interval& i : intervals_) {
    lowest_ = std::min(lowest_, i.low);
    highest = std::max(highest, i.high);
  }
  const std::size_t count =
      std::clamp<std::size_t>(std::bit_ceil(intervals_.size() / polygons_per_bin), 1, 128);
  bins_per_length_ =
      highest - lowest_ > thickness_ ? static_cast<double>(count - 1) / (highest - lowest_) : 0.0;
  bins_.assign(count, {});
  for (const Interval& i : intervals_) {
    const std::size_t low = bin_of(i.low), high = bin_of(i.high);
    ++bins_[low].starts;
    ++bins_[high].ends;
    bins_[low].inside += low == high ? 1 : 0;
  }

  open_bins_.clear();
  std::uint32_t started = 0, ended = 0;
  for (std::size_t b = 0; b < count; ++b) {
    Bin& bin = bins_[b];
    bin.started = bin.first_start = started;
    bin.ended = bin.first_end = ended;
    started += bin.starts;
    ended += bin.ends;
    bin.least_cost = least_cost(bin);
    if (bin.least_cost < best_cost_) {
      open_bins_.push_back(static_cast<std::uint32_t>(b));
    }
  }
  std::sort(open_bins_.begin(), open_bins_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return bins_[a].least_cost != bins_[b].least_cost ? bins_[a].least_cost < bins_[b].least_cost
                                                      : a < b;
  });
  return !open_bins_.empty();
}

/// A lower bound on the cost of all planes that consider() is given for a bin.
double PlaneSearch::least_cost(const Bin& bin) const {
  if (bin.ends == 0) {
    return HUGE_VAL;
  }
  const auto n = static_cast<double>(sample_.size());
  const double scale = static_cast<double>(set_->size()) / n;
  const double crossing =
      static_cast<double>(bin.started + bin.inside) - static_cast<double>(bin.ended + bin.ends);
  const double in_plane = bin.inside;
  const double cuts = std::max(0.0, crossing - in_plane) * scale + cost_of_a_node;
  if (cuts >= best_cost_ * (n + in_plane) * scale) {
    return HUGE_VAL;
  }
  // Polygons below plus half of those cut.
  const double least = 0.5 * (bin.started + bin.ended) - in_plane;
  const double most = 0.5 * (bin.started + bin.starts + bin.ended + bin.ends);
  const double middle = std::clamp(0.5 * n, std::max(0.0, least), most);
  return cuts / ((bits(middle, n - middle) + in_plane) * scale);
}

/// Groups the ends of the intervals by bins.
void PlaneSearch::distribute() {
  for (std::size_t k = 0; k < intervals_.size(); ++k) {
    starts_[bins_[bin_of(intervals_[k].low)].first_start++] = static_cast<std::uint32_t>(k);
    ends_[bins_[bin_of(intervals_[k].high)].first_end++] = intervals_[k].high;
  }
}

/// Considers all offsets along one normal.
void PlaneSearch::sweep(const Vec3& normal) {
  collect_intervals(normal);
  if (!count_in_bins()) {
    return;
  }
  distribute();
  for (const std::uint32_t b : open_bins_) {
    if (bins_[b].least_cost >= best_cost_) {
      return;
    }
    sweep_bin(normal, b);
  }
}

/// Considers all planes of one bin: those of polygons in it, and those in the gaps that follow ends
/// of intervals in it, each before the next interval starts: there the fewest are crossed.
void PlaneSearch::sweep_bin(const Vec3& normal, std::size_t number) {
  const Bin& bin = bins_[number];
  const auto starts = std::span(starts_).subspan(bin.started, bin.starts);
  const auto ends = std::span(ends_).subspan(bin.ended, bin.ends);
  const auto start_of = [&](std::uint32_t k) { return intervals_[k].low; };
  std::sort(starts.begin(), starts.end(), [&](std::uint32_t a, std::uint32_t b) {
    return start_of(a) != start_of(b) ? start_of(a) < start_of(b) : a < b;
  });
  std::sort(ends.begin(), ends.end());
  consider_own_planes(normal, bin);

  const auto n = static_cast<double>(sample_.size());
  std::size_t started = 0;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    while (started < starts.size() && start_of(starts[started]) <= ends[e]) {
      ++started;
    }
    const double next_start = started < starts.size() ? start_of(starts[started]) : HUGE_VAL;
    const double next_end = e + 1 < ends.size() ? ends[e + 1] : HUGE_VAL;
    if (next_end <= next_start && next_end < HUGE_VAL) {
      continue;
    }
    const double next = next_start < HUGE_VAL ? next_start : next_end_point(number + 1);
    const double below = static_cast<double>(bin.ended + e + 1);
    const double begun = static_cast<double>(bin.started + started);
    if (next < HUGE_VAL && begun < n) {
      // The middle of the gap; between polygons with a ring of common corners it is at the corners.
      consider(normal, 0.5 * (ends[e] + next), -1, below, n - begun, begun - below);
    }
  }
}

/// The first end of an interval, lower or upper, in a bin or one after it.
double PlaneSearch::next_end_point(std::size_t number) const {
  for (; number < bins_.size(); ++number) {
    const Bin& bin = bins_[number];
    double first = HUGE_VAL;
    for (std::uint32_t k = 0; k < bin.starts; ++k) {
      first = std::min(first, intervals_[starts_[bin.started + k]].low);
    }
    for (std::uint32_t k = 0; k < bin.ends; ++k) {
      first = std::min(first, ends_[bin.ended + k]);
    }
    if (first < HUGE_VAL) {
      return first;
    }
  }
  return HUGE_VAL;
}

/// Considers the planes of polygons perpendicular to the normal, in a bin that is sorted.
void PlaneSearch::consider_own_planes(const Vec3& normal, const Bin& bin) {
  const auto starts = std::span(starts_).subspan(bin.started, bin.starts);
  const auto ends = std::span(ends_).subspan(bin.ended, bin.ends);
  const auto n = static_cast<double>(sample_.size());
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const auto [offset, high] = intervals_[starts[s]];
    if (offset != high ||
        (s > 0 && intervals_[starts[s - 1]].low == offset && intervals_[starts[s - 1]].flat())) {
      continue;
    }
    const auto ended =
        std::upper_bound(ends.begin(), ends.end(), offset + thickness_) - ends.begin();
    const auto not_above =
        std::lower_bound(starts.begin(), starts.end(), offset - thickness_,
                         [&](std::uint32_t k, double low) { return intervals_[k].low < low; }) -
        starts.begin();
    // `below` and `above` both count the polygons in the plane.
    const double below = static_cast<double>(bin.ended) + static_cast<double>(ended);
    const double above = n - static_cast<double>(bin.started) - static_cast<double>(not_above);
    const double in_plane = std::max(1.0, below + above - n);
    const double under = std::max(0.0, below - in_plane), over = std::max(0.0, above - in_plane);
    const double crossing = std::max(0.0, n - under - over - in_plane);
    consider(normal, offset, static_cast<std::int32_t>(starts[s]), under, over, crossing);
  }
}

/// Keeps the plane if it is the best so far.
void PlaneSearch::consider(const Vec3& normal, double offset, std::int32_t sampled, double below,
                           double above, double crossing) {
  const bool empty_side = below == 0 || above == 0;
  const bool is_one_sided = empty_side && crossing == 0;
  if ((sampled < 0 && empty_side) || (is_one_sided && !one_sided_)) {
    return;
  }
  const double n = static_cast<double>(sample_.size());
  const double in_plane = sampled < 0 ? 0 : n - below - above - crossing;
  const double scale = static_cast<double>(set_->size()) / n;
  const double gain = bits(below + 0.5 * crossing, above + 0.5 * crossing + in_plane) +
                      in_plane;  // polygons in the plane need no further order
  // A polygon in the plane weighs as much as a cut: its plane will not be needed later.
  const double cuts = std::max(0.0, crossing - in_plane) * scale;
  const double cost = (cuts + cost_of_a_node) / (gain * scale);
  if (gain > 0 && cost < best_cost_) {
    best_cost_ = cost;
    best_ = {{normal, offset}, sampled < 0 ? -1 : at(sample_, sampled), is_one_sided};
  }
}

}  // namespace transillum
