// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Subtracting a candidate has two parts: cut_boundary() cuts the segments of the region's boundary
// by the candidate, and add_edges() adds the parts of the candidate's edges that lie in the region,
// reversed, so that the remaining boundary is closed again.
#include "visibility/queries/boundary_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "transillum/at.h"
#include "visibility/queries/bin_clip.h"

namespace transillum {

void BoundaryView::begin_query(std::int32_t fragment) {
  subject_ = &at(projected_.fragments, fragment);
  bin_ = nullptr;
  loaded_ = too_small_ = false;
  failure_ = QueryFailure::none;
  waiting_.clear();
  window_ = window_of(at(projected_.boxes, fragment));
}

void BoundaryView::begin_query(std::int32_t fragment, const FragmentBins::Bin& bin) {
  begin_query(fragment);
  bin_ = &bin;
  const auto x = static_cast<double>(bin.x), y = static_cast<double>(bin.y);
  const auto size = static_cast<double>(bin.size);
  const auto limit = [&](std::size_t d, double end) {
    window_.ends[d] = std::min(window_.ends[d], rounded_up(end));
  };
  limit(0, x + size);
  limit(1, y + size);
  limit(4, -x);
  limit(5, -y);
}

/// Initializes the query for the region that was just loaded.
void BoundaryView::start(double area, double reach) {
  const auto x = static_cast<double>(origin_.x), y = static_cast<double>(origin_.y);
  origin_extent_ = {x, y, x + y, x - y, -x, -y, -x - y, y - x};
  area_ = region_area_ = area;
  cutter_.tolerance = rounding * reach;
  reach_ = reach;
  if (!in_frame_) {
    set_own_edges();
  }
  if (subject_->cut_needle && !in_frame_) {
    failure_ = QueryFailure::cut_needle;
  } else if (is_inaccurate(per_area_ * cutter_.tolerance * reach, *subject_)) {
    failure_ = QueryFailure::thin;
  }
  find_window();
}

void BoundaryView::load_whole() {
  const GridPoint* const corners = projected_.corners.data() + subject_->begin;
  const std::size_t count = subject_->end - subject_->begin;
  origin_ = corners[0];
  region_->count = 0;
  double reach = 0, from_x = 0, from_y = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const auto x = static_cast<double>(corners[k].x - origin_.x);
    const auto y = static_cast<double>(corners[k].y - origin_.y);
    region_->add(from_x, from_y, x, y);
    reach = std::max(reach, std::abs(x) + std::abs(y));
    from_x = x;
    from_y = y;
  }
  region_->add(from_x, from_y, 0, 0);
  start(subject_->area, reach);
}

void BoundaryView::load_part_in_bin() {
  const std::int64_t half = bin_->size / 2;
  origin_ = {bin_->x + half, bin_->y + half};
  WidePolygon polygon;
  std::size_t count = subject_->end - subject_->begin;
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint& p = projected_.corners[subject_->begin + k];
    polygon[k] = {static_cast<long double>(p.x - origin_.x),
                  static_cast<long double>(p.y - origin_.y), 0};
  }
  count = clip_to_bin(polygon, count, static_cast<long double>(half));
  region_->count = 0;
  long double twice_area = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const WidePoint &p = polygon[k], &q = polygon[k + 1 < count ? k + 1 : 0];
    region_->add(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(q.x),
                 static_cast<double>(q.y));
    twice_area +=
        (p.x - polygon[0].x) * (q.y - polygon[0].y) - (p.y - polygon[0].y) * (q.x - polygon[0].x);
  }
  start(static_cast<double>(twice_area / 2), static_cast<double>(bin_->size));
}

void BoundaryView::find_window() {
  if (region_->count == 0) {
    return;
  }
  extent_ = extent_of(*region_);
  if (in_frame_) {
    find_window_in_frame();
    return;
  }
  for (std::size_t d = 0; d < 8; ++d) {
    window_.ends[d] = rounded_up(origin_extent_[d] + extent_[d]);
  }
}

/// Whether the rounding error of an area is so large, relative to a fragment and to its patch,
/// that ExactView is required.
bool BoundaryView::is_inaccurate(double error, const ProjectedFragments::Fragment& fragment) const {
  const double limit = error / ProjectedFragments::accuracy;
  return limit > fragment.area * projected_.smallest_part(fragment.patch) &&
         limit > projected_.patch_area(fragment.patch);
}

/// Stores the fragment's edges, for is_outside_own_edge().
void BoundaryView::set_own_edges() {
  const GridPoint* const corners = projected_.corners.data() + subject_->begin;
  own_edges_.count = subject_->end - subject_->begin;
  for (std::size_t k = 0; k < own_edges_.count; ++k) {
    const GridPoint &a = corners[k], &b = corners[k + 1 < own_edges_.count ? k + 1 : 0];
    own_edges_.x[k] = static_cast<double>(a.x - origin_.x);
    own_edges_.y[k] = static_cast<double>(a.y - origin_.y);
    own_edges_.dx[k] = static_cast<double>(b.x - a.x);
    own_edges_.dy[k] = static_cast<double>(b.y - a.y);
    own_edges_.length[k] = std::abs(own_edges_.dx[k]) + std::abs(own_edges_.dy[k]);
  }
}

/// Whether a candidate has nothing but rounding on the inner side of one of the fragment's
/// edges, as neighbors that share the edge have.
bool BoundaryView::is_outside_own_edge(const ProjectedFragments::Fragment& by) const {
  const GridPoint* const corners = projected_.corners.data() + by.begin;
  const std::size_t count = by.end - by.begin;
  std::array<double, FragmentOutlines::max_corners> x, y;
  double far = 0;
  for (std::size_t k = 0; k < count; ++k) {
    x[k] = static_cast<double>(corners[k].x - origin_.x);
    y[k] = static_cast<double>(corners[k].y - origin_.y);
    far = std::max(far, std::abs(x[k]) + std::abs(y[k]));
  }
  return is_outside_own_edge(x.data(), y.data(), count, far);
}

/// @param far largest |x| + |y| of the candidate's corners
inline bool BoundaryView::is_outside_own_edge(const double* x, const double* y, std::size_t count,
                                              double far) const {
  // Far from the fragment rounding is larger: only what is certain counts.
  const double limit = far <= 4 * reach_ ? rounding * reach_ : -rounding * far;
  for (std::size_t m = 0; m < own_edges_.count; ++m) {
    counts_.decisions += static_cast<std::int64_t>(count);
    const double from_x = own_edges_.x[m], from_y = own_edges_.y[m];
    const double dx = own_edges_.dx[m], dy = own_edges_.dy[m];
    double most = -HUGE_VAL;
    for (std::size_t k = 0; k < count; ++k) {
      most = std::max(most, dx * (y[k] - from_y) - dy * (x[k] - from_x));
    }
    if (most <= limit * own_edges_.length[m]) {
      return true;
    }
  }
  return false;
}

/// Whether the region has nothing but rounding on the inner side of one of the cutter's edges.
bool BoundaryView::is_outside_cutter() const {
  for (std::size_t m = 0; m < cutter_.count; ++m) {
    counts_.decisions += static_cast<std::int64_t>(region_->count);
    const double dx = cutter_.dx[m], dy = cutter_.dy[m];
    double most = -HUGE_VAL;
    for (std::size_t k = 0; k < region_->count; ++k) {
      most = std::max(most, dx * region_->ay[k] - dy * region_->ax[k]);
    }
    if (most + cutter_.c[m] <= cutter_.tolerance * cutter_.length[m]) {
      return true;
    }
  }
  return false;
}

/// Sets the cutter to a candidate. Returns false if that is outside the region, or cannot be cut
/// by.
inline bool BoundaryView::load_cutter(std::int32_t candidate) {
  const ProjectedFragments::Fragment& by = at(projected_.fragments, candidate);
  if (in_frame_) {
    return !is_beside_frame(by) && load_cutter_in_frame(candidate) &&
           !(!backs_hidden_ && is_cutter_outside_own_edge());
  }
  if (!backs_hidden_ && is_outside_own_edge(by)) {
    return false;
  }
  if (by.cut_needle) {
    return load_cutter_in_frame(candidate);
  }
  set_cutter(cutter_, projected_.corners.data() + by.begin, by.end - by.begin, origin_, 4 * reach_);
  return true;
}

double BoundaryView::subtract(std::int32_t candidate) {
  const ProjectedFragments::Fragment& by = at(projected_.fragments, candidate);
  too_small_ = false;
  if (!loaded_) {
    load();
    if (failed() || region_->count == 0) {
      return 0;
    }
  }
  ++counts_.pairs;
  if (!load_cutter(candidate) || is_outside_cutter()) {
    return 0;
  }
  // A point near the common area of both polygons.
  cutter_.pivot_x = std::clamp(cutter_.x[0], -extent_[4], extent_[0]);
  cutter_.pivot_y = std::clamp(cutter_.y[0], -extent_[5], extent_[1]);
  counts_.decisions += static_cast<std::int64_t>(region_->count * cutter_.count);
  if (!cut_boundary(*region_, cutter_, cut_, *next_region_)) {
    return 0;
  }
  outside_count_ = next_region_->count;
  double twice_area = cut_.twice_area;
  // The part of a convex cutter's outline in the region is no longer than the region's bounds.
  const double noise =
      per_area_ * 0.25 * cutter_.tolerance * std::min(cutter_.perimeter, 8 * reach_);
  too_small_ = is_inaccurate(noise, by);
  if (!add_edges(twice_area)) {
    failure_ = QueryFailure::inconsistent;
  }
  const double area = per_area_ * 0.5 * twice_area;
  // A candidate that is too small is subtracted for the sake of small ones behind it.
  if (failed() || (area <= noise && !too_small_)) {
    return 0;
  }
  counts_.cuts += static_cast<std::int64_t>(cutter_.count);
  std::swap(region_, next_region_);
  region_area_ -= area;
  if (!done()) {
    find_window();
  }
  return area;
}

bool BoundaryView::is_too_small_beside(std::int32_t candidate, double size) const {
  // A convex polygon and its bounds have the same perimeter in |dx| + |dy|.
  const auto& ends = at(projected_.boxes, candidate).ends;
  const double perimeter = -2 * (static_cast<double>(ends[0]) + static_cast<double>(ends[1]) +
                                 static_cast<double>(ends[4]) + static_cast<double>(ends[5]));
  return is_inaccurate(0.25 * rounding * size * std::min(perimeter, 8 * size),
                       at(projected_.fragments, candidate));
}

/// Loads the region when the first candidate is subtracted.
void BoundaryView::load() {
  loaded_ = true;
  if (in_frame_) {
    load_in_frame();
  } else if (bin_) {
    load_part_in_bin();
  } else {
    load_whole();
  }
}

/// The points where the region's boundary crosses one edge of the cutter, in order along the edge.
struct BoundaryView::EdgeCrossings {
  struct Crossing {
    double along, x, y;
    int winding_change;  ///< 1: the region begins; -1: it ends
  };
  std::size_t count = 0;
  std::array<Crossing, 2 * BoundarySegments::max_count> crossings;

  void insert(const Crossing& crossing) {
    std::size_t k = count++;
    for (; k > 0 && crossings[k - 1].along > crossing.along; --k) {
      crossings[k] = crossings[k - 1];
    }
    crossings[k] = crossing;
  }
};

/// Adds the parts of the cutter's edges that lie in the region: their contribution to twice_area,
/// and, reversed, to the next region's boundary. Returns false if rounding has made the ends
/// of such parts inconsistent.
bool BoundaryView::add_edges(double& twice_area) {
  EdgeCrossings crossings;
  int winding = cut_.winding[0];
  for (std::size_t m = 0; m < cutter_.count; ++m) {
    if (winding != cut_.winding[m] || winding < 0 || winding > 1) {
      return false;
    }
    if (winding == 0 && (cut_.enters[m] | cut_.leaves[m]) == 0) {
      continue;
    }
    find_crossings(m, crossings);
    if (!add_edge(m, crossings, winding, twice_area)) {
      return false;
    }
  }
  return winding == cut_.winding[0];
}

inline void BoundaryView::find_crossings(std::size_t m, EdgeCrossings& crossings) const {
  // In a frame, corners far away have lost digits.
  const double from_x = in_frame_ ? cutter_.pivot_x : cutter_.x[m];
  const double from_y = in_frame_ ? cutter_.pivot_y : cutter_.y[m];
  const auto along = [&](double x, double y) {
    return cutter_.dx[m] * (x - from_x) + cutter_.dy[m] * (y - from_y);
  };
  crossings.count = 0;
  for (std::uint64_t bits = cut_.enters[m]; bits != 0; bits &= bits - 1) {
    const int k = std::countr_zero(bits);
    const double x = at(cut_.in_x, k), y = at(cut_.in_y, k);
    crossings.insert({along(x, y), x, y, -1});
  }
  for (std::uint64_t bits = cut_.leaves[m]; bits != 0; bits &= bits - 1) {
    const int k = std::countr_zero(bits);
    const double x = at(cut_.out_x, k), y = at(cut_.out_y, k);
    crossings.insert({along(x, y), x, y, 1});
  }
}

/// In a sliver, crossings nearer to each other than rounding may be in the wrong order.
inline void BoundaryView::put_next_in_order(std::size_t m, std::size_t k, int winding,
                                            EdgeCrossings& crossings) const {
  const int next = winding + crossings.crossings[k].winding_change;
  if (next >= 0 && next <= 1) {
    return;
  }
  const double near = 4 * cutter_.tolerance * cutter_.length[m];
  for (std::size_t j = k + 1;
       j < crossings.count && crossings.crossings[j].along - crossings.crossings[k].along <= near;
       ++j) {
    if (crossings.crossings[j].winding_change != crossings.crossings[k].winding_change) {
      std::swap(crossings.crossings[j], crossings.crossings[k]);
      return;
    }
  }
}

/// Adds the parts of edge m. `winding` is the region's winding number at the edge's first corner,
/// and on return at its second.
inline bool BoundaryView::add_edge(std::size_t m, EdgeCrossings& crossings, int& winding,
                                   double& twice_area) {
  double from_x = cutter_.x[m], from_y = cutter_.y[m];
  const auto advance_to = [&](double x, double y) {
    const bool moved = x != from_x || y != from_y;
    if (moved && winding != 0) {
      if (winding != 1 || next_region_->count == BoundarySegments::capacity) {
        return false;
      }
      twice_area += (from_x - cutter_.pivot_x) * (y - cutter_.pivot_y) -
                    (from_y - cutter_.pivot_y) * (x - cutter_.pivot_x);
      next_region_->add(x, y, from_x, from_y);
    }
    from_x = x;
    from_y = y;
    return true;
  };
  for (std::size_t k = 0; k < crossings.count; ++k) {
    put_next_in_order(m, k, winding, crossings);
    if (!advance_to(crossings.crossings[k].x, crossings.crossings[k].y)) {
      return false;
    }
    winding += crossings.crossings[k].winding_change;
  }
  const std::size_t next = m + 1 < cutter_.count ? m + 1 : 0;
  return advance_to(cutter_.x[next], cutter_.y[next]);
}

}  // namespace transillum
