// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The global visibility map of section 3.1: the plane cut into regions by the edges of all
// fragments, seen or hidden. In a region the same fragments lie one above the other everywhere;
// sorted, each sees the next. The map is CGAL's arrangement, in exact numbers.
//
// From region to region the list changes by the fragments whose edges are crossed, and by nothing
// else. So neither lists nor sums are made for each region: a walk visits all of them, one list is
// kept up to date, `total_` counts the area that the walk has come through, and a pair of
// neighbors is booked when it parts, with what was counted since it met:
//
//      +-----+          walk: outside, a, b      list: -    A    A B   A
//      |a +--|--+       A meets B on the way into b, and they part on leaving it:
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
#include <utility>

#include "base/invariant.h"
#include "transillum/at.h"
#include "visibility/map/map_engines.h"
#include "visibility/map/plane_tiles.h"
#include "visibility/plane/exact_number.h"
#include "visibility/plane/visible_fragment.h"
#include "visibility/transfers/transfer_sums.h"

namespace transillum {
namespace {

// CGAL's Epeck, but with our fractions behind its intervals.
using Kernel = CGAL::Lazy_kernel<CGAL::Simple_cartesian<Rational>>;
/// A number of TileEdges, on each piece of the map's edges; where edges overlap, all of them.
using EdgeNumber = std::int32_t;
using MapTraits =
    CGAL::Arr_consolidated_curve_data_traits_2<CGAL::Arr_segment_traits_2<Kernel>, EdgeNumber>;
/// Regions know whether the walk has been there.
using Map = CGAL::Arrangement_2<MapTraits, CGAL::Arr_face_extended_dcel<MapTraits, bool>>;

/// The distinct edges of a tile's polygons, and whose they are.
class TileEdges {
 public:
  /// A fragment that has an edge for its border.
  struct Border {
    std::int32_t rank;
    bool rightward;  ///< runs toward larger x (or y, where upright), its fragment to the left
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
  using Place = Points::const_iterator;
  struct ByPlace {
    bool operator()(const std::pair<Place, Place>& a, const std::pair<Place, Place>& b) const {
      return std::pair(&*a.first, &*a.second) < std::pair(&*b.first, &*b.second);
    }
  };

  void add(const TilePolygon& polygon) {
    std::vector<Place> places;
    for (const BasicPlanePoint<Rational>& p : polygon.outline) {
      const Kernel::Point_2 point{Kernel::FT(p.x), Kernel::FT(p.y)};
      places.push_back(points_.try_emplace(std::pair(p.x, p.y), point).first);
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Place a = places[k], b = places[(k + 1) % places.size()];
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
  std::map<std::pair<Place, Place>, EdgeNumber, ByPlace> numbers_;
  std::vector<std::vector<Border>> borders_;
};

/// Twice the area to the left of a closed way round a region: < 0 for the rim of a hole.
Rational twice_area(Map::Ccb_halfedge_const_circulator rim) {
  Rational twice = 0;
  const auto end = rim;
  do {
    const auto& a = CGAL::exact(rim->source()->point());
    const auto& b = CGAL::exact(rim->target()->point());
    twice += a.x() * b.y() - a.y() * b.x();
  } while (++rim != end);
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

/// All edges from `region` to its neighbors, those inside its holes included.
std::vector<Map::Halfedge_handle> ways_out(const Map::Face_handle& region) {
  std::vector<Map::Halfedge_handle> ways;
  const auto add_rim = [&ways](Map::Ccb_halfedge_circulator rim) {
    const auto end = rim;
    do {
      ways.push_back(rim);
    } while (++rim != end);
  };
  if (!region->is_unbounded()) {
    add_rim(region->outer_ccb());
  }
  for (auto hole = region->holes_begin(); hole != region->holes_end(); ++hole) {
    add_rim(*hole);
  }
  return ways;
}

/// One direction.
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
    for_each_tile(look_at_fragments(), most_busy_in_a_tile, cancellation_,
                  [this](const std::vector<TilePolygon>& tile) { walk(tile); });
    return sums_.finish(omega_, cancellation_);
  }

 private:
  /// CGAL cannot be interrupted in the making of a map, so each must be small.
  static constexpr std::size_t most_busy_in_a_tile = 64;

  /// A fragment of the BSP order, edge-on ones left out.
  struct Ranked {
    PatchId patch;
    bool front_facing;
    int winding = 0;  ///< how often the outline runs round the walk's region: > 0 inside
  };
  /// A fragment of the walk's region.
  struct Listed {
    std::int32_t rank;
    ExactArea met;  ///< total_ when it met the one above it
  };

  std::vector<TilePolygon> look_at_fragments() {
    std::vector<TilePolygon> polygons;
    SeenFragment<Rational> seen(tree_, projection_);
    for (const FragmentId f : tree_.order(omega_, cancellation_)) {
      cancellation_.throw_if_canceled();
      const BspTree::Fragment& fragment = tree_.fragment(f);
      if (!seen.look_at(fragment)) {
        continue;
      }
      sums_.project(fragment.patch, seen.front_facing(), ExactArea(seen.area()));
      std::vector<BasicPlanePoint<Rational>> outline;
      for (const auto& corner : seen.outline()) {
        outline.push_back(corner.at);
      }
      polygons.push_back(
          tile_polygon(static_cast<std::int32_t>(ranked_.size()), std::move(outline)));
      ranked_.push_back({fragment.patch, seen.front_facing()});
    }
    return polygons;
  }

  /// Visits all regions of a tile, from neighbor to neighbor and back again.
  void walk(const std::vector<TilePolygon>& tile) {
    const TileEdges edges(tile);
    const auto curves = edges.curves();
    Map map;
    CGAL::insert(map, curves.begin(), curves.end());
    for (auto region = map.faces_begin(); region != map.faces_end(); ++region) {
      region->set_data(false);
    }

    struct Visit {
      std::vector<Map::Halfedge_handle> ways;
      Map::Halfedge_handle back;  ///< to where the walk came from
    };
    std::vector<Visit> way;
    map.unbounded_face()->set_data(true);
    way.push_back({ways_out(map.unbounded_face()), {}});
    while (true) {
      Visit& here = way.back();
      if (here.ways.empty()) {
        const Map::Halfedge_handle back = here.back;
        way.pop_back();
        if (way.empty()) {
          break;
        }
        cross(edges, back);
        continue;
      }
      const Map::Halfedge_handle out = here.ways.back();
      here.ways.pop_back();
      const Map::Face_handle next = out->twin()->face();
      if (next->data()) {
        continue;
      }
      cancellation_.throw_if_canceled();
      next->set_data(true);
      cross(edges, out);
      total_ += ExactArea(area_of(*next));
      way.push_back({ways_out(next), out->twin()});
    }
    TRANSILLUM_INVARIANT(list_.empty(), "outside of everything lies nothing");
  }

  /// Steps over `edge`, from the region to its left to that on its right.
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

  std::vector<Listed>::iterator place_of(std::int32_t rank) {
    return std::lower_bound(list_.begin(), list_.end(), rank,
                            [](const Listed& listed, std::int32_t r) { return listed.rank < r; });
  }

  void enter(std::int32_t rank) {
    const auto below = place_of(rank);
    if (below != list_.end()) {
      accumulate(below);
      below->met = total_;
    }
    list_.insert(below, {rank, total_});
  }

  void leave(std::int32_t rank) {
    const auto at = place_of(rank);
    TRANSILLUM_INVARIANT(at != list_.end() && at->rank == rank, "what is left was entered");
    accumulate(at);
    const auto below = std::next(at);
    if (below != list_.end()) {
      accumulate(below);
      below->met = total_;
    }
    list_.erase(at);
  }

  /// Books what the walk came through since `below` met the one above it, which it now parts from.
  void accumulate(std::vector<Listed>::iterator below) {
    if (below == list_.begin() || below->met == total_) {
      return;
    }
    const Ranked& lower = at(ranked_, below->rank);
    const Ranked& upper = at(ranked_, std::prev(below)->rank);
    sums_.accumulate(lower.patch, lower.front_facing, upper.patch, upper.front_facing,
                     total_ - below->met);
  }

  const BspTree& tree_;
  const Cancellation& cancellation_;
  Vec3 omega_;
  BasicProjection<Rational> projection_;
  TransferSums<ExactArea> sums_;
  std::vector<Ranked> ranked_;
  std::vector<Listed> list_;  ///< of the walk's region, nearest to the light first
  ExactArea total_;           ///< area of the regions visited so far
};

}  // namespace

TransferEngine global_map_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree) {
  return [scene = std::move(scene), tree = std::move(tree)](const Vec3& omega,
                                                            const Cancellation& cancellation) {
    return GlobalMap(*scene, *tree, omega, cancellation).run();
  };
}

}  // namespace transillum
