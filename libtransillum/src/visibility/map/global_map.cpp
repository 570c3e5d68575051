// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The global visibility map of section 3.1: the plane cut into regions by the edges of all
// fragments, visible or hidden. Everywhere in a region the same fragments lie one above the other;
// in sorted order, each sees the next. The map is CGAL's arrangement, in exact numbers. Input: the
// fragments of the BSP tree, projected; for_each_tile() keeps each arrangement small.
//
// Between neighboring regions, the stack of fragments changes only by the fragments whose edges are
// crossed. So no stack and no sum is made per region: a depth-first traversal visits all regions
// and keeps one stack up to date; `total_` is the area of the regions entered so far. A pair of
// adjacent fragments is accumulated when it separates, with the growth of `total_` since it became
// adjacent:
//
//      +-----+          traversal: outside, a, b      stack: -    A    A B   A
//      |a +--|--+       A and B become adjacent on entering b and separate on leaving it:
//      +--|b-|  |       total_ has grown by the area of b
//         +-----+
#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Lazy_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <map>
#include <memory>
#include <new>
#include <utility>

#include "base/invariant.h"
#include "transillum/at.h"
#include "visibility/map/map_engines.h"
#include "visibility/map/plane_tiles.h"
#include "visibility/plane/exact_number.h"
#include "visibility/plane/fragment_projector.h"
#include "visibility/transfers/transfer_sums.h"

namespace transillum {
namespace {

// Like CGAL's kernel Epeck, with Rational as the exact numbers behind the intervals.
using Kernel = CGAL::Lazy_kernel<CGAL::Simple_cartesian<Rational>>;
/// Index of an edge in TileEdges. Each part of the map's edges carries the numbers of all edges
/// that overlap there.
using EdgeNumber = std::int32_t;
using MapTraits =
    CGAL::Arr_consolidated_curve_data_traits_2<CGAL::Arr_segment_traits_2<Kernel>, EdgeNumber>;
/// The data of a region: whether it has been visited.
using Map = CGAL::Arrangement_2<MapTraits, CGAL::Arr_face_extended_dcel<MapTraits, bool>>;

/// The distinct edges of a tile's polygons, with the fragments that they bound.
class TileEdges {
 public:
  /// A fragment that an edge bounds.
  struct Border {
    std::int32_t rank;
    bool rightward;  ///< the fragment lies left of the edge in direction of larger x (or y, if
                     ///< vertical)
  };

  explicit TileEdges(const std::vector<TilePolygon>& polygons) {
    for (const TilePolygon& polygon : polygons) {
      add(polygon);
    }
  }

  const std::vector<Border>& borders(EdgeNumber edge) const { return at(borders_, edge); }

  std::vector<MapTraits::Curve_2> curves() const {
    std::vector<MapTraits::Curve_2> curves;
    for (const auto& [ends, edge] : numbers_) {
      const Kernel::Segment_2 segment(ends.first->second, ends.second->second);
      curves.emplace_back(segment, edge);
    }
    return curves;
  }

 private:
  using Points = std::map<std::pair<Rational, Rational>, Kernel::Point_2>;
  using PointPlace = Points::const_iterator;
  struct ByPointAddress {
    bool operator()(const std::pair<PointPlace, PointPlace>& a,
                    const std::pair<PointPlace, PointPlace>& b) const {
      return std::pair(&*a.first, &*a.second) < std::pair(&*b.first, &*b.second);
    }
  };

  void add(const TilePolygon& polygon) {
    std::vector<PointPlace> places;
    for (const BasicPlanePoint<Rational>& p : polygon.outline) {
      const Kernel::Point_2 point{Kernel::FT(p.x), Kernel::FT(p.y)};
      places.emplace_back(points_.try_emplace(std::pair(p.x, p.y), point).first);
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const PointPlace a = places[k], b = places[(k + 1) % places.size()];
      if (a == b) {
        continue;
      }
      const bool rightward = a->first < b->first;
      const auto [number, is_new] = numbers_.try_emplace(
          rightward ? std::pair(a, b) : std::pair(b, a), static_cast<EdgeNumber>(borders_.size()));
      if (is_new) {
        borders_.emplace_back();
      }
      at(borders_, number->second).push_back({polygon.rank, rightward});
    }
  }

  Points points_;
  std::map<std::pair<PointPlace, PointPlace>, EdgeNumber, ByPointAddress> numbers_;
  std::vector<std::vector<Border>> borders_;
};

/// Twice the area to the left of a closed boundary: < 0 for the boundary of a hole.
Rational twice_area(Map::Ccb_halfedge_const_circulator boundary) {
  Rational twice = 0;
  const auto end = boundary;
  do {
    const auto& a = CGAL::exact(boundary->source()->point());
    const auto& b = CGAL::exact(boundary->target()->point());
    twice += a.x() * b.y() - a.y() * b.x();
  } while (++boundary != end);
  return twice;
}

Rational area_of(const Map::Face& region) {
  if (region.is_unbounded()) {
    return 0;
  }
  Rational twice = twice_area(region.outer_ccb());
  for (auto hole = region.holes_begin(); hole != region.holes_end(); ++hole) {
    twice += twice_area(*hole);
  }
  return twice / 2;
}

/// All edges between `region` and its neighbors, including those in its holes.
std::vector<Map::Halfedge_handle> edges_to_neighbors(const Map::Face_handle& region) {
  std::vector<Map::Halfedge_handle> edges;
  const auto add_boundary = [&edges](Map::Ccb_halfedge_circulator boundary) {
    const auto end = boundary;
    do {
      edges.push_back(boundary);
    } while (++boundary != end);
  };
  if (!region->is_unbounded()) {
    add_boundary(region->outer_ccb());
  }
  for (auto hole = region->holes_begin(); hole != region->holes_end(); ++hole) {
    add_boundary(*hole);
  }
  return edges;
}

std::unique_ptr<Map> make_map(const std::vector<MapTraits::Curve_2>& curves) {
  auto map = std::make_unique<Map>();
  try {
    CGAL::insert(*map, curves.begin(), curves.end());
  } catch (const std::bad_alloc&) {
    (void)map.release();  // CGAL cannot destroy a map that is incomplete
    throw;
  }
  return map;
}

/// The global visibility map of one direction.
class GlobalMap {
 public:
  GlobalMap(const Scene& scene, const BspTree& tree, const Vec3& omega,
            const Cancellation& cancellation)
      : tree_(tree),
        cancellation_(cancellation),
        omega_(omega),
        projection_(scene, tree, omega, cancellation),
        sums_(scene.patch_count()) {}

  Transfers run() {
    for_each_tile(project_fragments(), max_boundaries_per_tile, cancellation_,
                  [this](const std::vector<TilePolygon>& tile) { visit_regions(tile); });
    return sums_.finish(omega_, cancellation_);
  }

 private:
  /// CGAL's insertion cannot be interrupted, so each map must be small.
  static constexpr std::size_t max_boundaries_per_tile = 64;

  /// A fragment in BSP order; edge-on ones are omitted.
  struct RankedFragment {
    PatchId patch;
    bool front_facing;
    int winding = 0;  ///< winding number of the outline about the current region: > 0 inside
  };
  /// A fragment that covers the current region.
  struct StackedFragment {
    std::int32_t rank;
    ExactArea adjacent_since;  ///< total_ when the one above it became adjacent
  };

  std::vector<TilePolygon> project_fragments() {
    std::vector<TilePolygon> polygons;
    FragmentProjector<Rational> projector(tree_, projection_);
    for (const FragmentId f : tree_.order(omega_, cancellation_)) {
      cancellation_.throw_if_canceled();
      const BspTree::Fragment& fragment = tree_.fragment(f);
      if (!projector.project(fragment)) {
        continue;
      }
      sums_.project(fragment.patch, projector.front_facing(), ExactArea(projector.area()));
      std::vector<BasicPlanePoint<Rational>> outline;
      for (const auto& corner : projector.outline()) {
        outline.push_back(corner.at);
      }
      polygons.push_back(
          tile_polygon(static_cast<std::int32_t>(ranked_.size()), std::move(outline)));
      ranked_.push_back({fragment.patch, projector.front_facing()});
    }
    return polygons;
  }

  /// Visits all regions of a tile depth-first, from neighbor to neighbor and back.
  void visit_regions(const std::vector<TilePolygon>& tile) {
    const TileEdges edges(tile);
    const std::unique_ptr<Map> owner = make_map(edges.curves());
    Map& map = *owner;
    for (auto region = map.faces_begin(); region != map.faces_end(); ++region) {
      region->set_data(false);
    }

    struct Visit {
      std::vector<Map::Halfedge_handle> edges;  ///< to neighbors not tried yet
      Map::Halfedge_handle back;                ///< to the region it was entered from
    };
    std::vector<Visit> path;
    map.unbounded_face()->set_data(true);
    path.push_back({edges_to_neighbors(map.unbounded_face()), {}});
    while (true) {
      Visit& here = path.back();
      if (here.edges.empty()) {
        const Map::Halfedge_handle back = here.back;
        path.pop_back();
        if (path.empty()) {
          break;
        }
        cross(edges, back);
        continue;
      }
      const Map::Halfedge_handle out = here.edges.back();
      here.edges.pop_back();
      const Map::Face_handle next = out->twin()->face();
      if (next->data()) {
        continue;
      }
      cancellation_.throw_if_canceled();
      next->set_data(true);
      cross(edges, out);
      total_ += ExactArea(area_of(*next));
      path.push_back({edges_to_neighbors(next), out->twin()});
    }
    TRANSILLUM_INVARIANT(stack_.empty(), "no fragment covers the unbounded region");
  }

  /// Crosses `edge` from the region on its left to the one on its right.
  void cross(const TileEdges& edges, const Map::Halfedge_handle& edge) {
    const bool rightward = edge->direction() == CGAL::ARR_LEFT_TO_RIGHT;
    for (const EdgeNumber number : edge->curve().data()) {
      for (const TileEdges::Border& border : edges.borders(number)) {
        int& winding = at(ranked_, border.rank).winding;
        if (border.rightward == rightward) {
          if (winding-- == 1) {
            leave(border.rank);
          }
        } else {
          if (winding++ == 0) {
            enter(border.rank);
          }
        }
      }
    }
  }

  std::vector<StackedFragment>::iterator position_of(std::int32_t rank) {
    return std::lower_bound(
        stack_.begin(), stack_.end(), rank,
        [](const StackedFragment& entry, std::int32_t r) { return entry.rank < r; });
  }

  void enter(std::int32_t rank) {
    const auto below = position_of(rank);
    if (below != stack_.end()) {
      accumulate(below);
      below->adjacent_since = total_;
    }
    stack_.insert(below, {rank, total_});
  }

  void leave(std::int32_t rank) {
    const auto left = position_of(rank);
    TRANSILLUM_INVARIANT(left != stack_.end() && left->rank == rank,
                         "a fragment that is left was entered");
    accumulate(left);
    const auto below = std::next(left);
    if (below != stack_.end()) {
      accumulate(below);
      below->adjacent_since = total_;
    }
    stack_.erase(left);
  }

  /// Accumulates the area visited since the entry above `below` became adjacent to it.
  void accumulate(std::vector<StackedFragment>::iterator below) {
    if (below == stack_.begin() || below->adjacent_since == total_) {
      return;
    }
    const RankedFragment& lower = at(ranked_, below->rank);
    const RankedFragment& upper = at(ranked_, std::prev(below)->rank);
    sums_.accumulate(lower.patch, lower.front_facing, upper.patch, upper.front_facing,
                     total_ - below->adjacent_since);
  }

  const BspTree& tree_;
  const Cancellation& cancellation_;
  Vec3 omega_;
  BasicProjection<Rational> projection_;
  TransferSums<ExactArea> sums_;
  std::vector<RankedFragment> ranked_;
  std::vector<StackedFragment> stack_;  ///< over the current region, nearest to the light first
  ExactArea total_;                     ///< area of the regions entered so far
};

}  // namespace

TransferEngine global_map_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree) {
  let_exact_numbers_throw();
  return [scene = std::move(scene), tree = std::move(tree)](const Vec3& omega,
                                                            const Cancellation& cancellation) {
    return GlobalMap(*scene, *tree, omega, cancellation).run();
  };
}

}  // namespace transillum
