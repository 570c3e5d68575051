// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/bin_clip.h"

namespace transillum {
namespace {

/// Clips by one side (0 to 3) of the square.
std::size_t clip_to_bin_side(const WidePolygon& polygon, std::size_t count, int side,
                             long double half, WidePolygon& clipped) {
  const bool along_x = side % 2 == 0;
  const long double limit = side < 2 ? half : -half;
  const auto depth = [&](const WidePoint& p) {
    const long double coordinate = along_x ? p.x : p.y;
    return side < 2 ? half - coordinate : half + coordinate;
  };
  std::size_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const WidePoint &p = polygon[k], &q = polygon[k + 1 < count ? k + 1 : 0];
    const long double here = depth(p), there = depth(q);
    if (here >= 0) {
      clipped[n++] = p;
    }
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
      const long double t = here / (here - there);
      const long double height = p.height + t * (q.height - p.height);
      clipped[n++] = along_x ? WidePoint{limit, p.y + t * (q.y - p.y), height}
                             : WidePoint{p.x + t * (q.x - p.x), limit, height};
    }
  }
  return n;
}

}  // namespace

std::size_t clip_to_bin(WidePolygon& polygon, std::size_t count, long double half) {
  WidePolygon clipped;
  for (int side = 0; side < 4 && count > 0; ++side) {
    count = clip_to_bin_side(polygon, count, side, half, clipped);
    polygon = clipped;
  }
  return count;
}

}  // namespace transillum
