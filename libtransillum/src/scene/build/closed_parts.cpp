// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/closed_parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "transillum/at.h"

namespace transillum {
namespace {

/// An edge of a face, from its smaller point to its larger one.
struct FaceEdge {
  PointId from, to;
  bool forward;  ///< the outline runs from `from` to `to`
  std::int32_t face;

  bool same_points(const FaceEdge& other) const { return from == other.from && to == other.to; }
};

std::vector<FaceEdge> sorted_edges(const std::vector<std::vector<PointId>>& outlines) {
  std::vector<FaceEdge> edges;
  for (std::size_t f = 0; f < outlines.size(); ++f) {
    const std::vector<PointId>& outline = outlines[f];
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<std::int32_t>(f)});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
    return std::tie(a.from, a.to, a.face) < std::tie(b.from, b.to, b.face);
  });
  return edges;
}

class FaceSets {
 public:
  explicit FaceSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t root(std::int32_t f) {
    while (at(parent_, f) != f) {
      f = at(parent_, f) = at(parent_, at(parent_, f));
    }
    return f;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    at(parent_, std::max(a, b)) = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

std::vector<ConnectedFaces> connected_faces(const SceneDescription& description,
                                            const std::vector<std::vector<PointId>>& outlines) {
  const std::vector<FaceEdge> edges = sorted_edges(outlines);
  FaceSets sets(outlines.size());
  const auto for_each_edge = [](const std::vector<FaceEdge>& all, const auto& visit) {
    for (auto begin = all.begin(); begin != all.end();) {
      const auto end = std::find_if_not(
          begin, all.end(), [&](const FaceEdge& edge) { return edge.same_points(*begin); });
      visit(begin, end);
      begin = end;
    }
  };
  const auto join_two = [&](auto begin, auto end) {
    if (end - begin == 2 && begin->forward != std::next(begin)->forward) {
      sets.join(begin->face, std::next(begin)->face);
    }
  };
  for_each_edge(edges, join_two);
  // Parts that touch along edges have points of their own in most files.
  std::vector<std::vector<PointId>> as_numbered;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const auto outline = description.outline(f);
    as_numbered.emplace_back(outline.begin(), outline.end());
  }
  for_each_edge(sorted_edges(as_numbered), join_two);
  std::vector<ConnectedFaces> parts;
  std::vector<std::int32_t> part_of(outlines.size(), -1);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(outlines.size()); ++f) {
    std::int32_t& part = at(part_of, sets.root(f));
    if (part < 0) {
      part = static_cast<std::int32_t>(parts.size());
      parts.push_back({{}, true});
    }
    at(parts, part).faces.push_back(f);
    at(part_of, f) = part;
    at(parts, part).closed &= at(outlines, f).size() >= 3 && !description.is_two_sided(f);
  }
  for_each_edge(edges, [&](auto begin, auto end) {
    std::map<std::int32_t, std::pair<int, int>> uses;
    for (auto edge = begin; edge != end; ++edge) {
      auto& [forward, backward] = uses[at(part_of, edge->face)];
      ++(edge->forward ? forward : backward);
    }
    for (const auto& [part, count] : uses) {
      at(parts, part).closed &= count == std::pair(1, 1);
    }
  });
  return parts;
}

}  // namespace transillum
