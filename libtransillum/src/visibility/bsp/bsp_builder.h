// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/plane_search.h"

namespace transillum {

/// Builds a BspTree top down, without recursion: chooses a plane for a set of polygons, splits
/// those that cross it, and continues with the sets on both sides (paper, section 3.2).
class BspBuilder {
 public:
  BspBuilder(const Scene& scene, BspTree& tree, const Cancellation& cancellation,
             const std::function<void(double)>& progress);
  void build();

 private:
  /// A piece, or a part of one, not yet in the tree; convex.
  struct Polygon {
    PatchId patch;
    std::int32_t piece;
    std::uint32_t begin, end;  ///< in corners_
  };
  using PolygonList = std::vector<std::int32_t>;
  /// A subtree to be built.
  struct Task {
    PolygonList polygons;
    std::int32_t parent;
    bool front;
    int depth;
  };
  enum class Side { coplanar, front, back, both };

  void add_pieces();
  void check_cancellation();
  LineId line_between(PointId a, PointId b);
  PlaneSearch::Choice choose_plane(const PolygonList& polygons);
  void split_node(Task task, std::vector<Task>& open);
  Side classify(const Polygon& polygon, const BspTree::Plane& plane);
  PointId cut_edge(PointId a, PointId b, double distance_a, double distance_b);
  void cut(std::int32_t polygon, PolygonList& front, PolygonList& back);
  void add_coplanar(PolygonList coplanar, BspTree::Node& node);

  const Scene& scene_;
  BspTree& tree_;
  Cancellation cancellation_;
  const std::function<void(double)>& progress_;
  double thickness_;
  std::uint32_t polygons_since_check_ = 0;
  std::vector<Polygon> polygons_;
  std::vector<BspTree::Corner> corners_;
  std::vector<BspTree::Plane> piece_planes_;
  std::unordered_map<std::uint64_t, LineId> line_of_edge_;
  std::unordered_map<std::uint64_t, PointId> cut_of_edge_;  ///< by the current plane
  /// Signed distances of the corners last classified from the plane, 0 for those on the plane.
  std::vector<double> distances_;
  PlaneSearch search_;
};

}  // namespace transillum
