// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/subtree_builder.h"

namespace transillum {

/// Builds a BspTree: makes polygons of a scene's pieces, has the subtrees built in parallel, and
/// joins them in an order that does not depend on the threads.
class BspBuilder {
 public:
  BspBuilder(const Scene& scene, BspTree& tree, const Cancellation& cancellation,
             const std::function<void(double)>& progress);
  /// @param threads at most; 0 for the number of cores.
  void build(int threads);

 private:
  /// A piece, or a triangle of one; convex.
  struct Polygon {
    PatchId patch;
    std::int32_t plane;        ///< in planes_
    std::uint32_t begin, end;  ///< in corners_
  };
  /// A subtree, and those that continue it.
  struct OpenSubtree {
    Subtree subtree;
    std::size_t first_child = 0;  ///< in parts_; as many as the subtree left open, in this order
  };

  void add_pieces();
  void add_piece(const Piece& piece, const BspTree::Plane& plane);
  void add_polygon(PatchId patch, std::span<const PointId> points);
  void add_triangle(PatchId patch, const std::array<PointId, 3>& points, BspTree::Plane plane);
  /// Whether no point is farther from the plane than the distance, m.
  bool contains(const BspTree::Plane& plane, std::span<const PointId> points,
                double distance) const;
  BspTree::Plane plane_of(std::span<const PointId> points) const;
  BspTree::Plane plane_of(std::span<const Piece> pieces) const;
  void check_cancellation();
  LineId line_between(PointId a, PointId b);
  PolygonSet take_polygons();
  void build_parts(TreeInput& input, int threads);
  void join_parts(const TreeInput& input);
  void join(Subtree& subtree_part);

  const Scene& scene_;
  BspTree& tree_;
  Cancellation cancellation_;
  const std::function<void(double)>& progress_;
  double thickness_;
  std::uint32_t polygons_since_check_ = 0;
  std::vector<Polygon> polygons_;
  std::vector<BspTree::Corner> corners_;
  std::vector<BspTree::Plane> planes_;
  std::unordered_map<std::uint64_t, LineId> line_of_edge_;
  std::vector<OpenSubtree> open_subtrees_;
  PointId first_new_point_ = 0;
  LineId first_new_line_ = 0;
  /// Numbers in the tree, by the numbers that points and lines got while building, from the first
  /// new one.
  std::vector<PointId> point_numbers_;
  std::vector<LineId> line_numbers_;
};

}  // namespace transillum
