// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// Index into BspTree::fragments().
using FragmentId = std::int32_t;
/// Index into BspTree::lines().
using LineId = std::int32_t;

/// Binary space partition of all pieces of a scene (paper, section 3.2: the sorting step).
///
/// Any order() lists the fragments such that, looking along the direction, none hides a part of
/// an earlier one from the side the direction comes from, whatever overlaps, interpenetrates or
/// forms cycles: what would is cut.
///
/// Threads: immutable once built.
class BspTree {
 public:
  /// A corner of a fragment, and the line that carries the edge to the next corner.
  struct Corner {
    PointId point;
    LineId line;
    bool forward;  ///< the edge runs along its line from a to b
  };
  /// The line of an input edge or of a cut, through two points, a < b; shared by all edges on it
  /// that come from the same input edge. Clipping against a line recomputed from the end points
  /// of a vanishing edge would be noise: that of an input edge never vanishes. That of a cut may be
  /// as short as the tip it cuts off.
  struct Line {
    PointId a, b;
  };
  /// A point made by a cut: a + t (b - a), where a and b are smaller point numbers.
  struct CutPoint {
    PointId a, b;
    double t;
  };
  /// A convex part of a patch; corners counter-clockwise seen from the lit side.
  struct Fragment {
    PatchId patch;
    std::uint32_t begin, end;  ///< in the tree's corners
  };
  /// Oriented plane normal·p = offset.
  struct Plane {
    Vec3 normal;
    double offset;
  };
  static constexpr std::int32_t no_node = -1;
  struct Node {
    Plane plane;
    std::int32_t front = no_node, back = no_node;  ///< toward and against plane.normal
    /// Fragments that lie in the plane: lit on the side of plane.normal from begin to middle, on
    /// the other from middle to end; in either part those that cover others come first.
    FragmentId begin = 0, middle = 0, end = 0;
  };

  /// Points nearer to a plane than this count as on it, meters: a little more than what the
  /// coordinates' own rounding can do, so that beyond it the side is certain
  /// (decisions/0001-sides-of-planes.md).
  static double thickness(const Scene& scene);

  /// Builds the tree. `progress`, if given, hears the share done, in [0,1], now and then.
  /// @throws Canceled
  explicit BspTree(const Scene& scene, const Cancellation& cancellation = {},
                   const std::function<void(double)>& progress = {});

  const std::vector<Fragment>& fragments() const { return fragments_; }
  const Fragment& fragment(FragmentId f) const { return at(fragments_, f); }
  std::span<const Corner> corners(const Fragment& f) const {
    return {corners_.data() + f.begin, f.end - f.begin};
  }
  const std::vector<Line>& lines() const { return lines_; }
  /// The scene's points, then those made by cuts.
  const std::vector<Vec3>& points() const { return points_; }
  /// Point scene.points().size() + k is cut_points()[k].
  const std::vector<CutPoint>& cut_points() const { return cut_points_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  std::int32_t root() const { return nodes_.empty() ? no_node : 0; }
  /// Length of the longest way from the root, in nodes.
  int depth() const { return depth_; }

  /// All fragments, those farthest toward `omega` first. Among coincident ones of one plane the
  /// receiving come before the emitting, and of those that face the same way the one with the
  /// larger exitance (then the smaller area, then the later number) covers the other.
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

}  // namespace transillum
