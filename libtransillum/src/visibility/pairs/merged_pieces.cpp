// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Merges coplanar patches, as in refined faces, into one polygon where the union is convex, so
// that fewer blockers have to be tested (ExchangeFinder). Input: the patches and pieces of a scene.
#include "visibility/pairs/merged_pieces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "scene/build/cover_rank.h"
#include "scene/build/two_sided.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// The boundary loop of the union of some patches: the edges of their outlines without those that
/// occur in both directions. Empty if these do not form a single loop.
Corners loop_about(const Scene& scene, const std::vector<PatchId>& patches) {
  std::set<std::pair<PointId, PointId>> edges;
  for (const PatchId i : patches) {
    const auto outline = scene.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      if (edges.erase({b, a}) == 0) {
        edges.insert({a, b});
      }
    }
  }
  std::map<PointId, PointId> next(edges.begin(), edges.end());
  if (next.size() < edges.size()) {
    return {};
  }
  Corners loop;
  if (next.empty()) {
    return loop;
  }
  const PointId first = next.begin()->first;
  PointId point = first;
  do {
    loop.push_back(scene.point(point));
    const auto edge = next.find(point);
    if (edge == next.end()) {
      return {};
    }
    point = edge->second;
    next.erase(edge);
  } while (point != first);
  if (!next.empty()) {
    loop.clear();
  }
  return loop;
}

/// The loop without corners on straight edges; empty if it is not convex.
Corners convex_outline(const Corners& loop) {
  Corners corners;
  if (loop.empty()) {
    return corners;
  }
  const Vec3 normal = normalized(area_vector(loop));
  for (std::size_t k = 0; k < loop.size(); ++k) {
    constexpr double straight = 1e-12;
    const Vec3 to = loop[k] - loop[(k + loop.size() - 1) % loop.size()];
    const Vec3 from = loop[(k + 1) % loop.size()] - loop[k];
    const double turn = dot(normal, cross(to, from)) / (norm(to) * norm(from));
    if (turn < -straight) {
      return {};
    }
    if (turn > straight) {
      corners.push_back(loop[k]);
    }
  }
  return corners;
}

/// Whether the corners lie in one plane, up to rounding.
bool is_flat(Outline polygon) {
  constexpr double rounding = 1e-13;
  const HalfSpace front = lit_half_space(polygon);
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& x) {
    return std::abs(front.distance(x)) <= rounding * (max_abs(x) + max_abs(x - polygon[0]));
  });
}

double bend_of(Outline corners, const HalfSpace& front) {
  double bend = 0;
  for (const Vec3& x : corners) {
    bend = std::max(bend, std::abs(front.distance(x)));
  }
  return bend;
}

/// The same of the corners of patches.
double bend_of(const Scene& scene, const std::vector<PatchId>& patches, const HalfSpace& front) {
  double bend = 0;
  for (const PatchId i : patches) {
    for (const PointId p : scene.outline(i)) {
      bend = std::max(bend, std::abs(front.distance(scene.point(p))));
    }
  }
  return bend;
}

/// Whether a patch is not the back of a two-sided face.
std::vector<bool> on_first_side(const Scene& scene) {
  std::vector<bool> first_side(static_cast<std::size_t>(scene.patch_count()), true);
  for (PatchId i = 1; i < scene.patch_count(); ++i) {
    at(first_side, i) = !(at(first_side, i - 1) && are_two_sides(scene, i - 1));
  }
  return first_side;
}

/// Sets of patches with the same root are joined.
class JoinedPatches {
 public:
  explicit JoinedPatches(PatchId patches) : parent_(static_cast<std::size_t>(patches)) {
    std::iota(parent_.begin(), parent_.end(), PatchId{0});
  }
  PatchId root(PatchId i) {
    while (at(parent_, i) != i) {
      i = at(parent_, i) = at(parent_, at(parent_, i));
    }
    return i;
  }
  void join(PatchId i, PatchId j) {
    const PatchId a = root(i), b = root(j);
    at(parent_, std::max(a, b)) = std::min(a, b);
  }

 private:
  std::vector<PatchId> parent_;
};

/// Patches by the set that they belong to: coplanar ones that share edges.
std::map<PatchId, std::vector<PatchId>> coplanar_sets(const Scene& scene,
                                                      const std::vector<bool>& first_side) {
  constexpr double flat = 1 - 1e-12;
  JoinedPatches joined(scene.patch_count());
  std::map<std::pair<PointId, PointId>, PatchId> by_edge;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    for (std::size_t k = 0; at(first_side, i) && k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      by_edge[{a, b}] = i;
      const auto other = by_edge.find({b, a});
      if (other != by_edge.end() &&
          dot(scene.patch(i).normal, scene.patch(other->second).normal) >= flat) {
        joined.join(i, other->second);
      }
    }
  }
  std::map<PatchId, std::vector<PatchId>> sets;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (at(first_side, i)) {
      sets[joined.root(i)].push_back(i);
    }
  }
  return sets;
}

constexpr std::array<PatchId, 2> no_sides{no_patch, no_patch};

std::vector<PointId> sorted_corners(const Scene& scene, const Piece& piece) {
  const auto corners = scene.corners(piece);
  std::vector<PointId> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

std::vector<MergedFace> merged_faces(const Scene& scene) {
  std::map<PatchId, MergedFace> by_first;
  const auto add = [&](const std::vector<PatchId>& patches) {
    const Corners outline =
        patches.size() > 1 ? convex_outline(loop_about(scene, patches)) : Corners{};
    if (outline.empty() || !is_flat(outline)) {
      return false;
    }
    // Normals that differ by rounding may add up.
    constexpr double largest_bend = 1e-6;
    const double bend = bend_of(scene, patches, lit_half_space(outline));
    if (bend > largest_bend * radius_about(outline[0], outline)) {
      return false;
    }
    by_first.insert({patches.front(), {patches, outline, bend}});
    return true;
  };
  for (const auto& [root, patches] : coplanar_sets(scene, on_first_side(scene))) {
    if (add(patches)) {
      continue;
    }
    // The patches of a face are consecutive.
    for (auto begin = patches.begin(), end = begin; begin != patches.end(); begin = end) {
      end = std::find_if(begin, patches.end(), [&](PatchId i) {
        return scene.patch(i).face != scene.patch(*begin).face;
      });
      add({begin, end});
    }
  }
  std::vector<MergedFace> merged;
  merged.reserve(by_first.size());
  for (const auto& [first, face] : by_first) {
    merged.push_back(face);
  }
  return merged;
}

std::vector<MergedPiece> merged_pieces(const Scene& scene) {
  std::vector<bool> kept = on_first_side(scene);
  std::vector<MergedPiece> merged;
  for (const MergedFace& face : merged_faces(scene)) {
    merged.push_back({face.outline, face.bend, face.patches});
    for (const PatchId i : face.patches) {
      at(kept, i) = false;
    }
  }
  const bool any_coincide = scene.report().coincident_faces > 0;
  std::map<std::vector<PointId>, std::size_t> by_corners;
  for (const Piece& piece : scene.pieces()) {
    if (!at(kept, piece.patch)) {
      continue;
    }
    if (any_coincide) {
      const auto [same, is_new] =
          by_corners.try_emplace(sorted_corners(scene, piece), merged.size());
      if (!is_new) {
        at(merged, same->second).patches.push_back(piece.patch);
        continue;
      }
    }
    MergedPiece& kept_piece = merged.emplace_back();
    kept_piece.patches = {piece.patch};
    for (const PointId p : scene.corners(piece)) {
      kept_piece.outline.push_back(scene.point(p));
    }
    kept_piece.bend = bend_of(kept_piece.outline, lit_half_space(kept_piece.outline));
  }
  return merged;
}

std::vector<Piece> uppermost_pieces(const Scene& scene) {
  if (scene.report().coincident_faces == 0) {
    return {scene.pieces().begin(), scene.pieces().end()};
  }
  // By their corners, the uppermost of one side, and of the other.
  std::map<std::vector<PointId>, std::array<PatchId, 2>> by_corners;
  const auto place_of = [&](const Piece& piece) -> PatchId& {
    auto& sides = by_corners.try_emplace(sorted_corners(scene, piece), no_sides).first->second;
    const bool is_other = sides[0] != no_patch &&
                          dot(scene.patch(piece.patch).normal, scene.patch(sides[0]).normal) <= 0;
    return sides[is_other ? 1 : 0];
  };
  for (const Piece& piece : scene.pieces()) {
    PatchId& upper = place_of(piece);
    if (upper == no_patch || cover_rank(scene, piece.patch) < cover_rank(scene, upper)) {
      upper = piece.patch;
    }
  }
  std::vector<Piece> uppermost;
  for (const Piece& piece : scene.pieces()) {
    if (place_of(piece) == piece.patch) {
      uppermost.push_back(piece);
    }
  }
  return uppermost;
}

std::vector<PatchId> first_sides(const Scene& scene) {
  const std::vector<bool> first = on_first_side(scene);
  std::vector<PatchId> sides;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    // The sides of a patch follow each other.
    sides.push_back(at(first, i) ? i : i - 1);
  }
  return sides;
}

}  // namespace transillum
