// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/polygon_set.h"

namespace transillum {

/// Finds a plane that orders many polygons with few cuts.
///
/// For each of a few dozen normals (the axes, normals of polygons, normals to two edges, lines
/// between polygons), in large sets the eight that a quarter of the polygons chooses, all offsets
/// are compared: the intervals that the polygons cover along the normal are counted in bins; bins
/// whose counts allow a better plane than the best so far are sorted. Planes in the gaps between
/// groups and planes of polygons are thus compared by the same cost. Large sets are represented by
/// a sample (decisions/0004-choice-of-planes.md).
class PlaneSearch {
 public:
  struct Choice {
    BspTree::Plane plane;
    std::int32_t polygon;  ///< a polygon of the set that lies in the plane by definition, or -1
    bool one_sided;        ///< all others are on one side, as far as the sample tells
  };

  /// @param planes of the polygons, by PolygonSet::Polygon::plane; not copied.
  PlaneSearch(const std::vector<BspTree::Plane>& planes, double thickness);

  /// The best plane for a set that is not empty; each side of it gets fewer polygons than the set
  /// has.
  /// @param one_sided whether a one-sided plane is acceptable; if not, one is returned only where
  /// nothing else is found.
  Choice best(const PolygonSet& set, bool one_sided);

 private:
  struct Bin {
    std::int32_t started, ended;          ///< intervals that started, or ended, in bins before
    std::int32_t first_start, first_end;  ///< while sorting
    std::int32_t starts, ends, inside;    ///< in this bin; inside: both
  };
  void forget_best();
  void choose_normals();
  void collect_sample(std::size_t step);
  void collect_normals();
  void collect_intervals(const Vec3& normal);
  bool count_in_bins();
  void collect_open_bins();
  std::span<std::uint32_t> starts_of(const Bin& bin) {
    return std::span(starts_).subspan(static_cast<std::size_t>(bin.started),
                                      static_cast<std::size_t>(bin.starts));
  }
  std::span<double> ends_of(const Bin& bin) {
    return std::span(ends_).subspan(static_cast<std::size_t>(bin.ended),
                                    static_cast<std::size_t>(bin.ends));
  }
  void distribute();
  void sweep(const Vec3& normal);
  void sweep_bin(const Vec3& normal, std::size_t number);
  void consider_own_planes(const Vec3& normal, const Bin& bin);
  double next_end_point(std::size_t number);
  void consider(const Vec3& normal, double offset, std::int32_t sampled, double below, double above,
                double crossing);
  double bits(double below) const;
  const Vec3& corner_of(std::size_t sampled, std::size_t number) const;
  Vec3 center_of(std::size_t sampled) const;
  std::uint32_t bin_of(double along) const {
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>((along - lowest_) * bins_per_length_ + 0.37));
  }

  const std::vector<BspTree::Plane>& planes_;
  double thickness_;
  const std::vector<double>& products_;
  const PolygonSet* set_ = nullptr;
  bool one_sided_ = true;
  std::vector<std::int32_t> sample_;            ///< numbers of polygons in the set
  std::vector<double> x_, y_, z_;               ///< corners of its polygons
  std::vector<std::uint32_t> polygon_of_rest_;  ///< whose corner follows the first three
  std::vector<Vec3> normals_;
  std::vector<std::pair<double, std::size_t>> ranking_;  ///< cost of the best plane, normal
  std::vector<double> lows_, highs_;  ///< by polygon of the sample: its interval along the normal
  std::vector<std::uint32_t> low_bins_, high_bins_;
  double lowest_ = 0, bins_per_length_ = 0;
  std::vector<Bin> bins_;
  std::vector<std::pair<double, std::uint32_t>> open_bins_;  ///< by least cost
  std::vector<std::uint32_t> starts_;  ///< polygons of the sample, by the bin of their low end
  std::vector<double> ends_;           ///< high ends, by bin
  double best_cost_ = 0;
  Choice best_{};
};

}  // namespace transillum
