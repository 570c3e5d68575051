// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Projection of the BSP tree's fragments for one direction: corners come from GridProjection, the
// order from BspTree::order(). Fragments that are too thin for the grid are omitted; needles cut
// by the tree get their areas from their lines instead of their rounded corners.
#include "visibility/queries/projected_fragments.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "transillum/at.h"
#include "visibility/queries/exact_side.h"

namespace transillum {
namespace {

// Grid units.
constexpr double min_width = 2;
constexpr int max_offset = 16;  ///< distance of a corner beyond the line of another corner's edge

/// Fraction of the squared diagonal of an outline: an outline with less area is a needle.
constexpr double needle_fraction = 0x1p-11;

/// Whether two lines through a rounded corner may meet far away from it.
bool are_nearly_parallel(const GridLine& p, const GridLine& q) {
  const auto px = static_cast<long double>(p.b.x - p.a.x);
  const auto py = static_cast<long double>(p.b.y - p.a.y);
  const auto qx = static_cast<long double>(q.b.x - q.a.x);
  const auto qy = static_cast<long double>(q.b.y - q.a.y);
  return std::abs(px * qy - py * qx) <=
         0x1p-20L * (std::abs(px) + std::abs(py)) * (std::abs(qx) + std::abs(qy));
}

long double squared_distance(const GridPoint& a, const GridPoint& b) {
  const auto x = static_cast<long double>(b.x - a.x), y = static_cast<long double>(b.y - a.y);
  return x * x + y * y;
}

/// Twice the area by which an outline turns right at b; 0 where it turns left, or right as nearly
/// collinear corners may by rounding.
long double right_turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const WideInteger turn = exact_turn(a, b, c);
  if (turn >= 0) {
    return 0;
  }
  const auto right = static_cast<long double>(-turn);
  return right > 1e-14L * (squared_distance(a, b) + squared_distance(b, c)) ? right : 0;
}

/// Whether the outline turns left everywhere, up to rounding. An outline seen edge-on within
/// rounding may not; it is omitted, as by FragmentProjector.
bool is_convex(const GridPoint* outline, std::size_t count, double area) {
  for (std::size_t k = 0; k < count; ++k) {
    if (64 * right_turn(outline[k], outline[(k + 1) % count], outline[(k + 2) % count]) >
        static_cast<long double>(area)) {
      return false;
    }
  }
  return true;
}

/// Twice the area, > 0 if the outline turns left; exact where the products cancel.
double twice_area_of(const GridPoint* outline, std::size_t count) {
  double sum = 0, size = 0;
  for (std::size_t k = 2; k < count; ++k) {
    const auto ax = static_cast<double>(outline[k - 1].x - outline[0].x);
    const auto ay = static_cast<double>(outline[k - 1].y - outline[0].y);
    const auto bx = static_cast<double>(outline[k].x - outline[0].x);
    const auto by = static_cast<double>(outline[k].y - outline[0].y);
    sum += ax * by - ay * bx;
    size += std::abs(ax * by) + std::abs(ay * bx);
  }
  if (std::abs(sum) > 0x1p-5 * size) {
    return sum;
  }
  WideInteger exact = 0;
  for (std::size_t k = 2; k < count; ++k) {
    exact += exact_turn(outline[0], outline[k - 1], outline[k]);
  }
  return static_cast<double>(exact);
}

FragmentBox box_of(const GridPoint* outline, std::size_t count) {
  std::array<double, 8> ends;
  ends.fill(std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < count; ++k) {
    const auto x = static_cast<double>(outline[k].x), y = static_cast<double>(outline[k].y);
    const std::array<double, 8> along{x, y, x + y, x - y, -x, -y, -x - y, y - x};
    for (std::size_t d = 0; d < 8; ++d) {
      ends[d] = std::min(ends[d], along[d]);
    }
  }
  FragmentBox box;
  for (std::size_t d = 0; d < 8; ++d) {
    box.ends[d] = rounded_down(ends[d]);
  }
  return box;
}

/// Squared diagonal of the bounds along x and y.
double squared_diagonal_of(const FragmentBox& box) {
  const double width = -static_cast<double>(box.ends[4]) - static_cast<double>(box.ends[0]);
  const double height = -static_cast<double>(box.ends[5]) - static_cast<double>(box.ends[1]);
  return width * width + height * height;
}

double squared_diagonal_of(const GridPoint* outline, std::size_t count) {
  const auto [left, right] = std::minmax_element(
      outline, outline + count, [](const GridPoint& p, const GridPoint& q) { return p.x < q.x; });
  const auto [low, high] = std::minmax_element(
      outline, outline + count, [](const GridPoint& p, const GridPoint& q) { return p.y < q.y; });
  const auto width = static_cast<double>(right->x - left->x);
  const auto height = static_cast<double>(high->y - low->y);
  return width * width + height * height;
}

bool is_convex_in_space(const Scene& scene, const std::vector<BspTree::Corner>& polygon) {
  const auto corner = [&](std::size_t k) -> const Vec3& {
    return scene.point(polygon[k % polygon.size()].point);
  };
  Vec3 doubled;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    doubled = doubled + cross(corner(k) - corner(0), corner(k + 1) - corner(0));
  }
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (dot(doubled, cross(corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1))) <= 0) {
      return false;
    }
  }
  return true;
}

/// Adds a triangle to a polygon if they share an edge and their union is convex.
bool join_triangle(const Scene& scene, std::span<const BspTree::Corner> triangle,
                   std::vector<BspTree::Corner>& polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t after = k + 1 < polygon.size() ? k + 1 : 0;
    for (std::size_t m = 0; m < 3; ++m) {
      if (polygon[k].point != triangle[(m + 1) % 3].point ||
          polygon[after].point != triangle[m].point) {
        continue;
      }
      // The edge from corner k becomes the triangle's other two.
      std::vector<BspTree::Corner> joined = polygon;
      joined[k] = triangle[(m + 1) % 3];
      joined.insert(joined.begin() + static_cast<std::ptrdiff_t>(k) + 1, triangle[(m + 2) % 3]);
      if (!is_convex_in_space(scene, joined)) {
        return false;
      }
      polygon = std::move(joined);
      return true;
    }
  }
  return false;
}

}  // namespace

FragmentOutlines::FragmentOutlines(const Scene& scene, const BspTree& tree) : lines(tree.lines()) {
  for (const BspTree::Fragment& fragment : tree.fragments()) {
    first.push_back(static_cast<std::uint32_t>(outlines.size()));
    const auto all = tree.corners(fragment);
    std::vector<BspTree::Corner> rest(all.begin(), all.end());
    while (rest.size() > max_corners) {
      // The diagonal between the part's last corner and the outline's first corner closes the part
      // and is an edge of the rest.
      std::vector<BspTree::Corner> part(rest.begin(), rest.begin() + max_corners);
      const PointId a = part.front().point, b = part.back().point;
      const auto line = static_cast<LineId>(lines.size());
      lines.push_back({std::min(a, b), std::max(a, b)});
      rest.erase(rest.begin() + 1, rest.begin() + max_corners - 1);
      rest.front() = {a, line, a < b};
      part.back() = {b, line, b < a};
      add(fragment.patch, part);
    }
    add(fragment.patch, rest);
  }
  first.push_back(static_cast<std::uint32_t>(outlines.size()));
  join_triangles(scene, tree);
  median_area = median_area_of(scene);
}

double FragmentOutlines::median_area_of(const Scene& scene) {
  std::vector<double> areas;
  for (const Patch& patch : scene.patches()) {
    areas.push_back(patch.area);
  }
  if (areas.empty()) {
    return 0;
  }
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return *middle;
}

void FragmentOutlines::join_triangles(const Scene& scene, const BspTree& tree) {
  const auto is_uncut_triangle = [&](const BspTree::Fragment& fragment) {
    const auto corners_of = tree.corners(fragment);
    return corners_of.size() == 3 &&
           std::all_of(corners_of.begin(), corners_of.end(), [&](const BspTree::Corner& corner) {
             return static_cast<std::size_t>(corner.point) < scene.points().size();
           });
  };
  const auto& fragments = tree.fragments();
  for (std::size_t f = 0, next = 0; f < fragments.size(); f = next) {
    next = f + 1;
    if (!is_uncut_triangle(fragments[f])) {
      continue;
    }
    const auto whole = tree.corners(fragments[f]);
    std::vector<BspTree::Corner> polygon(whole.begin(), whole.end());
    while (next < fragments.size() && fragments[next].patch == fragments[f].patch &&
           polygon.size() < max_corners && is_uncut_triangle(fragments[next]) &&
           join_triangle(scene, tree.corners(fragments[next]), polygon)) {
      ++next;
    }
    if (next == f + 1) {
      continue;
    }
    join_of.resize(fragments.size(), -1);
    std::fill(join_of.begin() + static_cast<std::ptrdiff_t>(f),
              join_of.begin() + static_cast<std::ptrdiff_t>(next),
              static_cast<std::int32_t>(joins.size()));
    joins.push_back({static_cast<FragmentId>(f), static_cast<FragmentId>(next - 1),
                     static_cast<std::uint32_t>(outlines.size())});
    add(fragments[f].patch, polygon);
  }
}

void FragmentOutlines::add(PatchId patch, const std::vector<BspTree::Corner>& part) {
  Outline outline{patch, static_cast<std::uint32_t>(corners.size()), 0, true};
  const auto runs_through = [this](LineId line, PointId point) {
    const BspTree::Line& points = at(lines, line);
    return points.a == point || points.b == point;
  };
  for (std::size_t k = 0; k < part.size(); ++k) {
    const BspTree::Corner& corner = part[k];
    const BspTree::Corner& before = part[k > 0 ? k - 1 : part.size() - 1];
    const bool exact =
        runs_through(corner.line, corner.point) && runs_through(before.line, corner.point);
    outline.plain = outline.plain && exact && corner.line != before.line;
    corners.push_back({corner.point, corner.line, corner.forward, exact});
  }
  outline.end = static_cast<std::uint32_t>(corners.size());
  outlines.push_back(outline);
}

void ProjectedFragments::project(const Scene& scene, const BspTree& tree,
                                 const FragmentOutlines& outlines, const Vec3& omega,
                                 const Cancellation& cancellation, const PatchShaft* shaft) {
  scene_ = &scene;
  omega_ = omega;
  median_area_ = outlines.median_area;
  smallest_part_ = outlines.smallest_part.empty() ? nullptr : &outlines.smallest_part;
  grid.project(scene, tree, omega, cancellation);
  boxes.clear();
  fragments.clear();
  corners.clear();
  changed_corners_.clear();
  boxes.reserve(outlines.outlines.size());
  fragments.reserve(outlines.outlines.size());
  corners.reserve(outlines.corners.size());
  std::vector<FragmentId> order = tree.order(omega, cancellation);
  if (shaft != nullptr) {
    std::erase_if(order, [&](FragmentId f) { return !shaft->may_hold(f, omega); });
  }
  for (std::size_t index = 0; index < order.size(); ++index) {
    if (index % 4096 == 0) {
      cancellation.throw_if_canceled();
    }
    prefetch(outlines, order, index);
    if (!outlines.joins.empty()) {
      const std::size_t joined = add_joined(outlines, order, index);
      if (joined > 0) {
        index += joined - 1;
        continue;
      }
    }
    const auto fragment = static_cast<std::size_t>(order[index]);
    for (std::uint32_t k = outlines.first[fragment]; k < outlines.first[fragment + 1]; ++k) {
      add_or_drop(outlines, k);
    }
  }
}

void ProjectedFragments::add_or_drop(const FragmentOutlines& outlines, std::uint32_t which) {
  if (!add(outlines, which)) {
    corners.resize(fragments.empty() ? 0 : fragments.back().end);
  }
}

/// Projects fragments from order[index] on as the one polygon that they are parts of, if they
/// follow one another and the polygon's projection is convex. Returns their number, or 0.
std::size_t ProjectedFragments::add_joined(const FragmentOutlines& outlines,
                                           const std::vector<FragmentId>& order,
                                           std::size_t index) {
  const std::int32_t number = at(outlines.join_of, order[index]);
  if (number < 0) {
    return 0;
  }
  const FragmentOutlines::Join& join = at(outlines.joins, number);
  const auto count = static_cast<std::size_t>(join.last - join.first) + 1;
  if (index + count > order.size() ||
      !std::all_of(order.begin() + static_cast<std::ptrdiff_t>(index),
                   order.begin() + static_cast<std::ptrdiff_t>(index + count),
                   [&](FragmentId f) { return join.first <= f && f <= join.last; }) ||
      !turns_one_way(outlines, outlines.outlines[join.outline])) {
    return 0;
  }
  add_or_drop(outlines, join.outline);
  return count;
}

/// Whether the projection of an outline turns to the same side at each corner, by more than
/// rounding and bends can change.
bool ProjectedFragments::turns_one_way(const FragmentOutlines& outlines,
                                       const FragmentOutlines::Outline& outline) const {
  const std::uint32_t count = outline.end - outline.begin;
  const auto corner = [&](std::uint32_t k) -> const GridPoint& {
    return at(grid.points, outlines.corners[outline.begin + k % count].point);
  };
  bool any_left = false, any_right = false;
  for (std::uint32_t k = 0; k < count; ++k) {
    const GridPoint &a = corner(k), &b = corner(k + 1), &c = corner(k + 2);
    const double left = static_cast<double>(b.x - a.x) * static_cast<double>(c.y - b.y);
    const double right = static_cast<double>(b.y - a.y) * static_cast<double>(c.x - b.x);
    const double least = 0x1p-16 * (std::abs(left) + std::abs(right));
    any_left |= left - right > least;
    any_right |= right - left > least;
    if (std::abs(left - right) <= least || (any_left && any_right)) {
      return false;
    }
  }
  return true;
}

/// BSP order visits outlines and points at scattered addresses: prefetches those that
/// order[index + 8] and order[index + 16] need.
void ProjectedFragments::prefetch(const FragmentOutlines& outlines,
                                  const std::vector<FragmentId>& order, std::size_t index) const {
  constexpr std::size_t distance = 8;
  const auto corners_at = [&](std::size_t later) {
    const auto fragment = static_cast<std::size_t>(order[std::min(later, order.size() - 1)]);
    return outlines.corners.data() + outlines.outlines[outlines.first[fragment]].begin;
  };
  __builtin_prefetch(corners_at(index + 2 * distance));
  const FragmentOutlines::Corner* const next = corners_at(index + distance);
  for (std::size_t k = 0; k < 3; ++k) {
    __builtin_prefetch(grid.points.data() + static_cast<std::size_t>(next[k].point));
  }
}

/// Projects one outline. Returns false, with extra corners at the end of `corners`, if it is seen
/// edge-on.
bool ProjectedFragments::add(const FragmentOutlines& outlines, std::uint32_t which) {
  const FragmentOutlines::Outline& outline = outlines.outlines[which];
  const auto begin = static_cast<std::uint32_t>(corners.size());
  for (std::uint32_t k = outline.begin; k < outline.end; ++k) {
    corners.push_back(at(grid.points, outlines.corners[k].point));
  }
  GridPoint* const first = corners.data() + begin;
  const std::size_t count = corners.size() - begin;
  const double twice_area = twice_area_of(first, count);
  const bool front = twice_area > 0;
  if (!front) {
    std::reverse(first, first + count);
  }
  const FragmentBox box = box_of(first, count);
  const double area = 0.5 * std::abs(twice_area);
  // The box of a small fragment far from the grid's center is mostly rounding.
  double size = squared_diagonal_of(box);
  if (area < needle_fraction * size) {
    size = squared_diagonal_of(first, count);
  }
  const double largest_needle = needle_fraction * size;
  const double thinnest = min_width * std::sqrt(size);
  // Outlines thinner than the grid units that corners are rounded to are treated as seen edge-on.
  if (area < thinnest) {
    return false;
  }
  const bool needle = area < largest_needle;
  Fragment fragment{
      begin, static_cast<std::uint32_t>(corners.size()), which, outline.patch, front, false, -1,
      area};
  bool changed = needle && !outline.plain && remove_turned_edges(outlines, fragment);
  if (needle && !is_convex(first, fragment.end - begin, area)) {
    return false;
  }
  changed = (needle && remove_reflex_edges(outlines, fragment)) || changed;
  // Corners are off their lines by up to a grid unit.
  const auto is_inaccurate = [&] {
    return 2 * std::sqrt(size) > accuracy * patch_area(outline.patch);
  };
  fragment.cut_needle = changed || (needle && !outline.plain && is_inaccurate());
  if (fragment.cut_needle) {
    fragment.area = cut_needle_area(outlines, fragment);
    if (fragment.area < thinnest) {
      return false;
    }
  }
  boxes.push_back(box);
  fragments.push_back(fragment);
  return true;
}

/// Removes edges that are so short that rounding has turned them: the polygon is not on their left,
/// or they have no direction. The polygon then ends where the lines of the edges before and after
/// meet. Returns whether there are such edges.
bool ProjectedFragments::remove_turned_edges(const FragmentOutlines& outlines, Fragment& fragment) {
  for (std::uint32_t k = 0;
       k < fragment.end - fragment.begin && fragment.end - fragment.begin > 3;) {
    if (const Turned turned = is_turned(fragment, k); turned != Turned::no) {
      remove_edge(outlines, fragment, k, turned == Turned::keep_end);
      k = 0;
    } else {
      ++k;
    }
  }
  return fragment.changed >= 0;
}

/// Rounding moves a corner by up to max_offset units beyond the line of an edge, times the ratio of
/// its distance to the edge's length; what is farther beyond is a bend of the patch. If the corner
/// after the edge is beyond it, the edge's start lies on the line of the edge after, but for
/// rounding; if the corner before it is, its end lies on the line of the edge before.
ProjectedFragments::Turned ProjectedFragments::is_turned(const Fragment& fragment,
                                                         std::uint32_t k) const {
  const std::uint32_t count = fragment.end - fragment.begin;
  const auto corner = [&](std::uint32_t j) -> const GridPoint& {
    return corners[fragment.begin + (k + j) % count];
  };
  const GridPoint &before = corner(count - 1), &from = corner(0), &to = corner(1),
                  &after = corner(2);
  const auto distance = [&](const GridPoint& other) {
    return static_cast<WideInteger>(std::abs(other.x - from.x)) + std::abs(other.y - from.y);
  };
  const WideInteger length = distance(to);
  const auto is_beyond = [&](const GridPoint& other) {
    const WideInteger beyond = -exact_turn(from, to, other);
    return beyond > max_offset * length && beyond <= max_offset * distance(other);
  };
  if (length <= max_offset || is_beyond(after)) {
    return Turned::keep_start;
  }
  return is_beyond(before) ? Turned::keep_end : Turned::no;
}

/// Removes edge k and one of its corners; the other becomes the meeting of the edges before and
/// after.
void ProjectedFragments::remove_edge(const FragmentOutlines& outlines, Fragment& fragment,
                                     std::uint32_t k, bool keep_end) {
  const std::uint32_t count = fragment.end - fragment.begin;
  if (fragment.changed < 0) {
    const auto first = static_cast<std::int32_t>(changed_corners_.size());
    for (std::uint32_t j = 0; j < count; ++j) {
      changed_corners_.push_back(corner_of(outlines, fragment, j));
    }
    fragment.changed = first;
  }
  const std::uint32_t next = k + 1 < count ? k + 1 : 0;
  const auto own = changed_corners_.begin() + fragment.changed;
  own[k].line = own[next].line;
  own[k].forward = own[next].forward;
  own[k].exact = false;
  if (keep_end) {
    own[k].point = own[next].point;
    corners[fragment.begin + k] = corners[fragment.begin + next];
  }
  changed_corners_.erase(own + next);
  corners.erase(corners.begin() + fragment.begin + next);
  --fragment.end;
}

/// Whether the outline lies on the outer side of an edge's line rather than on the inner side.
bool ProjectedFragments::has_outline_outside(const Fragment& fragment, std::uint32_t k) const {
  const std::uint32_t count = fragment.end - fragment.begin;
  const GridPoint& from = corners[fragment.begin + k];
  const GridPoint& to = corners[fragment.begin + (k + 1) % count];
  WideInteger inside = 0, outside = 0;
  for (std::uint32_t j = fragment.begin; j < fragment.end; ++j) {
    const WideInteger side = exact_turn(from, to, corners[j]);
    inside = std::max(inside, side);
    outside = std::max(outside, -side);
  }
  return outside > inside;
}

/// Removes an edge at right turns that is_convex() lets pass, as FragmentProjector does, where its
/// line has the outline on its outer side: of an edge seen along its length, the direction is
/// rounding of the scene's coordinates. Returns whether there are such edges.
bool ProjectedFragments::remove_reflex_edges(const FragmentOutlines& outlines, Fragment& fragment) {
  bool any = false;
  for (std::uint32_t k = 0; k < fragment.end - fragment.begin;) {
    const std::uint32_t count = fragment.end - fragment.begin;
    const auto corner = [&](std::uint32_t j) -> const GridPoint& {
      return corners[fragment.begin + (k + j) % count];
    };
    if (count == 3 || right_turn(corner(0), corner(1), corner(2)) == 0) {
      ++k;
      continue;
    }
    const bool first_is_shorter =
        squared_distance(corner(0), corner(1)) < squared_distance(corner(1), corner(2));
    const std::uint32_t shorter = first_is_shorter ? k : (k + 1) % count;
    if (!has_outline_outside(fragment, shorter)) {
      ++k;
      continue;
    }
    remove_edge(outlines, fragment, shorter, !first_is_shorter);
    any = true;
    k = 0;
  }
  return any;
}

FragmentOutlines::Corner ProjectedFragments::corner_of(const FragmentOutlines& outlines,
                                                       const Fragment& fragment,
                                                       std::uint32_t k) const {
  if (fragment.changed >= 0) {
    return changed_corners_[static_cast<std::size_t>(fragment.changed) + k];
  }
  const FragmentOutlines::Corner* const own =
      outlines.corners.data() + outlines.outlines[fragment.outline].begin;
  if (fragment.front) {
    return own[k];
  }
  const std::uint32_t count = fragment.end - fragment.begin;
  FragmentOutlines::Corner corner = own[count - 1 - k];
  const FragmentOutlines::Corner& next = own[k + 1 < count ? count - 2 - k : count - 1];
  corner.line = next.line;
  corner.forward = !next.forward;
  return corner;
}

bool ProjectedFragments::is_grid_point(const FragmentOutlines& outlines, const Fragment& fragment,
                                       std::uint32_t k) const {
  const FragmentOutlines::Corner leaving = corner_of(outlines, fragment, k);
  if (leaving.exact) {
    return true;
  }
  const FragmentOutlines::Corner arriving =
      corner_of(outlines, fragment, k > 0 ? k - 1 : fragment.end - fragment.begin - 1);
  return are_nearly_parallel(line_of(outlines, arriving), line_of(outlines, leaving));
}

ProjectedFragments::Position ProjectedFragments::position_of(const FragmentOutlines& outlines,
                                                             const Fragment& fragment,
                                                             std::uint32_t k,
                                                             const GridPoint& origin) const {
  const GridPoint& corner = corners[fragment.begin + k];
  const Position rounded{static_cast<long double>(corner.x - origin.x),
                         static_cast<long double>(corner.y - origin.y)};
  if (!fragment.cut_needle) {
    return rounded;
  }
  if (is_grid_point(outlines, fragment, k)) {
    return rounded;
  }
  const FragmentOutlines::Corner leaving = corner_of(outlines, fragment, k);
  const FragmentOutlines::Corner arriving =
      corner_of(outlines, fragment, k > 0 ? k - 1 : fragment.end - fragment.begin - 1);
  const Meeting meeting =
      exact_meeting(line_of(outlines, arriving), line_of(outlines, leaving), corner);
  return {rounded.x + meeting.x, rounded.y + meeting.y};
}

double ProjectedFragments::cut_needle_area(const FragmentOutlines& outlines,
                                           const Fragment& fragment) const {
  const GridPoint& origin = corners[fragment.begin];
  const Position first = position_of(outlines, fragment, 0, origin);
  Position before = position_of(outlines, fragment, 1, origin);
  long double twice = 0;
  for (std::uint32_t k = 2; k < fragment.end - fragment.begin; ++k) {
    const Position here = position_of(outlines, fragment, k, origin);
    twice += (before.x - first.x) * (here.y - first.y) - (before.y - first.y) * (here.x - first.x);
    before = here;
  }
  return static_cast<double>(twice / 2);
}

}  // namespace transillum
