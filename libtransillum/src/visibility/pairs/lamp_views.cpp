// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The polygons of lamps, and their views from points: what may stand between is found once for a
// patch (a shaft), or for a point (a pyramid).
#include <algorithm>

#include "transillum/at.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {

std::vector<LampPolygon> ExchangeFinder::lamps(std::span<const PatchId> patches) const {
  std::vector<LampPolygon> lamps;
  auto face = faces_.begin();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const PatchId i = patches[k];
    const Rgb& exitance = scene_.exitance(i);
    while (face != faces_.end() && face->patches.back() < i) {
      ++face;
    }
    // Consecutive patches, all of which emit the same and are not covered.
    if (face != faces_.end() && face->patches.front() == i &&
        k + face->patches.size() <= patches.size() &&
        std::equal(face->patches.begin(), face->patches.end(),
                   patches.begin() + static_cast<std::ptrdiff_t>(k)) &&
        std::all_of(face->patches.begin(), face->patches.end(),
                    [&](PatchId j) { return scene_.exitance(j) == exitance && is_open(j); })) {
      lamps.push_back({exitance, face->outline, lit_half_space(face->outline),
                       bend_beyond_rounding(scale_ * face->bend), face->patches});
      k += face->patches.size() - 1;
      continue;
    }
    for (const OpenPiece& open : open_pieces_of(i)) {
      LampPolygon& lamp = lamps.emplace_back(LampPolygon{exitance, {}, open.front, open.bend, {i}});
      const Outline corners = corners_of(open);
      lamp.outline.assign(corners.begin(), corners.end());
    }
  }
  return lamps;
}

/// Whether no coplanar patch covers any of patch j.
bool ExchangeFinder::is_open(PatchId j) const {
  double area = 0;
  for (const OpenPiece& open : open_pieces_of(j)) {
    area += norm(area_vector(corners_of(open)));
  }
  constexpr double rounding = 1e-9;
  return area >= (1 - rounding) * scale_ * scale_ * scene_.patch(j).area;
}

std::optional<PointView> ExchangeFinder::view_of(const LampPolygon& lamp, PatchId i) const {
  Numbers blockers, all;
  bool is_seen = false;
  for (const OpenPiece& open : open_pieces_of(i)) {
    const FacingPolygons facing(corners_of(open), open.front, lamp.outline, lamp.front,
                                tolerance_ + open.bend + lamp.bend);
    if (!facing.empty()) {
      collect_blockers(
          facing,
          {at(first_sides_, i), at(first_sides_, lamp.patches.front()), {open.bend, lamp.bend}},
          nullptr, blockers);
      is_seen = is_seen || !is_any_hiding(facing, blockers);
      all.insert(all.end(), blockers.begin(), blockers.end());
    }
  }
  if (!is_seen) {
    return std::nullopt;
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return PointView(lamp.outline, polygons_of(all));
}

std::optional<PointView> ExchangeFinder::view_from(const Vec3& x, const LampPolygon& lamp) const {
  if (lamp.front.distance(x) <= tolerance_ + lamp.bend) {
    return std::nullopt;
  }
  Numbers blockers;
  collect_blockers(x, lamp.outline, {lamp.front, lamp.bend}, lamp.patches.front(), blockers);
  return PointView(lamp.outline, polygons_of(blockers));
}

}  // namespace transillum
