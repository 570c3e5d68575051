// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// BoundaryView in the coordinates of a NeedleFrame: loading a fragment and candidates. In
// Frame::plane, the frame is a translation, and only candidates that the tree has cut to needles
// are loaded here.
#include <algorithm>
#include <cmath>
#include <limits>

#include "transillum/at.h"
#include "visibility/queries/bin_clip.h"
#include "visibility/queries/boundary_view.h"

namespace transillum {
namespace {

/// Bound on the rounding error of a determinant in double, relative to its products.
constexpr double determinant_rounding = 0x1p-50;
/// Distance, in grid units, of a cut corner from the rounded one; see CutCorners.
constexpr double cut_corner_offset = 0x1p21;

/// The longest edge between some corners on the grid.
GridPoint longest_edge(std::span<const CutCorners::Edge> outline) {
  GridPoint longest;
  double most = -1;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const GridPoint &a = outline[k].corner.grid,
                    &b = outline[k + 1 < outline.size() ? k + 1 : 0].corner.grid;
    const GridPoint edge{b.x - a.x, b.y - a.y};
    const double length = std::hypot(static_cast<double>(edge.x), static_cast<double>(edge.y));
    if (length > most) {
      most = length;
      longest = edge;
    }
  }
  return longest;
}

/// The factor that makes a polygon as high as it is long, a power of two; 0 for none.
double scale_of(const WidePolygon& polygon, std::size_t count, bool steep) {
  long double x0 = std::numeric_limits<long double>::infinity(), x1 = -x0, h0 = x0, h1 = -x0;
  for (std::size_t k = 0; k < count; ++k) {
    const long double x = steep ? polygon[k].y : polygon[k].x;
    x0 = std::min(x0, x);
    x1 = std::max(x1, x);
    h0 = std::min(h0, polygon[k].height);
    h1 = std::max(h1, polygon[k].height);
  }
  const auto ratio = static_cast<double>((x1 - x0) / (h1 - h0));
  if (!(ratio > 0) || std::isinf(ratio)) {
    return 0;
  }
  int exponent = 0;
  std::frexp(ratio, &exponent);
  return std::ldexp(1.0, exponent - 1);
}

}  // namespace

/// Loads the fragment, or its part in the bin, in a frame that makes it as high as long.
void BoundaryView::load_in_frame() {
  region_->count = 0;
  const auto outline =
      cut_corners_.outline(static_cast<std::int32_t>(subject_ - projected_.fragments.data()));
  const GridPoint longest = outline.empty() ? GridPoint{} : longest_edge(outline);
  if (longest.x == 0 && longest.y == 0) {
    failure_ = QueryFailure::flat;
    return;
  }
  frame_.set_along(longest);
  const GridPoint first = outline[0].corner.grid;
  const std::int64_t half = bin_ ? bin_->size / 2 : 0;
  const GridPoint center = bin_ ? GridPoint{bin_->x + half, bin_->y + half} : first;
  frame_.origin = first;
  WidePolygon polygon;
  std::size_t count = 0;
  for (const CutCorners::Edge& edge : outline) {
    const FinePoint& p = edge.corner;
    polygon[count++] = {static_cast<long double>(p.grid.x - center.x) + p.x,
                        static_cast<long double>(p.grid.y - center.y) + p.y, frame_.height(p)};
  }
  if (bin_) {
    count = clip_to_bin(polygon, count, static_cast<long double>(half));
    if (count == 0) {
      return;
    }
    frame_.origin = {center.x + std::llrint(polygon[0].x), center.y + std::llrint(polygon[0].y)};
  }
  const bool steep = frame_.kept == NeedleFrame::Kept::y;
  const double scale = scale_of(polygon, count, steep);
  if (scale == 0) {
    failure_ = QueryFailure::flat;
    return;
  }
  frame_.set_scale(scale);
  per_area_ = 1 / frame_.determinant;
  // Heights are relative to the first corner, x and y to the center.
  const long double lift = frame_.height({first});
  const auto shift =
      static_cast<long double>(steep ? center.y - frame_.origin.y : center.x - frame_.origin.x);
  std::array<NeedleFrame::Point, std::tuple_size_v<WidePolygon>> corners;
  for (std::size_t k = 0; k < count; ++k) {
    corners[k] = {static_cast<double>((steep ? polygon[k].y : polygon[k].x) + shift),
                  scale * static_cast<double>(polygon[k].height + lift)};
  }
  double reach = 0, twice_area = 0;
  own_edges_.count = std::min(count, Cutter::max_edges);
  for (std::size_t k = 0; k < count; ++k) {
    const auto &p = corners[k], &q = corners[k + 1 < count ? k + 1 : 0];
    region_->add(p.x, p.y, q.x, q.y);
    reach = std::max(reach, std::abs(p.x) + std::abs(p.y));
    twice_area +=
        (p.x - corners[0].x) * (q.y - corners[0].y) - (p.y - corners[0].y) * (q.x - corners[0].x);
    if (k < own_edges_.count) {
      own_edges_.x[k] = p.x;
      own_edges_.y[k] = p.y;
      own_edges_.dx[k] = q.x - p.x;
      own_edges_.dy[k] = q.y - p.y;
      own_edges_.length[k] = std::abs(q.x - p.x) + std::abs(q.y - p.y);
    }
  }
  origin_ = frame_.origin;
  start(per_area_ * 0.5 * twice_area, reach);
}

/// Whether a candidate is certainly above or below the region in the frame. Most candidates of a
/// long needle are: its octagon overlaps all that is near its length.
bool BoundaryView::is_beside_frame(const ProjectedFragments::Fragment& by) const {
  const auto ax = static_cast<double>(frame_.along.x), ay = static_cast<double>(frame_.along.y);
  const double offset =
      cut_corners_.is_uncut(by) ? 0 : cut_corner_offset * (std::abs(ax) + std::abs(ay));
  const double high = extent_[1] / frame_.scale + offset;
  const double low = -extent_[5] / frame_.scale - offset;
  const GridPoint* const corners = projected_.corners.data();
  bool all_above = true, all_below = true;
  for (std::uint32_t k = by.begin; k < by.end; ++k) {
    const double above = ax * static_cast<double>(corners[k].y - frame_.origin.y);
    const double below = ay * static_cast<double>(corners[k].x - frame_.origin.x);
    const double error = determinant_rounding * (std::abs(above) + std::abs(below));
    all_above = all_above && above - below - error > high;
    all_below = all_below && above - below + error < low;
  }
  return all_above || all_below;
}

bool BoundaryView::load_cutter_in_frame(std::int32_t candidate) {
  const auto outline = cut_corners_.outline(candidate);
  if (outline.empty()) {
    failure_ = QueryFailure::candidate;
    return false;
  }
  if (!in_frame_) {
    frame_.origin = origin_;
  }
  cutter_.count = outline.size();
  for (std::size_t k = 0; k < cutter_.count; ++k) {
    const NeedleFrame::Point p = frame_.map(outline[k].corner);
    cutter_.x[k] = p.x;
    cutter_.y[k] = p.y;
  }
  cutter_.perimeter = 0;
  for (std::size_t k = 0; k < cutter_.count; ++k) {
    const std::size_t next = k + 1 < cutter_.count ? k + 1 : 0;
    const NeedleFrame::Line line = frame_.map(outline[k].from, outline[k].to);
    const double x = cutter_.x[k], y = cutter_.y[k];
    const double ux = cutter_.x[next] - x, uy = cutter_.y[next] - y;
    cutter_.dx[k] = line.dx;
    cutter_.dy[k] = line.dy;
    cutter_.c[k] = line.c;
    cutter_.middle[k] = (line.dx * x + line.dy * y) + 0.5 * (line.dx * ux + line.dy * uy);
    cutter_.length[k] = std::abs(line.dx) + std::abs(line.dy);
    cutter_.perimeter += std::abs(ux) + std::abs(uy);
  }
  return true;
}

bool BoundaryView::is_cutter_outside_own_edge() const {
  double far = 0;
  for (std::size_t k = 0; k < cutter_.count; ++k) {
    far = std::max(far, std::abs(cutter_.x[k]) + std::abs(cutter_.y[k]));
  }
  return is_outside_own_edge(cutter_.x.data(), cutter_.y.data(), cutter_.count, far);
}

/// Bounds of the region on the plane.
void BoundaryView::find_window_in_frame() {
  std::array<double, 8> most;
  most.fill(-HUGE_VAL);
  for (std::size_t k = 0; k < region_->count; ++k) {
    const NeedleFrame::Point p = frame_.unmap(region_->ax[k], region_->ay[k]);
    const std::array<double, 4> along{p.x, p.y, p.x + p.y, p.x - p.y};
    for (std::size_t d = 0; d < 4; ++d) {
      most[d] = std::max(most[d], along[d]);
      most[d + 4] = std::max(most[d + 4], -along[d]);
    }
  }
  for (std::size_t d = 0; d < 8; ++d) {
    window_.ends[d] = rounded_up(origin_extent_[d] + most[d]);
  }
}

}  // namespace transillum
