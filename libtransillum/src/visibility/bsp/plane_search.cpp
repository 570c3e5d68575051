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
/// Smaller samples are swept along all normals; in them, planes across a line between two polygons
/// are hardly ever the best.
constexpr std::size_t smallest_for_choice = 64;
/// In larger ones every fourth polygon is swept along all normals, and all along the best of
/// these.
constexpr std::size_t step_for_choice = 4;
constexpr std::size_t kept_normals = 8;
constexpr std::size_t polygon_normals = 8;
constexpr std::size_t edge_normals = 8;
constexpr std::size_t line_normals = 8;
constexpr std::size_t most_bins = 512;
/// Cost of a plane that cuts nothing, in cuts: keeps the tree from degenerating to a list of planes
/// that split off one polygon each.
constexpr double cost_of_a_node = 0.3;

/// k/2 log2(k/2), by k, for all numbers of polygons of a sample and their halves.
const std::vector<double>& products_with_logarithms() {
  static const std::vector<double> products = [] {
    std::vector<double> made(2 * largest_sample + 1, 0.0);
    for (std::size_t k = 1; k < made.size(); ++k) {
      const double part = 0.5 * static_cast<double>(k);
      made[k] = part * std::log2(part);
    }
    return made;
  }();
  return products;
}

}  // namespace

PlaneSearch::PlaneSearch(const std::vector<BspTree::Plane>& planes, double thickness)
    : planes_(planes), thickness_(thickness), products_(products_with_logarithms()) {}

PlaneSearch::Choice PlaneSearch::best(const PolygonSet& set, bool one_sided) {
  set_ = &set;
  one_sided_ = one_sided;
  forget_best();
  if (set.size() > 1) {
    const std::size_t step = set.size() / largest_sample + 1;
    collect_sample(step);
    collect_normals();
    if (sample_.size() >= smallest_for_choice) {
      collect_sample(step * step_for_choice);
      choose_normals();
      collect_sample(step);
    }
    for (const Vec3& normal : normals_) {
      sweep(normal);
    }
  }
  return best_;
}

void PlaneSearch::forget_best() {
  best_cost_ = std::numeric_limits<double>::infinity();
  // The plane of a polygon is always a valid choice.
  best_ = {at(planes_, set_->polygons[0].plane), 0, false};
}

/// Keeps the normals along which the sample has the best planes, if it has any.
void PlaneSearch::choose_normals() {
  ranking_.clear();
  for (std::size_t k = 0; k < normals_.size(); ++k) {
    forget_best();
    if (ranking_.size() == kept_normals) {
      best_cost_ = ranking_.back().first;
    }
    const double bound = best_cost_;
    sweep(normals_[k]);
    if (best_cost_ < bound) {
      if (ranking_.size() == kept_normals) {
        ranking_.pop_back();
      }
      const std::pair<double, std::size_t> entry{best_cost_, k};
      ranking_.insert(std::upper_bound(ranking_.begin(), ranking_.end(), entry), entry);
    }
  }
  std::vector<Vec3> kept;
  for (const auto& [cost, k] : ranking_) {
    kept.push_back(normals_[k]);
  }
  if (!kept.empty()) {
    normals_ = std::move(kept);
  }
  forget_best();
}

/// The first three corners of all polygons of a sample come first, then the others of each.
void PlaneSearch::collect_sample(std::size_t step) {
  const PolygonSet& set = *set_;
  sample_.clear();
  for (std::size_t p = 0; p < set.size(); p += step) {
    sample_.push_back(static_cast<std::int32_t>(p));
  }
  const std::size_t n = sample_.size();
  for (std::vector<double>* coordinates : {&x_, &y_, &z_}) {
    coordinates->resize(3 * n);
  }
  polygon_of_rest_.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const PolygonSet::Polygon& polygon = at(set.polygons, sample_[k]);
    for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
      const Vec3& place = set.places[c];
      const std::size_t corner = c - polygon.begin;
      if (corner < 3) {
        x_[corner * n + k] = place.x;
        y_[corner * n + k] = place.y;
        z_[corner * n + k] = place.z;
      } else {
        x_.push_back(place.x);
        y_.push_back(place.y);
        z_.push_back(place.z);
        polygon_of_rest_.push_back(static_cast<std::uint32_t>(k));
      }
    }
  }
  for (std::vector<double>* ends : {&lows_, &highs_, &ends_}) {
    ends->resize(n);
  }
  for (std::vector<std::uint32_t>* numbers : {&low_bins_, &high_bins_, &starts_}) {
    numbers->resize(n);
  }
}

/// A corner of a polygon of the sample; they repeat.
const Vec3& PlaneSearch::corner_of(std::size_t sampled, std::size_t number) const {
  const PolygonSet::Polygon& polygon = at(set_->polygons, sample_[sampled]);
  return set_->places[polygon.begin + number % (polygon.end - polygon.begin)];
}

Vec3 PlaneSearch::center_of(std::size_t sampled) const {
  const PolygonSet::Polygon& polygon = at(set_->polygons, sample_[sampled]);
  return 0.5 * (corner_of(sampled, 0) + corner_of(sampled, (polygon.end - polygon.begin) / 2));
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
    return corner_of(of_sample % n, number + 1) - corner_of(of_sample % n, number);
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
  if (n < smallest_for_choice) {
    return;
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
  const std::size_t n = sample_.size();
  const auto along = [&](std::size_t c) {
    return normal.x * x_[c] + normal.y * y_[c] + normal.z * z_[c];
  };
  for (std::size_t k = 0; k < n; ++k) {
    const double a = along(k), b = along(n + k), c = along(2 * n + k);
    lows_[k] = std::min(std::min(a, b), c);
    highs_[k] = std::max(std::max(a, b), c);
  }
  for (std::size_t rest = 0; rest < polygon_of_rest_.size(); ++rest) {
    const std::uint32_t k = polygon_of_rest_[rest];
    const double here = along(3 * n + rest);
    lows_[k] = std::min(lows_[k], here);
    highs_[k] = std::max(highs_[k], here);
  }
  // A polygon that reaches beyond the plane by no more than the thickness does not cross it.
  for (std::size_t k = 0; k < n; ++k) {
    const double low = lows_[k], high = highs_[k], middle = 0.5 * (low + high);
    const bool thick = high - low > 2 * thickness_;
    lows_[k] = thick ? low + thickness_ : middle;
    highs_[k] = thick ? high - thickness_ : middle;
  }
}

/// Counts ends of intervals in bins. Returns whether some bin may hold a better plane; open_bins_
/// lists these.
bool PlaneSearch::count_in_bins() {
  const std::size_t n = sample_.size();
  lowest_ = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (std::size_t k = 0; k < n; ++k) {
    lowest_ = std::min(lowest_, lows_[k]);
    highest = std::max(highest, highs_[k]);
  }
  const std::size_t count = std::clamp<std::size_t>(std::bit_ceil(n), 1, most_bins);
  bins_per_length_ =
      highest - lowest_ > thickness_ ? static_cast<double>(count - 1) / (highest - lowest_) : 0.0;
  bins_.assign(count, {});
  for (std::size_t k = 0; k < n; ++k) {
    low_bins_[k] = bin_of(lows_[k]);
    high_bins_[k] = bin_of(highs_[k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t low = low_bins_[k], high = high_bins_[k];
    ++bins_[low].starts;
    ++bins_[high].ends;
    bins_[low].inside += low == high ? 1 : 0;
  }

  collect_open_bins();
  return !open_bins_.empty();
}

/// Lists the bins whose counts leave room for a better plane: a lower bound on the cost of all
/// planes that consider() is given for a bin is below the best.
void PlaneSearch::collect_open_bins() {
  const auto n = static_cast<std::int32_t>(sample_.size());
  const double scale = static_cast<double>(set_->size()) / n;
  const double product_of_all = at(products_, 2 * n);
  open_bins_.clear();
  std::int32_t started = 0, ended = 0;
  for (std::size_t b = 0; b < bins_.size(); ++b) {
    Bin& bin = bins_[b];
    bin.started = bin.first_start = started;
    bin.ended = bin.first_end = ended;
    started += bin.starts;
    ended += bin.ends;
    // Polygons that cross all planes of the bin, less those that may lie in one.
    const double cuts = std::max(0, bin.started - ended) * scale + cost_of_a_node;
    if (bin.ends == 0 || cuts >= best_cost_ * (n + bin.inside) * scale) {
      continue;
    }
    // Twice the polygons below, with half of those cut, that divide the most evenly.
    const std::int32_t least = bin.started + bin.ended - 2 * bin.inside;
    const std::int32_t middle = std::clamp(n, std::max(0, least), started + ended);
    const double most_bits = product_of_all - at(products_, middle) - at(products_, 2 * n - middle);
    const double cost = cuts / ((most_bits + bin.inside) * scale);
    if (cost < best_cost_) {
      open_bins_.emplace_back(cost, static_cast<std::uint32_t>(b));
    }
  }
  std::sort(open_bins_.begin(), open_bins_.end());
}

/// Order gained by a plane, in bits: by how much it reduces the information that sorting the
/// polygons requires.
/// @param below of a sample, with half of those that are cut.
double PlaneSearch::bits(double below) const {
  const auto n = static_cast<double>(sample_.size());
  const auto product = [&](double part) { return products_[static_cast<std::size_t>(2 * part)]; };
  return product(n) - product(below) - product(n - below);
}

/// Groups the ends of the intervals by bins.
void PlaneSearch::distribute() {
  for (std::size_t k = 0; k < sample_.size(); ++k) {
    at(starts_, bins_[low_bins_[k]].first_start++) = static_cast<std::uint32_t>(k);
    at(ends_, bins_[high_bins_[k]].first_end++) = highs_[k];
  }
}

/// Considers all offsets along one normal.
void PlaneSearch::sweep(const Vec3& normal) {
  collect_intervals(normal);
  if (!count_in_bins()) {
    return;
  }
  distribute();
  for (const auto& [cost, bin] : open_bins_) {
    if (cost >= best_cost_) {
      return;
    }
    sweep_bin(normal, bin);
  }
}

/// Considers all planes of one bin: those of polygons in it, and those in the gaps that follow ends
/// of intervals in it, each before the next interval starts: there the fewest are crossed.
void PlaneSearch::sweep_bin(const Vec3& normal, std::size_t number) {
  const Bin& bin = bins_[number];
  const auto starts = starts_of(bin);
  const auto ends = ends_of(bin);
  const auto start_of = [&](std::uint32_t k) { return lows_[k]; };
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
    const double below = bin.ended + static_cast<double>(e + 1);
    const double begun = bin.started + static_cast<double>(started);
    if (next < HUGE_VAL && begun < n) {
      // The middle of the gap; between polygons with a ring of common corners it is at the corners.
      consider(normal, 0.5 * (ends[e] + next), -1, below, n - begun, begun - below);
    }
  }
}

/// The first end of an interval, lower or upper, in a bin or one after it.
double PlaneSearch::next_end_point(std::size_t number) {
  for (; number < bins_.size(); ++number) {
    const Bin& bin = bins_[number];
    double first = HUGE_VAL;
    for (const std::uint32_t k : starts_of(bin)) {
      first = std::min(first, lows_[k]);
    }
    for (const double end : ends_of(bin)) {
      first = std::min(first, end);
    }
    if (first < HUGE_VAL) {
      return first;
    }
  }
  return HUGE_VAL;
}

/// Considers the planes of polygons perpendicular to the normal, in a bin that is sorted.
void PlaneSearch::consider_own_planes(const Vec3& normal, const Bin& bin) {
  const auto starts = starts_of(bin);
  const auto ends = ends_of(bin);
  const auto n = static_cast<double>(sample_.size());
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const double offset = lows_[starts[s]];
    const auto is_at_offset = [&](std::uint32_t k) {
      return lows_[k] == offset && highs_[k] == offset;
    };
    if (!is_at_offset(starts[s]) || (s > 0 && is_at_offset(starts[s - 1]))) {
      continue;
    }
    const auto ended =
        std::upper_bound(ends.begin(), ends.end(), offset + thickness_) - ends.begin();
    const auto not_above =
        std::lower_bound(starts.begin(), starts.end(), offset - thickness_,
                         [&](std::uint32_t k, double low) { return lows_[k] < low; }) -
        starts.begin();
    // `below` and `above` both count the polygons in the plane.
    const double below = bin.ended + static_cast<double>(ended);
    const double above = n - bin.started - static_cast<double>(not_above);
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
  // Polygons in the plane need no further order.
  const double gain = bits(below + 0.5 * crossing) + in_plane;
  // A polygon in the plane weighs as much as a cut: its plane will not be needed later.
  const double cuts = std::max(0.0, crossing - in_plane) * scale;
  const double cost = (cuts + cost_of_a_node) / (gain * scale);
  if (gain > 0 && cost < best_cost_) {
    best_cost_ = cost;
    // The normal may be of a polygon that is only nearly parallel: by its plane, what touches the
    // one in the plane could be on one side at one end and on the other at the other.
    const std::int32_t polygon = sampled < 0 ? -1 : at(sample_, sampled);
    const BspTree::Plane plane = polygon < 0 ? BspTree::Plane{normal, offset}
                                             : at(planes_, at(set_->polygons, polygon).plane);
    best_ = {plane, polygon, is_one_sided};
  }
}

}  // namespace transillum
