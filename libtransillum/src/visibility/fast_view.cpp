// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast_view.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace transillum {
namespace {

/// Bounds the error of a determinant of differences of numbers of this size, over the size.
template <class Real>
constexpr Real rounding = 8 * std::numeric_limits<Real>::epsilon();

/// Corners of cut faces lie up to so many steps off the lines that they are on.
constexpr int off_line = 2;

/// Largest |x| + |y| in a box.
template <class Box>
auto reach_of(const Box& box) {
  return std::max(-box.x0, box.x1) + std::max(-box.y0, box.y1);
}

}  // namespace

template <class Real>
typename FastView<Real>::Piece& FastView<Real>::Piece::operator=(const Piece& other) {
  count = other.count;
  error = other.error;
  box = other.box;
  const auto filled = static_cast<std::ptrdiff_t>((count + 3) / 4 * 4);
  std::copy(other.x.begin(), other.x.begin() + filled, x.begin());
  std::copy(other.y.begin(), other.y.begin() + filled, y.begin());
  std::copy(other.edge.begin(), other.edge.begin() + filled, edge.begin());
  std::copy(other.point.begin(), other.point.begin() + filled, point.begin());
  return *this;
}

/// To be called once all corners are there.
template <class Real>
void FastView<Real>::Piece::finish() {
  for (std::size_t k = count; k % 4 != 0; ++k) {
    x[k] = x[0];
    y[k] = y[0];
  }
  box = {x[0], y[0], x[0], y[0]};
  for (std::size_t k = 1; k < count; ++k) {
    box.x0 = std::min(box.x0, x[k]);
    box.y0 = std::min(box.y0, y[k]);
    box.x1 = std::max(box.x1, x[k]);
    box.y1 = std::max(box.y1, y[k]);
  }
}

template <class Real>
void FastView<Real>::look_from(std::int32_t face) {
  const FastFaces::Face& own = faces_.faces[static_cast<std::size_t>(face)];
  origin_ = faces_.corners[own.begin].at;
  edges_.clear();
  if (left_.empty()) left_.resize(1);
  Piece& piece = left_[0];
  load_corners(own, piece);
  reach_ = reach_of(piece.box);
  load_edges(own, piece);
  kept_edges_ = edges_.size();
  left_count_ = 1;
  left_area_ = area_ = static_cast<Real>(own.area);
}

template <class Real>
bool FastView<Real>::look_from(std::int32_t face, const FastBins::Bin& bin) {
  look_from(face);
  bin_ = bin;
  Piece& piece = left_[0];
  for (const LineId line : {low_x, low_y, high_x, high_y}) {
    const EdgeRef ref = add_edge(grid_line(line, true), line, true);
    const Edge edge = edge_of(ref);
    const Sides sides = sides_of(piece, edge, edge.length * (edge.slack + piece.error));
    if (sides.left == 0) return false;
    if (sides.right == 0) continue;
    measure(piece, edge, edge.length * (edge.slack + piece.error));
    split(piece, ref, sides, inside_, rest_);
    piece = inside_;
  }
  kept_edges_ = edges_.size();
  left_area_ = area_ = area_of(piece);
  return area_ > 0;
}

template <class Real>
void FastView<Real>::load_corners(const FastFaces::Face& face, Piece& piece) const {
  piece.count = 0;
  piece.error = 0;
  for (std::uint32_t k = face.begin; k < face.end; ++k) {
    const FaceCorner& corner = faces_.corners[k];
    piece.add(static_cast<Real>(corner.at.x - origin_.x),
              static_cast<Real>(corner.at.y - origin_.y), 0, corner.point);
  }
  piece.finish();
}

template <class Real>
void FastView<Real>::load_edges(const FastFaces::Face& face, Piece& piece) {
  const FaceCorner* const corners = faces_.corners.data() + face.begin;
  const std::size_t count = face.end - face.begin;
  for (std::size_t k = 0; k < count; ++k) {
    const FaceCorner& corner = corners[k];
    if (face.plain) {
      const std::size_t next = k + 1 < count ? k + 1 : 0;
      piece.edge[k] = add_edge(piece.x[k], piece.y[k], piece.x[next] - piece.x[k],
                               piece.y[next] - piece.y[k], corner.line, corner.forward);
    } else {
      piece.edge[k] = add_edge(grid_line(corner.line, corner.forward), corner.line, corner.forward);
    }
  }
}

template <class Real>
typename FastView<Real>::EdgeRef FastView<Real>::add_edge(Real x, Real y, Real dx, Real dy,
                                                          LineId line, bool forward) {
  const Real length = std::abs(dx) + std::abs(dy);
  const Real slack = rounding<Real> * (reach_ + std::abs(x) + std::abs(y)) + Real{off_line};
  edges_.push_back({dx, dy, dy * x - dx * y, length, slack, line, forward});
  return static_cast<EdgeRef>(2 * (edges_.size() - 1));
}

template <class Real>
typename FastView<Real>::EdgeRef FastView<Real>::add_edge(const GridLine& through, LineId line,
                                                          bool forward) {
  return add_edge(static_cast<Real>(through.a.x - origin_.x),
                  static_cast<Real>(through.a.y - origin_.y),
                  static_cast<Real>(through.b.x - through.a.x),
                  static_cast<Real>(through.b.y - through.a.y), line, forward);
}

/// A line through points of the grid, run through from a to b or the other way round.
template <class Real>
GridLine FastView<Real>::grid_line(LineId line, bool forward) const {
  const std::int64_t x1 = bin_.x + bin_.size, y1 = bin_.y + bin_.size;
  GridLine result;
  switch (line) {
    case low_x:
      result = {{bin_.x, y1}, {bin_.x, bin_.y}};
      break;
    case low_y:
      result = {{bin_.x, bin_.y}, {x1, bin_.y}};
      break;
    case high_x:
      result = {{x1, bin_.y}, {x1, y1}};
      break;
    case high_y:
      result = {{x1, y1}, {bin_.x, y1}};
      break;
    default: {
      const BspTree::Line& points = outlines_.lines[static_cast<std::size_t>(line)];
      result = {faces_.grid.points[static_cast<std::size_t>(points.a)],
                faces_.grid.points[static_cast<std::size_t>(points.b)]};
    }
  }
  if (!forward) std::swap(result.a, result.b);
  return result;
}

template <class Real>
typename FastView<Real>::Edge FastView<Real>::edge_of(EdgeRef ref) const {
  Edge edge = edges_[static_cast<std::size_t>(ref >> 1)];
  if (ref & 1) {
    edge.dx = -edge.dx;
    edge.dy = -edge.dy;
    edge.c = -edge.c;
    edge.forward = !edge.forward;
  }
  return edge;
}

/// On which sides of the line of `edge` the corners of `piece` lie; determinants within `bound` of
/// 0 are not sure.
template <class Real>
typename FastView<Real>::Sides FastView<Real>::sides_of(const Piece& piece, const Edge& edge,
                                                        Real bound) const {
  Sides sides{0, 0};
  for (std::size_t k = 0; k < piece.count; ++k) {
    const Real side = edge.dx * piece.y[k] - edge.dy * piece.x[k] + edge.c;
    sides.left |= static_cast<std::uint32_t>(side > bound) << k;
    sides.right |= static_cast<std::uint32_t>(side < -bound) << k;
  }
  const std::uint32_t all = (std::uint32_t{1} << piece.count) - 1;
  counts_.decisions += static_cast<std::int64_t>(piece.count);
  return (sides.left | sides.right) == all ? sides : settled(piece, edge, sides);
}

/// The same with what was not sure settled.
template <class Real>
typename FastView<Real>::Sides FastView<Real>::settled(const Piece& piece, const Edge& edge,
                                                       Sides sides) const {
  for (std::size_t k = 0; k < piece.count; ++k) {
    if ((sides.left | sides.right) >> k & 1) continue;
    const Real side = exact_side_of(piece, k, edge);
    sides.left |= static_cast<std::uint32_t>(side > 0) << k;
    sides.right |= static_cast<std::uint32_t>(side < 0) << k;
  }
  return sides;
}

/// Leaves the determinants of the corners of `piece` and `edge` in sides_, their signs right.
template <class Real>
void FastView<Real>::measure(const Piece& piece, const Edge& edge, Real bound) {
  for (std::size_t k = 0; k < piece.count; ++k) {
    sides_[k] = edge.dx * piece.y[k] - edge.dy * piece.x[k] + edge.c;
    if (std::abs(sides_[k]) <= bound) sides_[k] = exact_side_of(piece, k, edge);
  }
}

/// The determinant of corner k of `piece` and the line of `edge` where it is too small for Real:
/// its sign right, and its value too, which says where a cut goes.
template <class Real>
Real FastView<Real>::exact_side_of(const Piece& piece, std::size_t k, const Edge& edge) const {
  const std::size_t before = k > 0 ? k - 1 : piece.count - 1;
  const LineId leaving = edges_[static_cast<std::size_t>(piece.edge[k] >> 1)].line;
  const LineId arriving = edges_[static_cast<std::size_t>(piece.edge[before] >> 1)].line;
  // A corner of an edge on that very line is on it, whatever rounding has done to it.
  if (leaving == edge.line || arriving == edge.line) return 0;
  const PointId point = piece.point[k];
  if (point != made_by_cut && edge.line >= 0) {
    const BspTree::Line& points = outlines_.lines[static_cast<std::size_t>(edge.line)];
    if (point == points.a || point == points.b) return 0;
  }
  if (edge.line == halving ||
      (point == made_by_cut && (leaving == halving || arriving == halving))) {
    return edge.dx * piece.y[k] - edge.dy * piece.x[k] + edge.c;
  }
  ++counts_.exact_decisions;
  const GridLine line = grid_line(edge.line, edge.forward);
  return static_cast<Real>(
      point == made_by_cut ? exact_side(line, grid_line(arriving, true), grid_line(leaving, true))
                           : exact_side(line, faces_.grid.points[static_cast<std::size_t>(point)]));
}

/// Whether an edge of `piece` has all of `other`, which reaches so far, on its outer side.
template <class Real>
bool FastView<Real>::separates(const Piece& piece, const Piece& other, Real reach) const {
  for (std::size_t k = 0; k < piece.count; ++k) {
    const Edge edge = edge_of(piece.edge[k]);
    const Real bound = edge.length * (edge.slack + rounding<Real> * reach);
    if (sides_of(other, edge, bound).left == 0) return true;
  }
  return false;
}

template <class Real>
double FastView<Real>::show(std::int32_t face) {
  const FastFaces::Face& shown = faces_.faces[static_cast<std::size_t>(face)];
  load_corners(shown, shown_);
  edges_.resize(kept_edges_);
  Real area = 0;
  // Parts that are put back at the end of the list lie outside of what is shown.
  std::size_t end = left_count_;
  for (std::size_t p = 0; p < end;) {
    if (!left_[p].box.overlaps(shown_.box)) {
      ++p;
      continue;
    }
    if (edges_.size() == kept_edges_) {
      load_edges(shown, shown_);
      shown_reach_ = reach_of(shown_.box);
    }
    ++counts_.pairs;
    if (!eat(p, area)) {
      ++p;
      continue;
    }
    // The last of those to be looked at takes its place, and the last of all that one's.
    --end;
    if (p != end) left_[p] = left_[end];
    --left_count_;
    if (end != left_count_) left_[end] = left_[left_count_];
  }
  if (area > 0) left_area_ -= area;
  return static_cast<double>(area);
}

/// Takes shown_ out of a piece: adds the area inside to `area`, and puts what lies outside at the
/// end of the list. Returns false where they share nothing.
template <class Real>
bool FastView<Real>::eat(std::size_t place, Real& area) {
  const std::size_t parts = left_count_;
  std::uint32_t cuts = 0;
  {
    const Piece& piece = left_[place];
    for (std::size_t k = 0; k < shown_.count; ++k) {
      const Edge& edge = edges_[static_cast<std::size_t>(shown_.edge[k] >> 1)];
      const Sides sides = sides_of(piece, edge, edge.length * (edge.slack + piece.error));
      if (sides.left == 0) return false;
      cuts |= static_cast<std::uint32_t>(sides.right != 0) << k;
    }
    if (cuts != 0 && separates(piece, shown_, shown_reach_)) return false;
    if (cuts == 0) {
      area += area_of(piece);
      return true;
    }
    rest_ = piece;
  }
  for (; cuts != 0; cuts &= cuts - 1) {
    const EdgeRef ref = shown_.edge[static_cast<std::size_t>(std::countr_zero(cuts))];
    const Edge edge = edge_of(ref);
    const Real bound = edge.length * (edge.slack + rest_.error);
    const Sides sides = sides_of(rest_, edge, bound);
    if (sides.left == 0) {
      // They share nothing: take the cuts back.
      left_count_ = parts;
      return false;
    }
    if (sides.right == 0) continue;
    measure(rest_, edge, bound);
    if (left_.size() <= left_count_) left_.resize(left_count_ + 1);
    split(rest_, ref, sides, inside_, left_[left_count_++]);
    std::swap(rest_, inside_);
  }
  kept_edges_ = edges_.size();
  area += area_of(rest_);
  return true;
}

/// Splits a piece along a line that has corners on both sides, as sides_of() has just found.
///
///            F ── … ── L        F … L: corners on the left, which is inside
///           /           \\.
///      ────Y─────────────X───►  X, Y: corners on the line, or made by the cut; of both parts
///           \\           /
///            … ─── … ──        outside
template <class Real>
void FastView<Real>::split(const Piece& piece, EdgeRef by, Sides sides, Piece& inside,
                           Piece& outside) {
  ++counts_.cuts;
  const std::size_t count = piece.count;
  const auto after = [count](std::size_t k) { return k + 1 < count ? k + 1 : 0; };
  const auto before = [count](std::size_t k) { return k > 0 ? k - 1 : count - 1; };
  const auto is_left = [&](std::size_t k) { return (sides.left >> k & 1) != 0; };
  // Find a run of corners on the left; in a convex piece there is but one.
  auto first = static_cast<std::size_t>(std::countr_zero(sides.left));
  if (first == 0) {
    while (is_left(before(first))) first = before(first);
  }
  inside.count = outside.count = 0;
  inside.error = outside.error = piece.error;
  std::size_t last = first;
  for (std::size_t k = first; is_left(k); k = after(k)) {
    inside.add(piece.x[k], piece.y[k], piece.edge[k], piece.point[k]);
    last = k;
  }
  // X, where the outline leaves the left side.
  std::size_t k = after(last);
  if (sides_[k] == 0) {
    inside.add(piece.x[k], piece.y[k], by, piece.point[k]);
    outside.add(piece.x[k], piece.y[k], piece.edge[k], piece.point[k]);
    k = after(k);
  } else {
    add_crossing(piece, last, k, by, inside, outside);
  }
  // Y, where it comes back.
  const std::size_t back = before(first);
  const std::size_t end = sides_[back] == 0 ? back : first;
  for (; k != end; k = after(k)) outside.add(piece.x[k], piece.y[k], piece.edge[k], piece.point[k]);
  if (end == back) {
    inside.add(piece.x[back], piece.y[back], piece.edge[back], piece.point[back]);
    outside.add(piece.x[back], piece.y[back], by ^ 1, piece.point[back]);
  } else {
    add_crossing(piece, back, first, by, inside, outside);
  }
  inside.finish();
  outside.finish();
}

/// The point of the grid through which two lines both run by their making, if any.
template <class Real>
PointId FastView<Real>::common_point(LineId p, LineId q) const {
  if (p < 0 || q < 0) return made_by_cut;
  const BspTree::Line& a = outlines_.lines[static_cast<std::size_t>(p)];
  const BspTree::Line& b = outlines_.lines[static_cast<std::size_t>(q)];
  if (a.a == b.a || a.a == b.b) return a.a;
  return a.b == b.a || a.b == b.b ? a.b : made_by_cut;
}

/// Adds the point where the edge from corner `from` to corner `to` crosses the line `by` to both
/// parts.
template <class Real>
void FastView<Real>::add_crossing(const Piece& piece, std::size_t from, std::size_t to, EdgeRef by,
                                  Piece& inside, Piece& outside) {
  const Real here = sides_[from], there = sides_[to];
  const Real across = 1 / (here - there);
  const Real dx = piece.x[to] - piece.x[from], dy = piece.y[to] - piece.y[from];
  const Real t = here * across;
  Real x = piece.x[from] + t * dx, y = piece.y[from] + t * dy;
  const Edge& edge = edges_[static_cast<std::size_t>(piece.edge[from] >> 1)];
  const Edge& cutting = edges_[static_cast<std::size_t>(by >> 1)];
  // It lies near both lines, whatever the corners' errors along theirs; the flatter the angle, the
  // farther from where they meet.
  const Real nearness = edge.slack + cutting.slack + rounding<Real> * (std::abs(x) + std::abs(y));
  const Real flatness =
      edge.length * cutting.length / std::abs(edge.dx * cutting.dy - edge.dy * cutting.dx);
  Real error = nearness * flatness;
  const PointId common = common_point(edge.line, cutting.line);
  if (common != made_by_cut) {
    const GridPoint& p = faces_.grid.points[static_cast<std::size_t>(common)];
    x = static_cast<Real>(p.x - origin_.x);
    y = static_cast<Real>(p.y - origin_.y);
    error = 0;
  } else if (!(flatness < 0x1p16) && edge.line != halving && cutting.line != halving) {
    // The lines meet at a flat angle.
    ++counts_.exact_decisions;
    const Meeting meeting =
        exact_meeting(grid_line(edge.line, true), grid_line(cutting.line, true), origin_);
    if (!meeting.parallel) {
      // Corners of cut faces lie a little off their lines: no farther than the edge goes.
      const auto [x0, x1] = std::minmax(piece.x[from], piece.x[to]);
      const auto [y0, y1] = std::minmax(piece.y[from], piece.y[to]);
      x = std::clamp(static_cast<Real>(meeting.x), x0, x1);
      y = std::clamp(static_cast<Real>(meeting.y), y0, y1);
      error = nearness;
    }
  }
  // The outline goes on along the line where it leaves a part's own side.
  const bool leaves_inside = here > 0;
  inside.add(x, y, leaves_inside ? by : piece.edge[from], common);
  outside.add(x, y, leaves_inside ? piece.edge[from] : by ^ 1, common);
  inside.error = std::max(inside.error, error);
  outside.error = std::max(outside.error, error);
}

template <class Real>
Real FastView<Real>::area_of(const Piece& piece) {
  Real twice = 0;
  const Real x0 = piece.x[0], y0 = piece.y[0];
  for (std::size_t k = 2; k < piece.count; ++k) {
    twice += (piece.x[k - 1] - x0) * (piece.y[k] - y0) - (piece.y[k - 1] - y0) * (piece.x[k] - x0);
  }
  return std::max(Real{0}, twice / 2);
}

template class FastView<double>;
template class FastView<long double>;

}  // namespace transillum
