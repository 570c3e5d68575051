// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Merges the patches of refined faces back into one polygon where that is convex, so that fewer
// blockers have to be tested (ExchangeFinder). Input: the patches and pieces of a scene.
#include "visibility/pairs/merged_pieces.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

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

}  // namespace

std::vector<Corners> merged_pieces(const Scene& scene) {
  std::vector<Corners> merged;
  std::size_t piece = 0;
  const auto add_pieces_before = [&](PatchId end, bool keep) {
    for (; piece < scene.pieces().size() && scene.pieces()[piece].patch < end; ++piece) {
      if (!keep) {
        continue;
      }
      Corners& corners = merged.emplace_back();
      for (const PointId p : scene.corners(scene.pieces()[piece])) {
        corners.push_back(scene.point(p));
      }
    }
  };
  // The patches of a face are consecutive.
  for (PatchId begin = 0, end = 0; begin < scene.patch_count(); begin = end) {
    std::vector<PatchId> patches;
    const Patch& first = scene.patch(begin);
    for (; end < scene.patch_count() && scene.patch(end).face == first.face; ++end) {
      // Of a two-sided face, take the patches of one side only.
      if (dot(scene.patch(end).normal, first.normal) > 0) {
        patches.push_back(end);
      }
    }
    const Corners outline =
        patches.size() > 1 ? convex_outline(loop_about(scene, patches)) : Corners{};
    const bool whole = !outline.empty() && is_flat(outline);
    if (whole) {
      merged.push_back(outline);
    }
    add_pieces_before(end, !whole);
  }
  return merged;
}

}  // namespace transillum
