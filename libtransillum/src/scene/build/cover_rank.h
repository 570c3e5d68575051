// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <tuple>

#include "transillum/scene.h"

namespace transillum {

/// Of coplanar patches with the same normal, the one with the least rank covers the others where
/// they overlap. Emitters and smaller patches must stay visible, such as a lamp in its ceiling;
/// numbers break ties.
using CoverRank = std::tuple<double, double, PatchId>;

inline CoverRank cover_rank(const Rgb& exitance, double area, PatchId patch) {
  return {-max_abs(exitance), area, -patch};
}
inline CoverRank cover_rank(const Scene& scene, PatchId patch) {
  return cover_rank(scene.exitance(patch), scene.patch(patch).area, patch);
}

}  // namespace transillum
