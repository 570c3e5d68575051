// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/plane_search.h"

namespace transillum {

/// Builds a BspTree top down, without recursion: choose a plane, split what crosses it, go on
/// with both sides.
class BspBuilder {
 public:
  BspBuilder(const Scene& scene, BspTree& tree, const Cancellation& cancellation,
             const std::function<void(double)>& progress);
  void build();

 private:
  /// A convex polygon on its way down the tree.
  struct Polygon {
    PatchId patch;
    std::int32_t piece;
    std::uint32_t begin, end;  ///< in corners_
  };
  using PolygonList = std::vector<std::int32_t>;
  struct Task {
    PolygonList polygons;
    std::int32_t parent;
    bool front;
    int depth;
  };
  enum class Side { coplanar, front, back, both };

  void add_pieces();
  void look_for_cancellation();
  LineId line_between(PointId a, PointId b);
  void split_node(Task task, std::vector<Task>& open);
  Side classify(const Polygon& polygon, const BspTree::Plane& plane);
  PointId cut_edge(PointId a, PointId b, double distance_a, double distance_b);
  void cut(std::int32_t polygon, PolygonList& front, PolygonList& back);
  void keep_coplanar(PolygonList coplanar, BspTree::Node& node);

  const Scene& scene_;
  BspTree& tree_;
  Cancellation cancellation_;
  const std::function<void(double)>& progress_;
  double thickness_;
  std::uint32_t polygons_since_look_ = 0;
  std::vector<Polygon> polygons_;
  std::vector<BspTree::Corner> corners_;
  std::vector<BspTree::Plane> piece_planes_;
  std::unordered_map<std::uint64_t, LineId> line_of_edge_;
  std::unordered_map<std::uint64_t, PointId> cut_of_edge_;  ///< by the plane at hand
  std::vector<double> distances_;  ///< of the corners of the polygon at hand, 0 where on the plane
  PlaneSearch search_;
};

}  // namespace transillum
