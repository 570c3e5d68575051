// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lit polygons of one patch meet along the lines by which the map engine cut them, with opposite
// directions: on each line, where these cancel there is light on both sides.
#include "visibility/map/shadow_edges.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Lengths below this are rounding, relative to the extent of the map.
constexpr double rounding = 1e-9;

/// A place on a line of a patch where polygons on its left (+1) or right (-1) begin or, with the
/// opposite sign, end.
struct Change {
  PatchId patch;
  LineId line;
  double place;  ///< from the line's a, m
  int polygons;

  friend bool operator<(const Change& x, const Change& y) {
    return std::tie(x.patch, x.line, x.place) < std::tie(y.patch, y.line, y.place);
  }
};

double distance(const Vec2& p, const Vec2& q) { return std::hypot(q.x - p.x, q.y - p.y); }

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
      if (distance(p, q) <= shortest_ || is_on_outline(i, p, q)) {
        continue;
      }
      const Axis axis = axis_of(lines[k]);
      const auto place = [&axis](const Vec2& v) {
        return (v.x - axis.origin.x) * axis.along.x + (v.y - axis.origin.y) * axis.along.y;
      };
      changes_.push_back({i, lines[k], place(p), 1});
      changes_.push_back({i, lines[k], place(q), -1});
    }
  }

  std::vector<ShadowEdge> find() {
    std::sort(changes_.begin(), changes_.end());
    for (std::size_t begin = 0; begin < changes_.size();) {
      std::size_t end = begin + 1;
      while (end < changes_.size() && changes_[end].patch == changes_[begin].patch &&
             changes_[end].line == changes_[begin].line) {
        ++end;
      }
      add_uncanceled(begin, end);
      begin = end;
    }
    return std::move(edges_);
  }

 private:
  struct Axis {
    Vec2 origin, along;  ///< along: unit
  };

  Axis axis_of(LineId l) const {
    const BspTree::Line& line = at(tree_.lines(), l);
    const Vec2 a = record_.frame.project(at(tree_.points(), line.a)),
               b = record_.frame.project(at(tree_.points(), line.b));
    const double length = distance(a, b);
    return {a, {(b.x - a.x) / length, (b.y - a.y) / length}};
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

  /// Adds the parts of a line on which the changes from `begin` to `end` do not cancel.
  void add_uncanceled(std::size_t begin, std::size_t end) {
    const PatchId i = changes_[begin].patch;
    const Axis axis = axis_of(changes_[begin].line);
    const auto lifted = [&](double place) {
      return record_.frame.point_on(scene_.patch(i), {axis.origin.x + place * axis.along.x,
                                                      axis.origin.y + place * axis.along.y});
    };
    int polygons = 0;
    double from = 0, to = 0;
    bool open = false;
    const auto close = [&] {
      const auto a = lifted(from), b = lifted(to);
      if (open && to - from > shortest_ && a && b) {
        edges_.push_back({i, *a, *b});
      }
      open = false;
    };
    for (std::size_t k = begin; k + 1 < end; ++k) {
      polygons += changes_[k].polygons;
      const double p = changes_[k].place, q = changes_[k + 1].place;
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
  std::vector<Change> changes_;
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
