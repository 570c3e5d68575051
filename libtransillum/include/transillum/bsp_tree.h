// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sorting step: one BSP tree per scene, built once; order() then lists the fragments for any
// direction in linear time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// Index into BspTree::fragments().
using FragmentId = std::int32_t;
/// Index into BspTree::lines().
using LineId = std::int32_t;

/// Binary space partition of all pieces of a scene (paper, section 3.2: the sorting step).
///
/// For every direction omega, order() lists the fragments such that no fragment hides part of an
/// earlier one from the side that omega points to. Pieces that interpenetrate or overlap cyclically
/// are cut into fragments for that.
///
/// Threads: immutable once built.
class BspTree {
 public:
  /// A corner of a fragment, and the line that carries the edge to the next corner.
  struct Corner {
    PointId point;  ///< index into points()
    LineId line;    ///< index into lines()
    bool forward;   ///< the edge runs along its line from a to b
  };
  /// The line of an input edge or of a cut, through two points, a < b; shared by all edges on it
  /// that come from the same input edge. Clipping uses this line because one recomputed from the
  /// end points of a very short edge would be dominated by rounding. The two points of an input
  /// edge's line are never too close; the two points of a cut may be as close as the tip it cuts
  /// off.
  struct Line {
    PointId a;  ///< the smaller point number
    PointId b;  ///< the larger point number
  };
  /// A point made by a cut: a + t (b - a).
  struct CutPoint {
    PointId a;  ///< a point number smaller than the cut point's
    PointId b;  ///< likewise
    double t;   ///< 0 < t < 1
  };
  /// A convex part of a piece; corners counter-clockwise seen from the front side.
  struct Fragment {
    PatchId patch;        ///< the patch it is a part of
    std::uint32_t begin;  ///< first index in the tree's corners
    std::uint32_t end;    ///< one past the last index
  };
  /// Oriented plane normal·p = offset.
  struct Plane {
    Vec3 normal;    ///< unit
    double offset;  ///< m
  };
  /// No node.
  static constexpr std::int32_t no_node = -1;
  /// A node of the tree: a plane, its subtrees, and the fragments in the plane, which are
  /// fragments() begin … end-1: first (to middle-1) the fragments with the normal plane.normal,
  /// then the fragments with the opposite one; in both, a fragment precedes the fragments that it
  /// covers.
  struct Node {
    Plane plane;                   ///< splits the node's part of space
    std::int32_t front = no_node;  ///< subtree on the side that plane.normal points to
    std::int32_t back = no_node;   ///< subtree on the other side
    FragmentId begin = 0;          ///< first fragment in the plane
    FragmentId middle = 0;         ///< first of them with the opposite normal
    FragmentId end = 0;            ///< one past the last
  };

  /// Points nearer to a plane than this are treated as on it, m: slightly more than the rounding
  /// error of the coordinates, so that the side of every point farther away is certain
  /// (decisions/0001-sides-of-planes.md).
  static double thickness(const Scene& scene);

  /// Builds the tree.
  /// @param scene need not outlive the constructor.
  /// @param cancellation checked during construction.
  /// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
  /// @param threads at most; 0: the number of cores. The tree does not depend on it.
  /// @throws Canceled
  explicit BspTree(const Scene& scene, const Cancellation& cancellation = {},
                   const std::function<void(double)>& progress = {}, int threads = 0);

  /// All fragments, grouped by node.
  const std::vector<Fragment>& fragments() const { return fragments_; }
  /// Fragment f.
  const Fragment& fragment(FragmentId f) const { return at(fragments_, f); }
  /// Corners of a fragment, in order.
  std::span<const Corner> corners(const Fragment& f) const {
    return {corners_.data() + f.begin, f.end - f.begin};
  }
  /// The lines of all edges.
  const std::vector<Line>& lines() const { return lines_; }
  /// The scene's points, then those made by cuts, m.
  const std::vector<Vec3>& points() const { return points_; }
  /// How the points made by cuts were computed: point scene.points().size() + k is cut_points()[k].
  const std::vector<CutPoint>& cut_points() const { return cut_points_; }
  /// All nodes; node 0 is the root.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// 0, or no_node for a scene without pieces.
  std::int32_t root() const { return nodes_.empty() ? no_node : 0; }
  /// Length of the longest path from the root, in nodes.
  int depth() const { return depth_; }

  /// All fragments, those farthest along `omega` first. Among coincident fragments of one plane
  /// those that receive precede those that emit; of those with the same normal, the one with the
  /// larger exitance (then the smaller area, then the larger number) covers the others. O(nodes).
  /// @param omega any vector but 0.
  /// @param cancellation checked during the traversal.
  /// @throws Canceled
  std::vector<FragmentId> order(const Vec3& omega, const Cancellation& cancellation = {}) const;

 private:
  friend class BspBuilder;
  std::vector<Fragment> fragments_;
  std::vector<Corner> corners_;
  std::vector<Line> lines_;
  std::vector<Vec3> points_;
  std::vector<CutPoint> cut_points_;
  std::vector<Node> nodes_;
  int depth_ = 0;
};

}  // namespace TRANSILLUM_API transillum
