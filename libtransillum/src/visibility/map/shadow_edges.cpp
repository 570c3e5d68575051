// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lit polygons of one patch meet along the lines by which the map engine cut them, with opposite
// directions: where these cancel, there is light on both sides. An edge that is divided on one side
// has several lines of the tree, so lines are compared by where they are.
#include "visibility/map/shadow_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Lengths below this are rounding, relative to the extent of the map.
constexpr double rounding = 1e-9;
/// Largest difference of Axis::key() of edges on one line.
constexpr double similar = 1e-6;

double distance(const Vec2& p, const Vec2& q) { return std::hypot(q.x - p.x, q.y - p.y); }

/// A line of the plane.
struct Axis {
  Vec2 origin;
  Vec2 along;         ///< unit
  double length = 0;  ///< between the points that it is known by, m

  double place(const Vec2& p) const {
    return (p.x - origin.x) * along.x + (p.y - origin.y) * along.y;
  }
  double aside(const Vec2& p) const {
    return (p.y - origin.y) * along.x - (p.x - origin.x) * along.y;
  }
  Vec2 at(double place) const { return {origin.x + place * along.x, origin.y + place * along.y}; }
  /// Nearly the same for lines of nearly the same angle, in either direction.
  double key() const { return (along.x * along.x - along.y * along.y) + 1.4 * along.x * along.y; }
};

/// An edge of a lit polygon.
struct Edge {
  PatchId patch;
  Axis axis;
  Vec2 p, q;
  double key;
};

/// A place on a line where polygons on its left (+1) or right (-1) begin or, with the opposite
/// sign, end.
struct Change {
  double place;  ///< m
  int polygons;
};

class ShadowSearch {
 public:
  ShadowSearch(const Scene& scene, const BspTree& tree, const MapRecord& record)
      : scene_(scene), tree_(tree), record_(record) {
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    for (const Vec2& p : record.corners) {
      x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
    }
    shortest_ = rounding * std::max(x1 - x0, y1 - y0);
  }

  /// Adds the edges of a lit polygon of patch i.
  void add_edges(PatchId i, const MapRecord::Row& row) {
    const auto outline = record_.outline(row);
    const auto lines = record_.edge_lines(row);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 &p = outline[k], &q = outline[(k + 1) % outline.size()];
      if (distance(p, q) > shortest_ && !is_on_outline(i, p, q)) {
        const Axis axis = axis_of(lines[k], p, q);
        lit_.push_back({i, axis, p, q, axis.key()});
      }
    }
  }

  std::vector<ShadowEdge> find() {
    std::stable_sort(lit_.begin(), lit_.end(),
                     [](const Edge& x, const Edge& y) { return x.patch < y.patch; });
    for (std::size_t begin = 0; begin < lit_.size();) {
      std::size_t end = begin + 1;
      while (end < lit_.size() && lit_[end].patch == lit_[begin].patch) {
        ++end;
      }
      add_of_patch({lit_.begin() + static_cast<std::ptrdiff_t>(begin),
                    lit_.begin() + static_cast<std::ptrdiff_t>(end)});
      begin = end;
    }
    return std::move(edges_);
  }

 private:
  /// The line of an edge by its two points in the tree, if they are farther apart than its ends.
  Axis axis_of(LineId l, const Vec2& p, const Vec2& q) const {
    const BspTree::Line& line = at(tree_.lines(), l);
    Vec2 a = record_.frame.project(at(tree_.points(), line.a)),
         b = record_.frame.project(at(tree_.points(), line.b));
    if (distance(a, b) < distance(p, q)) {
      a = p;
      b = q;
    }
    const double length = distance(a, b);
    return {a, {(b.x - a.x) / length, (b.y - a.y) / length}, length};
  }

  bool is_near(const Vec2& p, const Vec2& a, const Vec2& b) const {
    const double length = distance(a, b);
    const double area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return length <= shortest_ || std::abs(area) <= shortest_ * length;
  }

  bool is_on_outline(PatchId i, const Vec2& p, const Vec2& q) const {
    const auto outline = scene_.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 a = record_.frame.project(scene_.point(outline[k])),
                 b = record_.frame.project(scene_.point(outline[(k + 1) % outline.size()]));
      if (is_near(p, a, b) && is_near(q, a, b)) {
        return true;
      }
    }
    return false;
  }

  /// Takes the edges of a patch line by line, beginning with the best known lines.
  void add_of_patch(std::vector<Edge> edges) {
    std::sort(edges.begin(), edges.end(),
              [](const Edge& x, const Edge& y) { return x.key < y.key; });
    std::vector<std::size_t> by_length(edges.size());
    std::iota(by_length.begin(), by_length.end(), std::size_t{0});
    std::stable_sort(by_length.begin(), by_length.end(), [&](std::size_t x, std::size_t y) {
      return edges[x].axis.length > edges[y].axis.length;
    });
    std::vector<bool> done(edges.size(), false);
    for (const std::size_t first : by_length) {
      if (done[first]) {
        continue;
      }
      const Axis& axis = edges[first].axis;
      std::vector<Change> changes;
      const auto begin =
          std::lower_bound(edges.begin(), edges.end(), edges[first].key - similar,
                           [](const Edge& edge, double key) { return edge.key < key; });
      for (auto edge = begin; edge != edges.end() && edge->key <= edges[first].key + similar;
           ++edge) {
        const auto k = static_cast<std::size_t>(edge - edges.begin());
        if (k == first || (!done[k] && std::abs(axis.aside(edge->p)) <= shortest_ &&
                           std::abs(axis.aside(edge->q)) <= shortest_)) {
          done[k] = true;
          changes.push_back({axis.place(edge->p), 1});
          changes.push_back({axis.place(edge->q), -1});
        }
      }
      std::sort(changes.begin(), changes.end(),
                [](const Change& x, const Change& y) { return x.place < y.place; });
      add_uncanceled(edges[first].patch, axis, changes);
    }
  }

  /// Adds the parts of a line on which the changes do not cancel.
  void add_uncanceled(PatchId i, const Axis& axis, const std::vector<Change>& changes) {
    int polygons = 0;
    double from = 0, to = 0;
    bool open = false;
    const auto close = [&] {
      const auto a = record_.frame.point_on(scene_.patch(i), axis.at(from)),
                 b = record_.frame.point_on(scene_.patch(i), axis.at(to));
      if (open && to - from > shortest_ && a && b) {
        edges_.push_back({i, *a, *b});
      }
      open = false;
    };
    for (std::size_t k = 0; k + 1 < changes.size(); ++k) {
      polygons += changes[k].polygons;
      const double p = changes[k].place, q = changes[k + 1].place;
      if (polygons == 0 || q - p <= shortest_) {
        continue;
      }
      if (open && p - to > shortest_) {
        close();
      }
      from = open ? from : p;
      to = q;
      open = true;
    }
    close();
  }

  const Scene& scene_;
  const BspTree& tree_;
  const MapRecord& record_;
  double shortest_ = 0;
  std::vector<Edge> lit_;
  std::vector<ShadowEdge> edges_;
};

}  // namespace

std::vector<ShadowEdge> shadow_edges(const Scene& scene, const BspTree& tree,
                                     const MapRecord& record) {
  ShadowSearch search(scene, tree, record);
  for (const std::int32_t r : record.map_after(record.step_count() - 1)) {
    const MapRecord::Row& row = at(record.rows, r);
    if (!row.front_facing) {
      search.add_edges(row.patch, row);
    }
  }
  return search.find();
}

std::vector<ShadowEdge> lamp_shadow_edges(const Scene& scene, const BspTree& tree,
                                          const MapRecord& record, const std::vector<bool>& emits) {
  ShadowSearch search(scene, tree, record);
  for (const MapRecord::Row& row : record.rows) {
    const PatchId receiver = at(record.step_patch, row.made);
    // A part of the inside list of a step: between its receiver and an emitter.
    if (row.made == row.consumed && !row.front_facing && at(emits, row.patch) &&
        dot(scene.patch(receiver).normal, record.frame.omega) > 0) {
      search.add_edges(receiver, row);
    }
  }
  return search.find();
}

}  // namespace transillum
