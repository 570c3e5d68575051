// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Convex partition of a face's outline, projected to its plane: a constrained Delaunay
// triangulation (CGAL) of the corners, then diagonals are removed while the merged polygons stay
// convex. All predicates are exact.
#include "geometry/convex_partition.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/invariant.h"

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
  for (const PlanePoint& p : outline) {
    points.push_back(to_point(p));
  }
  return points;
}

/// Counts how often the outline runs along each edge of the triangulation. An edge with an even
/// count, as of a bridge to a hole, does not separate inside from outside.
class EdgeWalks {
 public:
  void walk(const Triangulation& triangulation, Triangulation::Vertex_handle from,
            Triangulation::Vertex_handle to) {
    // A constraint may pass through other corners: split it there.
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

/// Sets each triangle's info() to the number of borders between it and the outside.
void count_borders(Triangulation& triangulation, const EdgeWalks& walks) {
  for (auto face : triangulation.all_face_handles()) {
    face->info() = unreached;
  }
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Triangulation::Face_handle next = face->neighbor(i);
      if (next->info() != unreached) {
        continue;
      }
      const auto a = face->vertex(Triangulation::cw(i));
      const auto b = face->vertex(Triangulation::ccw(i));
      const bool at_infinity = triangulation.is_infinite(a) || triangulation.is_infinite(b);
      next->info() = face->info() + (!at_infinity && walks.is_border(a, b) ? 1 : 0);
      open.push_back(next);
    }
  }
}

/// Inserts the corners and returns their vertices. Coincident corners share a vertex, whose info()
/// is the number of the first. They are inserted together, which CGAL does along a space-filling
/// curve; one by one would take quadratic time for zigzag outlines.
std::vector<Triangulation::Vertex_handle> insert_corners(Triangulation& triangulation,
                                                         std::span<const PlanePoint> outline) {
  const auto n = static_cast<std::uint32_t>(outline.size());
  CornerList sorted(n);
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    return outline[a] != outline[b] ? outline[a] < outline[b] : a < b;
  });
  std::vector<std::uint32_t> first_there(n);
  std::vector<std::pair<Point, std::uint32_t>> distinct;
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool repeated = i > 0 && outline[sorted[i]] == outline[sorted[i - 1]];
    first_there[sorted[i]] = repeated ? first_there[sorted[i - 1]] : sorted[i];
    if (!repeated) {
      distinct.emplace_back(to_point(outline[sorted[i]]), sorted[i]);
    }
  }
  triangulation.insert(distinct.begin(), distinct.end());
  std::vector<Triangulation::Vertex_handle> corners(n);
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    corners[vertex->info()] = vertex;
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    corners[i] = corners[first_there[i]];
  }
  return corners;
}

/// Hertel and Mehlhorn's partition: removes every diagonal of a triangulation whose two polygons
/// merge to a convex one.
class TriangleMerge {
 public:
  TriangleMerge(std::span<const PlanePoint> outline,
                const std::vector<std::array<std::uint32_t, 3>>& triangles)
      : outline_(outline) {
    for (const auto& t : triangles) {
      const auto first = static_cast<std::uint32_t>(edges_.size());
      for (std::uint32_t i = 0; i < 3; ++i) {
        edges_.push_back({t[i], first + (i + 1) % 3, first + (i + 2) % 3});
      }
    }
  }

  std::vector<CornerList> merged() {
    const std::vector<Twins> diagonals = twins();
    // First pass: only diagonals whose removal leaves strictly convex corners. One that leaves a
    // straight corner may be better kept, such as the diagonal through the notch of an L.
    for (const int least_turn : {1, 0}) {
      for (const auto& [a, b] : diagonals) {
        if (edges_[a].removed) {
          continue;
        }
        if (stays_convex(a, b, least_turn) && stays_convex(b, a, least_turn)) {
          remove(a, b);
        }
      }
    }
    std::vector<CornerList> polygons;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (!edges_[e].removed) {
        polygons.push_back(take_polygon(e));
      }
    }
    return polygons;
  }

 private:
  struct Edge {
    std::uint32_t from;
    std::uint32_t next, previous;  // around its polygon
    bool removed = false;
  };
  using Twins = std::pair<std::uint32_t, std::uint32_t>;

  std::uint32_t to(const Edge& e) const { return edges_[e.next].from; }

  /// The two directed edges of every diagonal, sorted by the corners' numbers.
  std::vector<Twins> twins() const {
    std::vector<std::array<std::uint32_t, 3>> keyed;  // lower corner, higher corner, edge
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const std::uint32_t a = edges_[e].from, b = to(edges_[e]);
      keyed.push_back({std::min(a, b), std::max(a, b), e});
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<Twins> pairs;
    for (std::size_t i = 1; i < keyed.size(); ++i) {
      const auto& a = keyed[i - 1];
      const auto& b = keyed[i];
      if (a[0] == b[0] && a[1] == b[1]) {
        pairs.emplace_back(a[2], b[2]);
      }
    }
    return pairs;
  }

  /// Whether the corner where `edge` starts is convex after removal of `edge` and `twin`.
  bool stays_convex(std::uint32_t edge, std::uint32_t twin, int least_turn) const {
    const PlanePoint& before = outline_[edges_[edges_[edge].previous].from];
    const PlanePoint& corner = outline_[edges_[edge].from];
    const PlanePoint& after = outline_[to(edges_[edges_[twin].next])];
    const int turn = exact_turn(before, corner, after);
    // A corner of 180° is convex, one of 0° or 360° is not.
    return turn >= least_turn && (turn != 0 || (before < corner) == (corner < after));
  }

  void remove(std::uint32_t a, std::uint32_t b) {
    for (const auto& [removed, other] : {Twins{a, b}, Twins{b, a}}) {
      const std::uint32_t before = edges_[removed].previous, after = edges_[other].next;
      edges_[before].next = after;
      edges_[after].previous = before;
      edges_[removed].removed = true;
    }
  }

  CornerList take_polygon(std::uint32_t first) {
    CornerList corners;
    std::uint32_t e = first;
    do {
      corners.push_back(edges_[e].from);
      edges_[e].removed = true;
      e = edges_[e].next;
    } while (e != first);
    return corners;
  }

  std::span<const PlanePoint> outline_;
  std::vector<Edge> edges_;
};

}  // namespace

int exact_turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c)));
}

bool is_convex(std::span<const PlanePoint> outline) {
  const std::size_t n = outline.size();
  if (n < 3) {
    return false;
  }
  bool any_turn = false;
  int reversals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint& a = outline[i];
    const PlanePoint& b = outline[(i + 1) % n];
    const PlanePoint& c = outline[(i + 2) % n];
    const int turn = exact_turn(a, b, c);
    if (turn < 0) {
      return false;
    }
    any_turn |= turn > 0;
    // In lexicographic order a convex outline ascends once and descends once; a star polygon does
    // so more often.
    const bool reversal = (a < b) != (b < c);
    if (reversal && turn == 0) {
      return false;
    }
    reversals += reversal ? 1 : 0;
  }
  return any_turn && reversals == 2;
}

bool is_simple(std::span<const PlanePoint> outline) {
  const std::vector<Point> points = to_points(outline);
  return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

std::vector<CornerList> convex_partition(std::span<const PlanePoint> outline) {
  return TriangleMerge(outline, triangulate(outline)).merged();
}

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const PlanePoint> outline) {
  Triangulation triangulation;
  EdgeWalks walks;
  const std::vector<Triangulation::Vertex_handle> corners = insert_corners(triangulation, outline);
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
  if (triangulation.dimension() < 2) {
    return {};
  }
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
  // The triangulation's order depends on memory allocation; sorting makes it deterministic.
  for (auto& t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace transillum
