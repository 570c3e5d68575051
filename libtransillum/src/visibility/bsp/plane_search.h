// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/bsp_tree.h"

namespace transillum {

/// Finds a plane that orders many polygons with few cuts.
///
/// For each of a few dozen normals (the axes, normals of polygons, normals to two edges, lines
/// between polygons) all offsets are scored in one sweep over the sorted intervals that the
/// polygons cover along the normal. Planes in the gaps between groups and planes of polygons are
/// thus compared by the same cost. Large sets are represented by a sample
/// (decisions/0004-choice-of-planes.md).
///
/// Use: clear(), then add_polygon() and its add_point()s per polygon, then best().
class PlaneSearch {
 public:
  struct Choice {
    BspTree::Plane plane;
    std::int32_t polygon;  ///< an added polygon that lies in the plane by definition, or -1
  };

  explicit PlaneSearch(double thickness) : thickness_(thickness) {}

  void clear();
  /// Starts a polygon; its points follow.
  void add_polygon(const BspTree::Plane& plane);
  void add_point(const Vec3& point) { points_.push_back(point); }
  /// The best plane; each side of it gets fewer polygons than were added.
  Choice best();

 private:
  struct Interval {
    double low, high;
    std::int32_t polygon;
  };
  void collect_sample();
  void collect_normals();
  void collect_intervals(const Vec3& normal);
  void sweep(const Vec3& normal);
  void consider_plane_of(const Vec3& normal, const Interval& interval);
  void consider_gap(const Vec3& normal, std::size_t started, std::size_t ended);
  void consider(const Vec3& normal, double offset, std::int32_t polygon, double below, double above,
                double crossing);
  Vec3 center_of(std::int32_t polygon) const;

  double thickness_;
  std::vector<BspTree::Plane> planes_;
  std::vector<std::uint32_t> begin_;
  std::vector<Vec3> points_;
  std::vector<std::int32_t> sample_;
  std::vector<Vec3> normals_;
  std::vector<Interval> intervals_;
  std::vector<double> ends_;
  double best_cost_ = 0;
  Choice best_{};
};

}  // namespace transillum
