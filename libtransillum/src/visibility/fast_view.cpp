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

}  // namespace

template <class Real>
typename FastView<Real>::Piece& FastView<Real>::Piece::operator=(const Piece& other) {
  count = other.count;
  error = other.error;
  const auto filled = static_cast<std::ptrdiff_t>((count + 3) / 4 * 4);
  std::copy(other.x.begin(), other.x.begin() + filled, x.begin());
  std::copy(other.y.begin(), other.y.begin() + filled, y.begin());
  std::copy(other.edge.begin(), other.edge.begin() + filled, edge.begin());
  std::copy(other.point.begin(), other.point.begin() + filled, point.begin());
  return *this;
}

template <class Real>
void FastView<Real>::look_from(std::int32_t face) {
  const FastFaces::Face& own = faces_.faces[static_cast<std::size_t>(face)];
  origin_ = faces_.corners[own.begin].at;
  edges_.clear();
  if (left_.empty()) left_.resize(1);
  load(own, left_[0]);
  left_count_ = 1;
  kept_edges_ = edges_.size();
  left_area_ = area_ = static_cast<Real>(own.area);
}

template <class Real>
bool FastView<Real>::look_from(std::int32_t face, const FastBins::Bin& bin) {
  look_from(face);
  bin_ = bin;
  Piece& piece = left_[0];
  for (const LineId line : {low_x, low_y, high_x, high_y}) {
    const EdgeRef edge = add_edge(grid_line(line, true), line, true);
    const Sides sides = sides_of(piece, edge_of(edge));
    if (sides.left == 0) return false;
    if (sides.right == 0) continue;
    split(piece, edge, sides, inside_, rest_);
    piece = inside_;
  }
  kept_edges_ = edges_.size();
  left_area_ = area_ = area_of(piece);
  return area_ > 0;
}

template <class Real>
void FastView<Real>::load(const FastFaces::Face& face, Piece& piece) {
  const FaceCorner* const corners = faces_.corners.data() + face.begin;
  const std::size_t count = face.end - face.begin;
  piece.count = 0;
  piece.error = 0;
  for (std::size_t k = 0; k < count; ++k) {
    piece.add(static_cast<Real>(corners[k].at.x - origin_.x),
              static_cast<Real>(corners[k].at.y - origin_.y), 0, corners[k].point);
  }
  piece.fill_up();
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
  edges_.push_back({dx, dy, dy * x - dx * y, std::abs(dx) + std::abs(dy), std::abs(x) + std::abs(y),
                    line, forward});
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

/// On which sides of the line of `edge` the corners of `piece` lie: those on it on neither. Leaves
/// their determinants in sides_, and how far these may be wrong in side_errors_.
template <class Real>
typename FastView<Real>::Sides FastView<Real>::sides_of(const Piece& piece, const Edge& edge) {
  Sides sides{0, 0};
  std::uint32_t unsure = 0;
  const std::size_t count = piece.count;
  for (std::size_t k = 0; k < count; ++k) {
    const Real side = edge.dx * piece.y[k] - edge.dy * piece.x[k] + edge.c;
    const Real error =
        edge.length * (rounding<Real> * (std::abs(piece.x[k]) + std::abs(piece.y[k]) + edge.reach) +
                       piece.error + off_line);
    sides_[k] = side;
    side_errors_[k] = error;
    sides.left |= static_cast<std::uint32_t>(side > error) << k;
    sides.right |= static_cast<std::uint32_t>(side < -error) << k;
    unsure |= static_cast<std::uint32_t>(std::abs(side) <= error) << k;
  }
  counts_.decisions += static_cast<std::int64_t>(count);
  for (; unsure != 0; unsure &= unsure - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(unsure));
    sides_[k] = exact_side_of(piece, k, edge);
    side_errors_[k] = rounding<Real> * std::abs(sides_[k]);
    sides.left |= static_cast<std::uint32_t>(sides_[k] > 0) << k;
    sides.right |= static_cast<std::uint32_t>(sides_[k] < 0) << k;
  }
  return sides;
}

/// The determinant of corner k of `piece` and the line of `edge` where it is too small for Real:
/// its sign right, and its value too, which says where a cut goes.
template <class Real>
Real FastView<Real>::exact_side_of(const Piece& piece, std::size_t k, const Edge& edge) {
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
    return sides_[k];
  }
  ++counts_.exact_decisions;
  const GridLine line = grid_line(edge.line, edge.forward);
  return static_cast<Real>(
      point == made_by_cut ? exact_side(line, grid_line(arriving, true), grid_line(leaving, true))
                           : exact_side(line, faces_.grid.points[static_cast<std::size_t>(point)]));
}

/// Whether an edge of `piece` has all of `other` on its outer side.
template <class Real>
bool FastView<Real>::separates(const Piece& piece, const Piece& other) {
  for (std::size_t k = 0; k < piece.count; ++k) {
    if (sides_of(other, edge_of(piece.edge[k])).left == 0) return true;
  }
  return false;
}

template <class Real>
double FastView<Real>::show(std::int32_t face) {
  edges_.resize(kept_edges_);
  load(faces_.faces[static_cast<std::size_t>(face)], shown_);
  next_count_ = 0;
  Real area = 0;
  for (std::size_t p = 0; p < left_count_; ++p) area += eat(left_[p]);
  left_.swap(next_left_);
  left_count_ = next_count_;
  left_area_ -= area;
  return static_cast<double>(area);
}

/// Takes shown_ out of `piece`: keeps what lies outside, and returns the area inside.
template <class Real>
Real FastView<Real>::eat(const Piece& piece) {
  ++counts_.pairs;
  // Edges that leave out some of the piece, and whether one leaves out all.
  const std::size_t kept = next_count_;
  cuts_.clear();
  for (std::size_t k = 0; k < shown_.count; ++k) {
    const Sides sides = sides_of(piece, edge_of(shown_.edge[k]));
    if (sides.left == 0) {
      keep(piece);
      return 0;
    }
    if (sides.right != 0) cuts_.push_back(shown_.edge[k]);
  }
  if (cuts_.empty()) return area_of(piece);
  if (separates(piece, shown_)) {
    keep(piece);
    return 0;
  }
  rest_ = piece;
  for (const EdgeRef edge : cuts_) {
    const Sides sides = sides_of(rest_, edge_of(edge));
    if (sides.left == 0) {
      // They share nothing: take the cuts back.
      next_count_ = kept;
      keep(piece);
      return 0;
    }
    if (sides.right == 0) continue;
    if (next_left_.size() <= next_count_) next_left_.resize(next_count_ + 1);
    split(rest_, edge, sides, inside_, next_left_[next_count_++]);
    std::swap(rest_, inside_);
  }
  kept_edges_ = edges_.size();
  return area_of(rest_);
}

template <class Real>
void FastView<Real>::keep(const Piece& piece) {
  if (next_left_.size() <= next_count_) next_left_.resize(next_count_ + 1);
  next_left_[next_count_++] = piece;
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
  inside.fill_up();
  outside.fill_up();
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
  const Real t_error =
      (side_errors_[from] * std::abs(there) + side_errors_[to] * std::abs(here)) * across * across;
  const Real least_error =
      rounding<Real> * (std::abs(x) + std::abs(y) + std::abs(dx) + std::abs(dy));
  Real error = piece.error + least_error + t_error * (std::abs(dx) + std::abs(dy));
  const Edge& edge = edges_[static_cast<std::size_t>(piece.edge[from] >> 1)];
  const Edge& cutting = edges_[static_cast<std::size_t>(by >> 1)];
  if (error > 256 * least_error && edge.line != halving && cutting.line != halving) {
    // The lines meet at a flat angle.
    ++counts_.exact_decisions;
    const Meeting meeting =
        exact_meeting(grid_line(edge.line, true), grid_line(cutting.line, true), origin_);
    if (!meeting.parallel) {
      // Corners of cut faces are not quite on their lines, so these may meet beyond the edge.
      x = std::clamp(static_cast<Real>(meeting.x), std::min(piece.x[from], piece.x[to]),
                     std::max(piece.x[from], piece.x[to]));
      y = std::clamp(static_cast<Real>(meeting.y), std::min(piece.y[from], piece.y[to]),
                     std::max(piece.y[from], piece.y[to]));
      error = least_error;
    }
  }
  // The outline goes on along the line where it leaves a part's own side.
  const bool leaves_inside = here > 0;
  inside.add(x, y, leaves_inside ? by : piece.edge[from], made_by_cut);
  outside.add(x, y, leaves_inside ? piece.edge[from] : by ^ 1, made_by_cut);
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
