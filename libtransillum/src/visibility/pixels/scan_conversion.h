// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Scan conversion of polygons with corners in grid units (PixelGrid), for the engines zbuffer and
// painter.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "transillum/at.h"
#include "visibility/pixels/pixel_grid.h"

namespace transillum {

/// Scan conversion of convex polygons. A polygon covers the pixels whose centers it contains, its
/// left and lower edges included, the others excluded: polygons that share an edge share no pixel
/// and miss none.
///
/// The crossing of an edge with a row is computed from the line that the edge is a part of, so
/// fragments of one polygon still share no pixel and miss none.
class ScanConverter {
 public:
  /// Keeps a reference.
  explicit ScanConverter(const PixelGrid& grid) : grid_(grid) {}

  /// Starts a polygon; only rows from `first` up to, not including, `end` are converted.
  void begin(int first, int end) {
    first_ = std::max(first, 0);
    end_ = std::min(end, grid_.rows());
    low_ = end_;
    high_ = first_;
    const auto count = static_cast<std::size_t>(std::max(end_ - first_, 0));
    if (spans_.size() < count) {
      spans_.resize(count, nothing);
    }
  }

  /// Adds an edge, a part of the line through a and b. Edges may come in any order.
  void add_edge(PixelPoint from, PixelPoint to, PixelPoint a, PixelPoint b) {
    if (from.y > to.y) {
      std::swap(from, to);
    }
    if (a.y > b.y) {
      std::swap(a, b);
    }
    if (a.y == b.y) {
      a = from;
      b = to;
    }
    const int begin = std::max(grid_.first_center_from(from.y), first_);
    const int end = std::min(grid_.first_center_from(to.y), end_);
    if (begin >= end) {
      return;
    }
    low_ = std::min(low_, begin);
    high_ = std::max(high_, end);
    for (int row = begin; row < end; ++row) {
      Span& span = at(spans_, row - first_);
      const int column = first_column(a, b, grid_.center_of(row));
      span.begin = std::min(span.begin, column);
      span.end = std::max(span.end, column);
    }
  }

  /// Calls visit(row, begin, end) with the span of covered pixels of each row; end is one beyond
  /// the last.
  template <class Visit>
  void finish(Visit&& visit) {
    for (int row = low_; row < high_; ++row) {
      Span& span = at(spans_, row - first_);
      const Span covered = std::exchange(span, nothing);
      if (covered.begin < covered.end) {
        visit(row, covered.begin, covered.end);
      }
    }
  }

 private:
  struct Span {
    int begin, end;
  };
  static constexpr Span nothing{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};

  /// The first pixel whose center is on the line from a up to b at ordinate y, or right of it.
  int first_column(const PixelPoint& a, const PixelPoint& b, std::int64_t y) const {
    // (x - p/2) / p, rounded up, where p = units_per_pixel() and
    // x = a.x + (y - a.y) (b.x - a.x) / (b.y - a.y).
    const std::int64_t height = b.y - a.y;
    const std::int64_t above =
        (a.x - grid_.units_per_pixel() / 2) * height + (y - a.y) * (b.x - a.x);
    const std::int64_t below = height << grid_.bits();
    const std::int64_t quotient = above / below;
    const std::int64_t column = quotient + (above > quotient * below ? 1 : 0);
    return static_cast<int>(std::clamp<std::int64_t>(column, 0, grid_.columns()));
  }

  const PixelGrid& grid_;
  int first_ = 0, end_ = 0, low_ = 0, high_ = 0;
  std::vector<Span> spans_;  ///< spans of the rows from first_ on; `nothing` between polygons
};

}  // namespace transillum
