// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "visibility/projection.h"

namespace transillum {

/// A corner of a polygon of the map, and the tree's line on which the edge to the next corner
/// lies, whatever has been cut off that edge since.
struct MapCorner {
  PlanePoint at;
  LineId line;
  bool forward;  ///< the edge runs along its line from a to b
};

/// A convex polygon of the map, counter-clockwise.
using MapPolygon = std::vector<MapCorner>;

/// Area by closed form, relative to the first corner so that small polygons far out keep their
/// digits.
Real area_of(const MapPolygon& polygon);

/// Cuts convex polygons against one another by the lines of their edges.
class MapClipper {
 public:
  explicit MapClipper(const Projection& projection) : projection_(projection) {}

  /// Splits `subject` into the part inside `window`, left in inside(), and parts outside, left in
  /// outside(0) … outside(outside_count() - 1). Returns false, and leaves nothing, where the two
  /// share no area; no cut is made then.
  bool clip(const MapPolygon& subject, const MapPolygon& window);

  const MapPolygon& inside() const { return inside_; }
  Real inside_area() const { return inside_area_; }
  std::size_t outside_count() const { return outside_count_; }
  const MapPolygon& outside(std::size_t k) const { return outside_[k]; }

 private:
  bool separated(const MapPolygon& by, const MapPolygon& other);
  void measure_sides(const MapPolygon& polygon, const MapCorner& edge);
  void split(const MapCorner& edge);

  const Projection& projection_;
  MapPolygon inside_, kept_;
  std::vector<MapPolygon> outside_;
  std::size_t outside_count_ = 0;
  Real inside_area_ = 0;
  std::vector<Real> sides_;  ///< of the corners of the polygon at hand, > 0 inside
};

}  // namespace transillum
