// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/needle_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transillum/at.h"

namespace transillum {
namespace {

/// The square of the extent over the area from which on a fragment is thin.
constexpr double thin = 256;
/// Fraction of thin fragments from which on their lines pay.
constexpr double least_fraction = 1.0 / 6;

/// Bound, in grid units, of what the floats of a corner and of its distance are off by, twice:
/// coordinates are below 2^60. The corners of cut needles are off by far less.
constexpr float rounding = 0x1p40F;

bool is_thin(const FragmentBox& box, double area) {
  const double width = -static_cast<double>(box.ends[4]) - static_cast<double>(box.ends[0]);
  const double height = -static_cast<double>(box.ends[5]) - static_cast<double>(box.ends[1]);
  const double extent = std::max(width, height);
  return extent * extent > thin * area;
}

/// 1 where p lies left of a line, -1 right, 0 on it; exact.
int side_of(const GridLine& line, const GridPoint& p) {
  const auto dx = static_cast<double>(line.b.x - line.a.x);
  const auto dy = static_cast<double>(line.b.y - line.a.y);
  const double left = dx * static_cast<double>(p.y - line.a.y);
  const double right = dy * static_cast<double>(p.x - line.a.x);
  if (std::abs(left - right) > 0x1p-50 * (std::abs(left) + std::abs(right))) {
    return left > right ? 1 : -1;
  }
  const WideInteger turn = exact_turn(line.a, line.b, p);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

}  // namespace

void NeedleLines::fill() {
  lines_.clear();
  const std::size_t count = projected_.fragments.size();
  std::vector<char> is_thin_patch(static_cast<std::size_t>(scene_.patch_count()));
  std::size_t thin_ones = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (is_thin(projected_.boxes[k], projected_.fragments[k].area)) {
      ++thin_ones;
      at(is_thin_patch, projected_.fragments[k].patch) = 1;
    }
  }
  if (static_cast<double>(thin_ones) < least_fraction * static_cast<double>(count)) {
    return;
  }
  strips_.assign(count, {});
  for (std::size_t k = 0; k < count; ++k) {
    if (is_thin(projected_.boxes[k], projected_.fragments[k].area)) {
      strips_[k] = strip_of(projected_.fragments[k]);
    }
  }
  lines_.resize(is_thin_patch.size());
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    if (at(is_thin_patch, i) != 0) {
      at(lines_, i) = lines_of(i);
    }
  }
}

/// Between the parallels to the longest edge.
NeedleLines::Strip NeedleLines::strip_of(const ProjectedFragments::Fragment& fragment) const {
  const GridPoint* const corners = projected_.corners.data();
  double longest = 0;
  Strip strip;
  for (std::uint32_t k = fragment.begin; k < fragment.end; ++k) {
    const GridPoint &a = corners[k], &b = corners[k + 1 < fragment.end ? k + 1 : fragment.begin];
    const auto dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    const double length = std::hypot(dx, dy);
    if (length > longest) {
      longest = length;
      strip.x = static_cast<float>(-dy / length);
      strip.y = static_cast<float>(dx / length);
    }
  }
  strip.low = HUGE_VALF;
  strip.high = -HUGE_VALF;
  for (std::uint32_t k = fragment.begin; k < fragment.end; ++k) {
    const auto x = static_cast<float>(corners[k].x), y = static_cast<float>(corners[k].y);
    const float along = strip.x * x + strip.y * y;
    strip.low = std::min(strip.low, along);
    strip.high = std::max(strip.high, along);
  }
  strip.low -= rounding;
  strip.high += rounding;
  return strip;
}

NeedleLines::Pair NeedleLines::lines_of(PatchId patch) const {
  const std::vector<GridPoint>& points = projected_.grid.points;
  const std::span<const PointId> corners = scene_.outline(patch);
  Pair pair;
  std::array<double, 2> longest{};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const GridLine edge{at(points, corners[k]),
                        at(points, corners[k + 1 < corners.size() ? k + 1 : 0])};
    const double length = std::hypot(static_cast<double>(edge.b.x - edge.a.x),
                                     static_cast<double>(edge.b.y - edge.a.y));
    if (length > longest[0]) {
      longest[1] = longest[0];
      pair.lines[1] = pair.lines[0];
      longest[0] = length;
      pair.lines[0] = edge;
    } else if (length > longest[1]) {
      longest[1] = length;
      pair.lines[1] = edge;
    }
  }
  for (std::size_t m = 0; m < pair.lines.size() && longest[m] > 0; ++m) {
    bool left = false, right = false;
    for (const PointId p : corners) {
      const int side = side_of(pair.lines[m], at(points, p));
      left = left || side > 0;
      right = right || side < 0;
    }
    pair.sides[m] = static_cast<std::int8_t>(left == right ? 0 : left ? 1 : -1);
    pair.beside[m] = other_side(pair.lines[m], pair.sides[m]);
  }
  return pair;
}

NeedleLines::HalfPlane NeedleLines::other_side(const GridLine& line, int side) {
  const auto dx = static_cast<double>(line.b.x - line.a.x);
  const auto dy = static_cast<double>(line.b.y - line.a.y);
  const double length = std::hypot(dx, dy) * side;
  if (length == 0) {
    return {};
  }
  // To the right where the patch lies left.
  const double x = dy / length, y = -dx / length;
  const double on_line = x * static_cast<double>(line.a.x) + y * static_cast<double>(line.a.y);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(on_line) - rounding};
}

void NeedleLines::begin(std::int32_t fragment) {
  const ProjectedFragments::Fragment& f = at(projected_.fragments, fragment);
  own_ = f.patch;
  count_ = f.end - f.begin;
  for (std::size_t k = 0; k < count_; ++k) {
    const GridPoint& p = projected_.corners[f.begin + k];
    x_[k] = static_cast<float>(p.x);
    y_[k] = static_cast<float>(p.y);
  }
}

bool NeedleLines::lines_separate(std::int32_t fragment) const {
  const ProjectedFragments::Fragment& other = at(projected_.fragments, fragment);
  if (separates(at(lines_, other.patch), own_, count_,
                [&](std::size_t k) { return std::pair(x_[k], y_[k]); })) {
    return true;
  }
  const GridPoint* const corners = projected_.corners.data() + other.begin;
  return separates(at(lines_, own_), other.patch, other.end - other.begin, [&](std::size_t k) {
    return std::pair(static_cast<float>(corners[k].x), static_cast<float>(corners[k].y));
  });
}

/// Whether a fragment, given by its patch and corners, lies on the other side of a line than the
/// patch of the pair.
template <class Corner>
bool NeedleLines::separates(const Pair& pair, PatchId patch, std::size_t corners,
                            Corner corner) const {
  for (std::size_t m = 0; m < pair.lines.size(); ++m) {
    const HalfPlane& side = pair.beside[m];
    float least = HUGE_VALF;
    for (std::size_t k = 0; k < corners; ++k) {
      const auto [x, y] = corner(k);
      least = std::min(least, side.x * x + side.y * y - side.beyond);
    }
    if (least > 2 * rounding) {
      return true;
    }
    const auto is_beside = [&](PointId p) {
      return side_of(pair.lines[m], at(projected_.grid.points, p)) != pair.sides[m];
    };
    const std::span<const PointId> outline = scene_.outline(patch);
    if (least > 0 && std::all_of(outline.begin(), outline.end(), is_beside)) {
      return true;
    }
  }
  return false;
}

}  // namespace transillum
