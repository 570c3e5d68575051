// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Visibility queries with exact signs. States and notation are described in exact_view.h. Order of
// the file: loading fragments, sides of lines, subtracting and splitting.
#include "visibility/queries/exact_view.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/polygon_area.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Bound on the relative error of a determinant of differences.
constexpr long double long_rounding = 8 * std::numeric_limits<long double>::epsilon();

/// Bound on the distance of a fragment's corners from their lines, in grid units.
constexpr long double corner_offset = 2;

/// Largest |x| + |y| of some corners.
template <class Polygon>
auto reach_of(const Polygon& polygon) {
  auto reach = std::abs(polygon.x[0]) + std::abs(polygon.y[0]);
  for (std::size_t k = 1; k < polygon.count; ++k) {
    reach = std::max(reach, std::abs(polygon.x[k]) + std::abs(polygon.y[k]));
  }
  return reach;
}

/// Sum of |dx| + |dy| of the edges between some corners.
template <class Polygon>
auto perimeter_of(const Polygon& polygon) {
  const std::size_t last = polygon.count - 1;
  auto perimeter =
      std::abs(polygon.x[0] - polygon.x[last]) + std::abs(polygon.y[0] - polygon.y[last]);
  for (std::size_t k = 0; k < last; ++k) {
    perimeter +=
        std::abs(polygon.x[k + 1] - polygon.x[k]) + std::abs(polygon.y[k + 1] - polygon.y[k]);
  }
  return perimeter;
}

}  // namespace

ExactView::Polygon& ExactView::Polygon::operator=(const Polygon& other) {
  count = other.count;
  error = other.error;
  window = other.window;
  const auto filled = static_cast<std::ptrdiff_t>(count);
  std::copy(other.x.begin(), other.x.begin() + filled, x.begin());
  std::copy(other.y.begin(), other.y.begin() + filled, y.begin());
  std::copy(other.edge.begin(), other.edge.begin() + filled, edge.begin());
  std::copy(other.point.begin(), other.point.begin() + filled, point.begin());
  return *this;
}

void ExactView::find_window(Polygon& polygon) const {
  Real x0 = polygon.x[0], x1 = x0, y0 = polygon.y[0], y1 = y0;
  Real s0 = x0 + y0, s1 = s0, d0 = x0 - y0, d1 = d0;
  for (std::size_t k = 1; k < polygon.count; ++k) {
    const Real x = polygon.x[k], y = polygon.y[k], s = x + y, d = x - y;
    x0 = std::min(x0, x);
    x1 = std::max(x1, x);
    y0 = std::min(y0, y);
    y1 = std::max(y1, y);
    s0 = std::min(s0, s);
    s1 = std::max(s1, s);
    d0 = std::min(d0, d);
    d1 = std::max(d1, d);
  }
  const auto x = static_cast<double>(origin_.x), y = static_cast<double>(origin_.y);
  const std::array<double, 4> low{x + static_cast<double>(x0), y + static_cast<double>(y0),
                                  x + y + static_cast<double>(s0), x - y + static_cast<double>(d0)};
  const std::array<double, 4> high{x + static_cast<double>(x1), y + static_cast<double>(y1),
                                   x + y + static_cast<double>(s1),
                                   x - y + static_cast<double>(d1)};
  for (std::size_t d = 0; d < 4; ++d) {
    polygon.window.ends[d] = -rounded_down(-high[d]);
    polygon.window.ends[d + 4] = -rounded_down(low[d]);
  }
}

void ExactView::begin_query(std::int32_t fragment) {
  start_query(fragment, projected_.corners[at(projected_.fragments, fragment).begin]);
}

void ExactView::start_query(std::int32_t fragment, const GridPoint& origin) {
  const ProjectedFragments::Fragment& own = at(projected_.fragments, fragment);
  origin_ = origin;
  fragment_ = fragment;
  edge_count_ = 0;
  free_.insert(free_.end(), remaining_.begin(), remaining_.end());
  remaining_.assign(1, new_polygon());
  Polygon& polygon = polygons_[remaining_[0]];
  load_corners(own, polygon);
  reach_ = reach_of(polygon);
  load_edges(own, polygon);
  kept_edges_ = edge_count_;
  max_area_ = own.cut_needle ? static_cast<Real>(own.area) : std::numeric_limits<Real>::infinity();
  remaining_area_ = area_ = static_cast<Real>(own.area);
  find_window(polygon);
  window_ = polygon.window;
}

void ExactView::begin_query(std::int32_t fragment, const FragmentBins::Bin& bin) {
  // Relative to the bin: areas seen in it may be small compared with the fragment.
  start_query(fragment, {bin.x + bin.size / 2, bin.y + bin.size / 2});
  bin_ = bin;
  Polygon& polygon = polygons_[remaining_[0]];
  for (const LineId line : {low_x, low_y, high_x, high_y}) {
    const EdgeRef ref = add_edge(bin_line(line), {line, made_by_cut, made_by_cut});
    const Sides sides = measure_sides(polygon, ref);
    if (sides.left == 0) {
      free_.push_back(remaining_[0]);
      remaining_.clear();
      return;
    }
    if (sides.right == 0) {
      continue;
    }
    split(polygon, ref, inside_[0], inside_[1]);
    polygon = inside_[0];
  }
  kept_edges_ = edge_count_;
  reach_ = reach_of(polygon);
  remaining_area_ = area_ = std::min(area_of(polygon), max_area_);
  find_window(polygon);
  window_ = polygon.window;
}

/// The index of an unused polygon.
std::uint32_t ExactView::new_polygon() {
  if (free_.empty()) {
    polygons_.emplace_back();
    return static_cast<std::uint32_t>(polygons_.size() - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void ExactView::load_corners(const ProjectedFragments::Fragment& fragment, Polygon& polygon) const {
  polygon.count = 0;
  polygon.error = 0;
  for (std::uint32_t k = 0; k < fragment.end - fragment.begin; ++k) {
    const auto [x, y] = projected_.position_of(outlines_, fragment, k, origin_);
    polygon.add(x, y, 0,
                projected_.is_grid_point(outlines_, fragment, k)
                    ? projected_.corner_of(outlines_, fragment, k).point
                    : made_by_cut);
  }
}

void ExactView::load_edges(const ProjectedFragments::Fragment& fragment, Polygon& polygon) {
  const bool plain = outlines_.outlines[fragment.outline].plain && fragment.changed < 0;
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    const FragmentOutlines::Corner corner = projected_.corner_of(outlines_, fragment, k);
    if (plain) {
      // From the integer coordinates: differences of far rounded corners have lost digits.
      const std::uint32_t next = k + 1 < polygon.count ? k + 1 : 0;
      const GridPoint &from = projected_.corners[fragment.begin + k],
                      &to = projected_.corners[fragment.begin + next];
      polygon.edge[k] = add_edge(polygon.x[k], polygon.y[k], static_cast<Real>(to.x - from.x),
                                 static_cast<Real>(to.y - from.y),
                                 {corner.line, corner.point, polygon.point[next]});
    } else {
      const BspTree::Line& points = at(outlines_.lines, corner.line);
      polygon.edge[k] = add_edge(projected_.line_of(outlines_, corner),
                                 {corner.line, corner.forward ? points.a : points.b,
                                  corner.forward ? points.b : points.a});
    }
  }
}

ExactView::EdgeRef ExactView::add_edge(Real x, Real y, Real dx, Real dy, LineName line) {
  const Real length = std::abs(dx) + std::abs(dy);
  const Real slack = long_rounding * (reach_ + std::abs(x) + std::abs(y)) + corner_offset;
  // Never shrinks, so that memory is reused.
  if (edges_.size() <= edge_count_) {
    edges_.resize(2 * edge_count_ + 16);
  }
  edges_[edge_count_] = {dx, dy, dy * x - dx * y, length, slack, line.id, line.from, line.to};
  return static_cast<EdgeRef>(2 * edge_count_++);
}

ExactView::EdgeRef ExactView::add_edge(const GridLine& through, LineName line) {
  return add_edge(static_cast<Real>(through.a.x - origin_.x),
                  static_cast<Real>(through.a.y - origin_.y),
                  static_cast<Real>(through.b.x - through.a.x),
                  static_cast<Real>(through.b.y - through.a.y), line);
}

/// An edge of a bin's square, the square on its left.
GridLine ExactView::bin_line(LineId line) const {
  const std::int64_t x1 = bin_.x + bin_.size, y1 = bin_.y + bin_.size;
  switch (line) {
    case low_x:
      return {{bin_.x, y1}, {bin_.x, bin_.y}};
    case low_y:
      return {{bin_.x, bin_.y}, {x1, bin_.y}};
    case high_x:
      return {{x1, bin_.y}, {x1, y1}};
    default:
      return {{x1, y1}, {bin_.x, y1}};
  }
}

GridLine ExactView::grid_line(const Edge& edge) const {
  if (edge.line < 0) {
    return bin_line(edge.line);
  }
  TRANSILLUM_INVARIANT(edge.from != made_by_cut && edge.to != made_by_cut,
                       "grid points define the line of an edge");
  return {at(projected_.grid.points, edge.from), at(projected_.grid.points, edge.to)};
}

/// The sides of all corners of `polygon`, given the certain ones; corners on the line are on
/// neither side.
ExactView::Sides ExactView::settle_uncertain(const Polygon& polygon, EdgeRef ref,
                                             Sides sides) const {
  const std::uint64_t all = (std::uint64_t{1} << polygon.count) - 1;
  for (std::uint64_t uncertain = all & ~(sides.left | sides.right); uncertain != 0;
       uncertain &= uncertain - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(uncertain));
    const Real side = exact_side_of(polygon, k, ref);
    sides.left |= static_cast<std::uint64_t>(side > 0) << k;
    sides.right |= static_cast<std::uint64_t>(side < 0) << k;
  }
  return sides;
}

/// The sides of those corners of `polygon` for which long double is certain.
ExactView::Sides ExactView::certain_sides(const Polygon& polygon, EdgeRef ref, Real error) const {
  const Edge& edge = edge_of(ref);
  const Real limit = edge.length * (edge.slack + error);
  Sides sides;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const Real side = edge.dx * polygon.y[k] - edge.dy * polygon.x[k] + edge.c;
    sides.left |= static_cast<std::uint64_t>(side > limit) << k;
    sides.right |= static_cast<std::uint64_t>(side < -limit) << k;
  }
  if (ref & 1) {
    std::swap(sides.left, sides.right);
  }
  return sides;
}

/// Finds the edges of `by` that have corners of `polygon` on their right, as bits of `cuts`.
/// Returns false if one of them has no corner on its left: the two have no common area.
bool ExactView::find_cuts(const Polygon& polygon, const Polygon& by, Real error,
                          std::uint64_t& cuts) {
  const std::uint64_t all = (std::uint64_t{1} << polygon.count) - 1;
  for (std::size_t k = 0; k < by.count; ++k) {
    sides_of_edges_[k] = certain_sides(polygon, by.edge[k], error);
    counts_.decisions += static_cast<std::int64_t>(polygon.count);
    if (sides_of_edges_[k].right == all) {
      return false;
    }
  }
  cuts = 0;
  for (std::size_t k = 0; k < by.count; ++k) {
    Sides sides = sides_of_edges_[k];
    // Uncertain corners matter only if they may be the only ones on a side.
    if ((sides.left == 0 || sides.right == 0) && (sides.left | sides.right) != all) {
      sides = settle_uncertain(polygon, by.edge[k], sides);
    }
    if (sides.left == 0) {
      return false;
    }
    cuts |= static_cast<std::uint64_t>(sides.right != 0) << k;
  }
  return true;
}

/// The sides of the corners of `polygon`. Leaves the determinants, with exact signs, in sides_.
ExactView::Sides ExactView::measure_sides(const Polygon& polygon, EdgeRef ref) {
  Sides sides;
  const Edge& edge = edge_of(ref);
  const Real sign = ref & 1 ? -1 : 1;
  const Real bound = edge.length * (edge.slack + polygon.error);
  counts_.decisions += static_cast<std::int64_t>(polygon.count);
  for (std::size_t k = 0; k < polygon.count; ++k) {
    Real side = sign * (edge.dx * polygon.y[k] - edge.dy * polygon.x[k] + edge.c);
    if (std::abs(side) <= bound) {
      side = exact_side_of(polygon, k, ref);
    }
    sides_[k] = side;
    sides.left |= static_cast<std::uint64_t>(side > 0) << k;
    sides.right |= static_cast<std::uint64_t>(side < 0) << k;
  }
  return sides;
}

/// The determinant of corner k of `polygon` and an edge's line if it is too small for Real. Its
/// sign is exact, its value correct to rounding: the position of a cut depends on it.
ExactView::Real ExactView::exact_side_of(const Polygon& polygon, std::size_t k, EdgeRef ref) const {
  const Edge& edge = edge_of(ref);
  const Edge& leaving = edge_of(polygon.edge[k]);
  const Edge& arriving = edge_of(polygon.edge[k > 0 ? k - 1 : polygon.count - 1]);
  const PointId point = polygon.point[k];
  // A corner of an edge on the same line is on it by definition, whatever its rounding.
  if (leaving.line == edge.line || arriving.line == edge.line) {
    return 0;
  }
  if (point != made_by_cut && (point == edge.from || point == edge.to)) {
    return 0;
  }
  const Real sign = ref & 1 ? -1 : 1;
  if (edge.line == halving_line ||
      (point == made_by_cut && (leaving.line == halving_line || arriving.line == halving_line))) {
    return sign * (edge.dx * polygon.y[k] - edge.dy * polygon.x[k] + edge.c);
  }
  ++counts_.exact_decisions;
  const GridLine line = grid_line(edge);
  return sign * static_cast<Real>(point == made_by_cut
                                      ? exact_side(line, grid_line(arriving), grid_line(leaving))
                                      : exact_side(line, at(projected_.grid.points, point)));
}

double ExactView::subtract(std::int32_t candidate) {
  const FragmentBox& box = at(projected_.boxes, candidate);
  const ProjectedFragments::Fragment& by = at(projected_.fragments, candidate);
  bool loaded = false;
  Real area = 0;
  new_parts_.clear();
  covered_parts_.clear();
  for (std::size_t p = 0; p < remaining_.size();) {
    const std::uint32_t index = remaining_[p];
    if (!polygons_[index].window.overlaps(box)) {
      ++p;
      continue;
    }
    if (!loaded) {
      edge_count_ = kept_edges_;
      load_corners(by, candidate_);
      load_edges(by, candidate_);
      candidate_reach_ = reach_of(candidate_);
      candidate_perimeter_ = perimeter_of(candidate_);
      candidate_area_ = static_cast<Real>(by.area);
      loaded = true;
    }
    ++counts_.pairs;
    if (!subtract_from_polygon(index, area)) {
      ++p;
      continue;
    }
    free_.push_back(index);
    remaining_[p] = remaining_.back();
    remaining_.pop_back();
  }
  if (area > 0 || !new_parts_.empty()) {
    remaining_.insert(remaining_.end(), new_parts_.begin(), new_parts_.end());
    remaining_area_ -= area;
    update_window();
  }
  // The lines of a needle may meet far away, which enlarges the parts that they cut.
  area = std::min(area, max_area_);
  max_area_ -= area;
  return static_cast<double>(area);
}

void ExactView::update_window() {
  if (remaining_.empty()) {
    return;
  }
  FragmentWindow whole = polygons_[remaining_[0]].window;
  for (std::size_t p = 1; p < remaining_.size(); ++p) {
    whole.add(polygons_[remaining_[p]].window);
  }
  window_ = whole;
}

/// Subtracts candidate_ from a polygon: adds the area inside to `area`, and the parts outside to
/// new_parts_. Returns false if the two have no common area.
bool ExactView::subtract_from_polygon(std::uint32_t index, Real& area) {
  std::uint64_t cuts = 0, cuts_of_candidate = 0;
  if (!find_cuts(polygons_[index], candidate_, polygons_[index].error, cuts)) {
    return false;
  }
  if (cuts == 0) {
    return add_covered(polygons_[index], area);
  }
  if (!find_cuts(candidate_, polygons_[index], long_rounding * candidate_reach_,
                 cuts_of_candidate)) {
    return false;
  }
  const std::size_t parts = new_parts_.size();
  const auto discard_parts = [&] {
    free_.insert(free_.end(), new_parts_.begin() + static_cast<std::ptrdiff_t>(parts),
                 new_parts_.end());
    new_parts_.resize(parts);
  };
  std::size_t used = 0;
  const Polygon* rest = &polygons_[index];
  for (; cuts != 0; cuts &= cuts - 1) {
    const EdgeRef ref = at(candidate_.edge, std::countr_zero(cuts));
    const Sides sides = measure_sides(*rest, ref);
    if (sides.left == 0) {
      discard_parts();
      return false;
    }
    if (sides.right == 0) {
      continue;
    }
    const bool from_pool = rest == &polygons_[index];
    const std::uint32_t part = new_polygon();
    if (from_pool) {
      rest = &polygons_[index];
    }
    split(*rest, ref, inside_[used], polygons_[part]);
    new_parts_.push_back(part);
    if (polygons_[part].count > halving_corners) {
      split_in_half(part);
    }
    find_window(polygons_[part]);
    rest = &inside_[used];
    used = 1 - used;
  }
  if (!add_covered(*rest, area)) {
    discard_parts();
    return false;
  }
  kept_edges_ = edge_count_;
  return true;
}

/// Adds the area of a part inside candidate_. Returns false if that is more than candidate_ can
/// cover: where the tree cuts off a needle only a few grid units wide, the rounded points of its
/// lines may turn these so that they also enclose what lies far beyond its tip. Such a needle
/// covers nothing: what it hides is below the accuracy, or `cut_needle` would be set.
bool ExactView::add_covered(const Polygon& part, Real& area) {
  const Real covered = area_of(part);
  if (covered > 2 * candidate_area_ + (corner_offset + part.error) * candidate_perimeter_) {
    return false;
  }
  if (keep_covered_) {
    covered_parts_.push_back(part);
  }
  area += covered;
  return true;
}

/// Splits a polygon with many corners along a chord; adds the second half to new_parts_.
void ExactView::split_in_half(std::uint32_t index) {
  const std::uint32_t other = new_polygon();
  const Polygon whole = polygons_[index];
  Polygon &first = polygons_[index], &second = polygons_[other];
  const std::size_t middle = whole.count / 2;
  const EdgeRef chord =
      add_edge(whole.x[middle], whole.y[middle], whole.x[0] - whole.x[middle],
               whole.y[0] - whole.y[middle], {halving_line, made_by_cut, made_by_cut});
  first.count = middle + 1;
  first.edge[middle] = chord;
  second.count = 0;
  second.error = whole.error;
  second.add_corner(whole, 0, chord ^ 1);
  for (std::size_t k = middle; k < whole.count; ++k) {
    second.add_corner(whole, k, whole.edge[k]);
  }
  find_window(second);
  new_parts_.push_back(other);
}

/// Splits a polygon along a line with corners on both sides. sides_ is from measure_sides().
///
///            F ── … ── L        F … L: corners on the left, which is inside
///           /           \\.
///      ────Y─────────────X───►  X, Y: corners on the line, or made by the cut; in both parts
///           \\           /
///            … ─── … ──        outside
void ExactView::split(const Polygon& polygon, EdgeRef by, Polygon& inside, Polygon& outside) {
  ++counts_.cuts;
  const std::size_t count = polygon.count;
  const auto after = [count](std::size_t k) { return k + 1 < count ? k + 1 : 0; };
  const auto before = [count](std::size_t k) { return k > 0 ? k - 1 : count - 1; };
  // The run of corners on the left around the farthest of them. A convex polygon has only one,
  // without corners on the line in it; rounding may bend an outline where its edges continue one
  // another.
  const auto farthest = static_cast<std::size_t>(
      std::max_element(sides_.begin(), sides_.begin() + static_cast<std::ptrdiff_t>(count)) -
      sides_.begin());
  std::size_t first = farthest, last = farthest;
  for (std::size_t k = before(farthest); sides_[k] >= 0; k = before(k)) {
    first = sides_[k] > 0 ? k : first;
  }
  for (std::size_t k = after(farthest); sides_[k] >= 0; k = after(k)) {
    last = sides_[k] > 0 ? k : last;
  }
  inside.count = outside.count = 0;
  inside.error = outside.error = polygon.error;
  std::size_t k = first;
  for (; k != after(last); k = after(k)) {
    inside.add_corner(polygon, k, polygon.edge[k]);
  }
  // X, where the outline leaves the left side.
  if (sides_[k] == 0) {
    inside.add_corner(polygon, k, by);
    outside.add_corner(polygon, k, polygon.edge[k]);
    k = after(k);
  } else {
    add_crossing(polygon, last, k, by, inside, outside);
  }
  // Y, where it comes back.
  const std::size_t back = before(first);
  const std::size_t end = sides_[back] == 0 ? back : first;
  for (; k != end; k = after(k)) {
    outside.add_corner(polygon, k, polygon.edge[k]);
  }
  if (end == back) {
    inside.add_corner(polygon, back, polygon.edge[back]);
    outside.add_corner(polygon, back, by ^ 1);
  } else {
    add_crossing(polygon, back, first, by, inside, outside);
  }
}

/// The grid point that defines both lines, if any; otherwise made_by_cut.
PointId ExactView::common_point(const Edge& p, const Edge& q) {
  if (p.from == q.from || p.from == q.to) {
    return p.from;
  }
  return p.to == q.from || p.to == q.to ? p.to : made_by_cut;
}

/// Adds the point where the edge from corner `from` to corner `to` crosses the line `by` to both
/// parts.
void ExactView::add_crossing(const Polygon& polygon, std::size_t from, std::size_t to, EdgeRef by,
                             Polygon& inside, Polygon& outside) {
  const Real here = sides_[from], there = sides_[to];
  const Real across = 1 / (here - there);
  const Real dx = polygon.x[to] - polygon.x[from], dy = polygon.y[to] - polygon.y[from];
  const Real t = here * across;
  Real x = polygon.x[from] + t * dx, y = polygon.y[from] + t * dy;
  const Edge& edge = edge_of(polygon.edge[from]);
  const Edge& cutting = edge_of(by);
  // The crossing lies near both lines, whatever the errors of the corners along them; the smaller
  // the angle, the farther it may be from the point where the lines meet.
  const Real nearness = edge.slack + cutting.slack + long_rounding * (std::abs(x) + std::abs(y));
  const Real flatness =
      edge.length * cutting.length / std::abs(edge.dx * cutting.dy - edge.dy * cutting.dx);
  Real error = nearness * flatness;
  const auto [x0, x1] = std::minmax(polygon.x[from], polygon.x[to]);
  const auto [y0, y1] = std::minmax(polygon.y[from], polygon.y[to]);
  PointId common = common_point(edge, cutting);
  if (common != made_by_cut) {
    const GridPoint& p = at(projected_.grid.points, common);
    const auto common_x = static_cast<Real>(p.x - origin_.x);
    const auto common_y = static_cast<Real>(p.y - origin_.y);
    // Corners lie slightly off their lines, which may seem to cross far from where they meet.
    const Real margin = 16 + 0x1p-30 * (x1 - x0 + (y1 - y0));
    if (common_x >= x0 - margin && common_x <= x1 + margin && common_y >= y0 - margin &&
        common_y <= y1 + margin) {
      x = common_x;
      y = common_y;
      error = 0;
    } else {
      common = made_by_cut;
    }
  }
  if (common == made_by_cut && !(flatness < 0x1p6) && edge.line != halving_line &&
      cutting.line != halving_line) {
    // The lines meet at a small angle.
    ++counts_.exact_decisions;
    const Meeting meeting = exact_meeting(grid_line(edge), grid_line(cutting), origin_);
    if (!meeting.parallel) {
      // Stay within the edge.
      x = std::clamp(static_cast<Real>(meeting.x), x0, x1);
      y = std::clamp(static_cast<Real>(meeting.y), y0, y1);
      error = nearness;
    }
  }
  // Where the outline leaves a part's side of the line, the part's next edge is on the line.
  const bool leaves_inside = here > 0;
  inside.add(x, y, leaves_inside ? by : polygon.edge[from], common);
  outside.add(x, y, leaves_inside ? polygon.edge[from] : by ^ 1, common);
  inside.error = std::max(inside.error, error);
  outside.error = std::max(outside.error, error);
}

ExactView::Real ExactView::area_of(const Polygon& polygon) {
  struct Corner {
    Real x, y;
  };
  const Real area = polygon_area(polygon.count, [&](std::size_t k) {
    return Corner{polygon.x[k], polygon.y[k]};
  });
  return std::max(0.0L, area);
}

}  // namespace transillum
