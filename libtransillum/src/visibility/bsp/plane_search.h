// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/bsp_tree.h"

namespace transillum {

/// Finds a plane that orders many polygons at the price of few cuts.
///
/// Candidates are swept: for each of a few dozen normals (the axes, normals of polygons, normals
/// to two edges, lines between polygons) all offsets are scored at once from the sorted intervals
/// that the polygons cover along it. So free planes in the gaps between groups and the planes of
/// polygons compete on equal terms. Large sets are judged by a sample
/// (decisions/0004-choice-of-planes.md).
class PlaneSearch {
 public:
  struct Choice {
    BspTree::Plane plane;
    std::int32_t polygon;  ///< the added polygon that lies in the plane for certain, or -1
  };

  explicit PlaneSearch(double thickness) : thickness_(thickness) {}

  void clear();
  /// Starts a polygon; its points follow.
  void add_polygon(const BspTree::Plane& plane);
  void add_point(const Vec3& point) { points_.push_back(point); }
  /// The best plane; every side of it gets fewer polygons than were added.
  Choice best();

 private:
  struct Interval {
    double low, high;
    std::int32_t polygon;
  };
  void collect_sample();
  void collect_normals();
  void sweep(const Vec3& normal);
  void offer(const Vec3& normal, double offset, std::int32_t polygon, double below, double above,
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
