// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "geometry/convex_partition.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <map>
#include <utility>

#include "invariant.h"

namespace transillum {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

constexpr int unreached = -1;

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

Point to_point(const PlanePoint& p) { return {p[0], p[1]}; }

std::vector<Point> to_points(std::span<const PlanePoint> outline) {
  std::vector<Point> points;
  points.reserve(outline.size());
  for (const PlanePoint& p : outline) points.push_back(to_point(p));
  return points;
}

/// How often the outline runs along an edge of the triangulation: bridges are walked twice, and
/// then there is no border between the inside and the outside.
class EdgeWalks {
 public:
  void walk(const Triangulation& triangulation, Triangulation::Vertex_handle from,
            Triangulation::Vertex_handle to) {
    // A constraint may pass through other corners: follow it from corner to corner.
    while (from != to) {
      const auto next = next_along(triangulation, from, to);
      ++count_[key(from, next)];
      from = next;
    }
  }
  bool is_border(Triangulation::Vertex_handle a, Triangulation::Vertex_handle b) const {
    const auto found = count_.find(key(a, b));
    return found != count_.end() && found->second % 2 == 1;
  }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  static Key key(Triangulation::Vertex_handle a, Triangulation::Vertex_handle b) {
    return std::minmax(a->info(), b->info());
  }
  static Triangulation::Vertex_handle next_along(const Triangulation& triangulation,
                                                 Triangulation::Vertex_handle from,
                                                 Triangulation::Vertex_handle to) {
    Triangulation::Vertex_handle next;
    Triangulation::Face_handle face;
    int index = 0;
    const bool found = triangulation.includes_edge(from, to, next, face, index);
    TRANSILLUM_INVARIANT(found, "an inserted constraint is an edge path");
    return found ? next : to;
  }
  std::map<Key, int> count_;
};

/// Gives each face the number of borders between it and the outside.
void count_borders(Triangulation& triangulation, const EdgeWalks& walks) {
  for (auto face : triangulation.all_face_handles()) face->info() = unreached;
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Triangulation::Face_handle next = face->neighbor(i);
      if (next->info() != unreached) continue;
      const auto a = face->vertex(Triangulation::cw(i));
      const auto b = face->vertex(Triangulation::ccw(i));
      const bool at_infinity = triangulation.is_infinite(a) || triangulation.is_infinite(b);
      next->info() = face->info() + (!at_infinity && walks.is_border(a, b) ? 1 : 0);
      open.push_back(next);
    }
  }
}

}  // namespace

int exact_turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c)));
}

bool is_convex(std::span<const PlanePoint> outline) {
  const std::size_t n = outline.size();
  if (n < 3) return false;
  bool any_turn = false;
  int reversals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint& a = outline[i];
    const PlanePoint& b = outline[(i + 1) % n];
    const PlanePoint& c = outline[(i + 2) % n];
    const int turn = exact_turn(a, b, c);
    if (turn < 0) return false;
    any_turn |= turn > 0;
    // Seen along one axis a convex outline goes forth once and back once; a star, more often.
    const bool reversal = (a < b) != (b < c);
    if (reversal && turn == 0) return false;
    reversals += reversal ? 1 : 0;
  }
  return any_turn && reversals == 2;
}

bool is_simple(std::span<const PlanePoint> outline) {
  const std::vector<Point> points = to_points(outline);
  return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

std::vector<CornerList> convex_partition(std::span<const PlanePoint> outline) {
  const std::vector<Point> points = to_points(outline);
  using Map = CGAL::Pointer_property_map<Point>::const_type;
  using Traits = CGAL::Partition_traits_2<Kernel, Map>;
  std::vector<std::uint32_t> numbers(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) numbers[i] = static_cast<std::uint32_t>(i);
  const Traits traits{Map(points.data())};
  std::vector<Traits::Polygon_2> polygons;
  CGAL::approx_convex_partition_2(numbers.begin(), numbers.end(), std::back_inserter(polygons),
                                  traits);
  std::vector<CornerList> pieces;
  pieces.reserve(polygons.size());
  for (const Traits::Polygon_2& polygon : polygons) {
    CornerList& piece = pieces.emplace_back();
    for (const auto corner : polygon.container()) {
      piece.push_back(static_cast<std::uint32_t>(corner));
    }
  }
  return pieces;
}

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const PlanePoint> outline) {
  Triangulation triangulation;
  EdgeWalks walks;
  std::vector<Triangulation::Vertex_handle> corners;
  Triangulation::Face_handle hint;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto before = triangulation.number_of_vertices();
    const auto corner = triangulation.insert(to_point(outline[i]), hint);
    if (triangulation.number_of_vertices() > before) {
      corner->info() = static_cast<std::uint32_t>(i);
    }
    corners.push_back(corner);
    hint = corner->face();
  }
  const std::size_t n = corners.size();
  try {
    for (std::size_t i = 0; i < n; ++i) {
      if (corners[i] != corners[(i + 1) % n]) {
        triangulation.insert_constraint(corners[i], corners[(i + 1) % n]);
      }
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return {};
  }
  if (triangulation.dimension() < 2) return {};
  for (std::size_t i = 0; i < n; ++i) {
    walks.walk(triangulation, corners[i], corners[(i + 1) % n]);
  }
  count_borders(triangulation, walks);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles()) {
    if (face->info() % 2 == 1) {
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
  }
  // The triangulation's own order hangs on how it allocates; ours shall not.
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace transillum
