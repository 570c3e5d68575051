// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <functional>
#include <thread>
#include <unordered_map>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/clean_planes.h"
#include "visibility/bsp/plane_search.h"
#include "visibility/bsp/polygon_set.h"

namespace transillum {

/// Reports the fraction of the work of building a tree that is done. Any thread may add work; only
/// the thread that constructed this reports, so that shares never decrease.
class BuildProgress {
 public:
  /// The work of sorting `polygons`: n times log2 n.
  static std::int64_t work(std::size_t polygons) {
    return static_cast<std::int64_t>(polygons) * std::bit_width(polygons);
  }

  /// @param report may be empty; not copied.
  BuildProgress(std::size_t polygons, const std::function<void(double)>& report)
      : total_(static_cast<double>(std::max<std::int64_t>(1, work(polygons)))), report_(report) {}

  void add(std::int64_t work) {
    const std::int64_t done = done_.fetch_add(work, std::memory_order_relaxed) + work;
    if (!report_ || std::this_thread::get_id() != thread_) {
      return;
    }
    const double fraction = std::min(1.0, static_cast<double>(done) / total_);
    if (fraction >= reported_ + least_step) {
      reported_ = fraction;
      report_(fraction);
    }
  }

 private:
  static constexpr double least_step = 0.005;
  const double total_;
  const std::function<void(double)>& report_;
  const std::thread::id thread_ = std::this_thread::get_id();
  std::atomic<std::int64_t> done_ = 0;
  double reported_ = 0;
};

/// Input that the builders of all subtrees share.
struct TreeInput {
  const Scene& scene;
  const std::vector<BspTree::Plane>& planes;  ///< by PolygonSet::Polygon::plane
  double thickness;                           ///< m
  Cancellation cancellation;
  BuildProgress& progress;
  /// Numbers of the next point and line. Threads take them in any order, but along every path from
  /// the root they increase, and no decision depends on more than that.
  std::atomic<PointId> next_point;
  std::atomic<LineId> next_line;
};

/// The polygons of a part of space, and where their subtree belongs.
struct SubtreeTask {
  PolygonSet set;
  std::int32_t parent = BspTree::no_node;  ///< a node, by its number in the parent's Subtree
  bool front = true;                       ///< the side of that node
  int depth = 1;                           ///< depth of the subtree's root
  bool peeled = false;                     ///< the one-sided planes have just been used
};

/// Nodes below one node. Nodes, fragments and corners are numbered from 0, parents before their
/// children; points and lines as TreeInput does.
struct Subtree {
  struct NewPoint {
    PointId id;
    BspTree::CutPoint cut;
    Vec3 place;
  };
  struct NewLine {
    LineId id;
    BspTree::Line line;
  };
  std::vector<BspTree::Node> nodes;
  std::vector<BspTree::Fragment> fragments;
  std::vector<BspTree::Corner> corners;
  std::vector<NewPoint> points;
  std::vector<NewLine> lines;
  std::vector<SubtreeTask> open;  ///< subtrees that remain to be built
  int depth = 0;                  ///< depth of the deepest node, from the tree's root
};

/// Builds subtrees top down, without recursion: chooses a plane for a set of polygons, splits those
/// that cross it, and continues with the sets on both sides (paper, section 3.2).
class SubtreeBuilder {
 public:
  /// @param input must outlive the builder.
  explicit SubtreeBuilder(TreeInput& input);

  /// Builds a whole subtree.
  Subtree build(SubtreeTask task);
  /// Builds the root of a subtree, or a chain of nodes, and leaves the rest open.
  Subtree build_root(SubtreeTask task);

 private:
  /// An end of an edge that may be cut.
  struct End {
    PointId point;
    Vec3 place;
    double distance;  ///< from the plane, signed; 0 on it
  };
  void check_cancellation();
  const BspTree::Plane& plane_of(const PolygonSet& set, std::int32_t polygon) const;
  void split(SubtreeTask task);
  bool use_clean_planes(SubtreeTask& task);
  void use_best_plane(SubtreeTask& task);
  void add_chain(SubtreeTask& task, std::vector<CleanPlanes::Plane> planes);
  void split_by(const SubtreeTask& task, const BspTree::Plane& plane, std::int32_t own);
  std::int32_t add_node(const SubtreeTask& task, const BspTree::Plane& plane,
                        std::vector<std::int32_t> coplanar);
  void add_coplanar(const PolygonSet& set, std::vector<std::int32_t> coplanar, BspTree::Node& node);
  std::size_t cut_edge(const End& from, const End& to);
  void cut(const PolygonSet& set, const PolygonSet::Polygon& whole, const BspTree::Plane& plane,
           PolygonSet& front, PolygonSet& back);

  TreeInput& input_;
  PlaneSearch search_;
  CleanPlanes clean_planes_;
  Subtree built_;
  std::uint32_t polygons_since_check_ = 0;
  /// Points made by the current plane, by edge: index in built_.points.
  std::unordered_map<std::uint64_t, std::size_t> cut_of_edge_;
  std::vector<End> ends_;  ///< corners of the polygon that is cut
};

}  // namespace transillum
