// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/cut_corners.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Lines that meet farther from the rounded corner, in grid units, count as parallel.
constexpr long double farthest_meeting = 0x1p20L;

/// Bound on the apparent turn to the right, by rounding, at a corner, relative to its edges.
constexpr long double turn_rounding = 0x1p-58L;

}  // namespace

void CutCorners::begin() {
  ranges_.clear();
  edges_.clear();
}

std::span<const CutCorners::Edge> CutCorners::outline(std::int32_t fragment) {
  const ProjectedFragments::Fragment& own = at(projected_.fragments, fragment);
  if (is_uncut(own)) {
    plain_.clear();
    add_grid_corners(own);
    return plain_;
  }
  if (ranges_.empty()) {
    ranges_.resize(projected_.fragments.size());
  }
  Range& range = at(ranges_, fragment);
  if (!range.known) {
    range.known = true;
    range.begin = static_cast<std::uint32_t>(edges_.size());
    add_cut_corners(own);
    if (!is_convex(range.begin)) {
      edges_.resize(range.begin);
      if (!own.cut_needle) {
        plain_.clear();
        add_grid_corners(own);
        edges_.insert(edges_.end(), plain_.begin(), plain_.end());
      }
    }
    range.end = static_cast<std::uint32_t>(edges_.size());
  }
  return std::span(edges_).subspan(range.begin, range.end - range.begin);
}

/// Adds an outline to plain_, from grid point to grid point.
void CutCorners::add_grid_corners(const ProjectedFragments::Fragment& fragment) {
  for (std::uint32_t k = fragment.begin; k < fragment.end; ++k) {
    const GridPoint& here = projected_.corners[k];
    const GridPoint& next = projected_.corners[k + 1 < fragment.end ? k + 1 : fragment.begin];
    plain_.push_back({{here}, {here}, {next}});
  }
}

/// Adds an outline to edges_. Where lines are nearly parallel, the corner is the rounded point, and
/// its edges run from corner to corner.
void CutCorners::add_cut_corners(const ProjectedFragments::Fragment& fragment) {
  const std::uint32_t count = fragment.end - fragment.begin;
  std::array<bool, FragmentOutlines::max_corners> loose{};
  std::array<FragmentOutlines::Corner, FragmentOutlines::max_corners> corners;
  for (std::uint32_t k = 0; k < count; ++k) {
    corners[k] = projected_.corner_of(outlines_, fragment, k);
  }
  const std::size_t begin = edges_.size();
  for (std::uint32_t k = 0; k < count; ++k) {
    const FragmentOutlines::Corner& arriving = corners[k > 0 ? k - 1 : count - 1];
    FinePoint corner{projected_.corners[fragment.begin + k]};
    if (!corners[k].exact) {
      loose[k] = true;
      if (!projected_.is_grid_point(outlines_, fragment, k)) {
        const Meeting meeting =
            exact_meeting(projected_.line_of(outlines_, arriving),
                          projected_.line_of(outlines_, corners[k]), corner.grid);
        if (std::abs(meeting.x) + std::abs(meeting.y) < farthest_meeting) {
          corner.x = static_cast<double>(meeting.x);
          corner.y = static_cast<double>(meeting.y);
          loose[k] = false;
        }
      }
    }
    const GridLine line = projected_.line_of(outlines_, corners[k]);
    edges_.push_back({corner, {line.a}, {line.b}});
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = k + 1 < count ? k + 1 : 0;
    if (loose[k] || loose[next]) {
      Edge& edge = edges_[begin + k];
      edge.from = edge.corner;
      edge.to = edges_[begin + next].corner;
    }
  }
}

/// Whether the corners of edges_ from `begin` on turn left, up to rounding, along their edges.
bool CutCorners::is_convex(std::size_t begin) const {
  const std::size_t count = edges_.size() - begin;
  const GridPoint& origin = edges_[begin].corner.grid;
  const auto corner = [&](std::size_t k) {
    const FinePoint& p = edges_[begin + k % count].corner;
    return ProjectedFragments::Position{
        static_cast<long double>(p.grid.x - origin.x) + static_cast<long double>(p.x),
        static_cast<long double>(p.grid.y - origin.y) + static_cast<long double>(p.y)};
  };
  long double twice_area = 0, size = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto a = corner(k), b = corner(k + 1), c = corner(k + 2);
    const long double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
    const long double reach = std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y) +
                              std::abs(c.x) + std::abs(c.y);
    const long double length = std::abs(ux) + std::abs(uy) + std::abs(vx) + std::abs(vy);
    if (ux * vy - uy * vx < -turn_rounding * reach * length) {
      return false;
    }
    // Each edge runs in the direction of its line.
    const Edge& edge = edges_[begin + k];
    const auto dx = static_cast<long double>(edge.to.grid.x - edge.from.grid.x);
    const auto dy = static_cast<long double>(edge.to.grid.y - edge.from.grid.y);
    if (dx * ux + dy * uy < 0) {
      return false;
    }
    twice_area += a.x * b.y - a.y * b.x;
    size = std::max(size, reach * length);
  }
  return twice_area > turn_rounding * size;
}

}  // namespace transillum
