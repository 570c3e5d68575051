// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>

#include "transillum/scene.h"

namespace transillum {

/// Whether patches i and i + 1 are the front and the back of a two-sided face, or of a part of it.
inline bool are_two_sides(const Scene& scene, PatchId i) {
  if (i < 0 || i + 1 >= scene.patch_count()) {
    return false;
  }
  const Patch &front = scene.patch(i), &back = scene.patch(i + 1);
  const auto a = scene.outline(i), b = scene.outline(i + 1);
  return front.face == back.face && front.normal == -back.normal && a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.rbegin());
}

}  // namespace transillum
