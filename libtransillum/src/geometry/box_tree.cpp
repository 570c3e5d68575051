// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "geometry/box_tree.h"

#include <algorithm>

#include "transillum/at.h"

namespace transillum {

BoxTree::BoxTree(const std::vector<Bounds>& boxes) {
  std::vector<Item> items;
  for (const Bounds& box : boxes) {
    items.push_back({static_cast<std::int32_t>(items.size()), box});
  }
  nodes_.reserve(2 * items.size());
  if (!items.empty()) {
    build(items, 0, items.size());
  }
}

/// Splits the items at the median of their centers along the longest extent of the centers, so that
/// the depth is log2 of their number.
std::int32_t BoxTree::build(std::vector<Item>& items, std::size_t begin, std::size_t end) {
  Bounds all, middles;
  for (std::size_t k = begin; k < end; ++k) {
    all.add(items[k].box.low);
    all.add(items[k].box.high);
    middles.add(items[k].box.center());
  }
  const auto id = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({{all.center(), 0.5 * all.high - 0.5 * all.low}, items[begin].number, -1});
  if (end - begin == 1) {
    return id;
  }

  const Vec3 size = middles.high - middles.low;
  const double longest = max_abs(size);
  double Vec3::*axis = size.x == longest ? &Vec3::x : size.y == longest ? &Vec3::y : &Vec3::z;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto place = [&](std::size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(place(begin), place(middle), place(end), [&](const Item& a, const Item& b) {
    const double x = a.box.center().*axis, y = b.box.center().*axis;
    return x != y ? x < y : a.number < b.number;
  });
  const std::int32_t first = build(items, begin, middle), second = build(items, middle, end);
  at(nodes_, id).first = first;
  at(nodes_, id).second = second;
  return id;
}

}  // namespace transillum
