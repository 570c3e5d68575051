// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// The difference of a convex polygon and other convex polygons of the same plane, as a set of
/// convex parts.
///
/// The lines of the subtracted polygons come from the caller and are not recomputed from the ends
/// of edges, so that edges made very short by cuts cause no error.
class PlaneRegion {
 public:
  /// A point of a plane.
  struct Point {
    double u = 0;  ///< first coordinate
    double v = 0;  ///< second coordinate
  };

  /// A half-plane: points with a u + b v + c > 0 are inside; a² + b² = 1.
  struct Side {
    double a = 0, b = 0, c = 0;

    double distance(const Point& p) const { return a * p.u + b * p.v + c; }
  };

  /// An axis-parallel rectangle; empty until a point is added.
  struct Box {
    Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

    void add(const Point& p) {
      low = {std::min(low.u, p.u), std::min(low.v, p.v)};
      high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    bool overlaps(const Box& other) const {
      return low.u <= other.high.u && other.low.u <= high.u && low.v <= other.high.v &&
             other.low.v <= high.v;
    }
  };

  /// Starts with one convex polygon, of either orientation; the parts have the same.
  void assign(std::span<const Point> polygon);
  /// Subtracts the convex polygon inside all `sides`, of which there is at least one.
  /// @param box contains the polygon.
  void subtract(std::span<const Side> sides, const Box& box);

  bool empty() const { return convex_.empty(); }
  std::size_t size() const { return convex_.size(); }  ///< convex parts
  /// Calls visit(corners) for each remaining convex part; they do not overlap.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Convex& convex : convex_) {
      visit(corners(convex));
    }
  }

 private:
  struct Convex {
    std::uint32_t begin, end;  ///< in corners_
    Box box;
  };
  std::span<const Point> corners(const Convex& convex) const {
    return {corners_.data() + convex.begin, convex.end - convex.begin};
  }
  bool is_outside(const Convex& convex, const Side& side) const;
  void subtract_from(Convex convex, std::span<const Side> sides);
  Convex kept(const Convex& convex, const Side& side);

  double tolerance_ = 0;  ///< points nearer to a line than this are treated as on it
  std::vector<Point> corners_;
  std::vector<Convex> convex_, left_;
};

}  // namespace transillum
