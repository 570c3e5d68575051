// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/needle_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace transillum {

NeedleFrame NeedleFrame::around(std::span<const GridPoint> corners) {
  NeedleFrame frame = at_origin(corners[0]);
  GridPoint longest;
  double extent = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const GridPoint &a = corners[k], &b = corners[k + 1 < corners.size() ? k + 1 : 0];
    const GridPoint edge{b.x - a.x, b.y - a.y};
    const auto length = static_cast<double>(std::max(std::abs(edge.x), std::abs(edge.y)));
    if (length > extent) {
      extent = length;
      longest = edge;
    }
  }
  frame.set_along(longest);
  long double low = std::numeric_limits<long double>::infinity(), high = -low;
  for (const GridPoint& corner : corners) {
    const long double height = frame.height({corner});
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const auto ratio = static_cast<double>(extent / (high - low));
  if (!(ratio > 0) || std::isinf(ratio)) {
    return at_origin(corners[0]);
  }
  frame.set_scale(std::ldexp(1.0, std::ilogb(ratio)));
  return frame;
}

}  // namespace transillum
