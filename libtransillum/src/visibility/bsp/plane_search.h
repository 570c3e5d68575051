// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/polygon_set.h"

namespace transillum {

/// Finds a plane that orders many polygons with few cuts.
///
/// For each of a few dozen normals (the axes, normals of polygons, normals to two edges, lines
/// between polygons) all offsets are compared: the intervals that the polygons cover along the
/// normal are counted in bins; bins whose counts allow a better plane than the best so far are
/// sorted. Planes in the gaps between groups and planes of polygons are thus compared by the same
/// cost. Large sets are represented by a sample (decisions/0004-choice-of-planes.md).
class PlaneSearch {
 public:
  struct Choice {
    BspTree::Plane plane;
    std::int32_t polygon;  ///< a polygon of the set that lies in the plane by definition, or -1
    bool one_sided;        ///< all others are on one side, as far as the sample tells
  };

  /// @param planes of the polygons, by PolygonSet::Polygon::plane; not copied.
  PlaneSearch(const std::vector<BspTree::Plane>& planes, double thickness)
      : planes_(planes), thickness_(thickness) {}

  /// The best plane for a set that is not empty; each side of it gets fewer polygons than the set
  /// has.
  /// @param one_sided whether a one-sided plane is acceptable; if not, one is returned only where
  /// nothing else is found.
  Choice best(const PolygonSet& set, bool one_sided);

 private:
  /// Extent of a polygon of the sample along the normal.
  struct Interval {
    double low, high;
    bool flat() const { return low == high; }
  };
  struct Bin {
    std::uint32_t started, ended;          ///< intervals that started, or ended, in bins before
    std::uint32_t first_start, first_end;  ///< while sorting
    std::uint32_t starts, ends, inside;    ///< in this bin; inside: both
    double least_cost;
  };
  void collect_sample(const PolygonSet& set);
  void collect_normals();
  void collect_intervals(const Vec3& normal);
  bool count_in_bins();
  double least_cost(const Bin& bin) const;
  void distribute();
  void sweep(const Vec3& normal);
  void sweep_bin(const Vec3& normal, std::size_t number);
  void consider_own_planes(const Vec3& normal, const Bin& bin);
  double next_end_point(std::size_t number) const;
  void consider(const Vec3& normal, double offset, std::int32_t sampled, double below, double above,
                double crossing);
  Vec3 point(std::size_t k) const { return {x_[k], y_[k], z_[k]}; }
  Vec3 center_of(std::size_t sampled) const;
  std::size_t bin_of(double along) const {
    return static_cast<std::size_t>((along - lowest_) * bins_per_length_ + 0.37);
  }

  const std::vector<BspTree::Plane>& planes_;
  double thickness_;
  const PolygonSet* set_ = nullptr;
  bool one_sided_ = true;
  std::vector<std::int32_t> sample_;  ///< numbers of polygons in the set
  std::vector<std::uint32_t> begin_;  ///< per polygon of the sample, and the end: first point
  std::vector<double> x_, y_, z_;     ///< its points
  std::vector<double> along_;         ///< … along the normal
  std::vector<Vec3> normals_;
  std::vector<Interval> intervals_;
  double lowest_ = 0, bins_per_length_ = 0;
  std::vector<Bin> bins_;
  std::vector<std::uint32_t> open_bins_;
  std::vector<std::uint32_t> starts_;  ///< polygons of the sample, by the bin of their low end
  std::vector<double> ends_;           ///< high ends, by bin
  double best_cost_ = 0;
  Choice best_{};
};

}  // namespace transillum
