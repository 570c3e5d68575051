// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/bsp/disk_tree.h"

#include <algorithm>
#include <numeric>

namespace transillum {
namespace {

constexpr std::uint32_t polygons_in_leaf = 4;

}  // namespace

DiskTree::DiskTree(const PolygonSet& set, const std::vector<BspTree::Plane>& planes,
                   const std::function<void()>& check)
    : set_(set), planes_(planes), polygons_(set.size()) {
  std::iota(polygons_.begin(), polygons_.end(), 0);
  centers_.reserve(set.size());
  for (const PolygonSet::Polygon& polygon : set.polygons) {
    Bounds bounds;
    for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
      bounds.add(set.places[c]);
    }
    centers_.push_back(bounds.center());
  }
  nodes_.push_back({{}, {}, 0, 0, 0, static_cast<std::uint32_t>(set.size())});
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const auto [begin, end] = std::pair(nodes_[n].begin, nodes_[n].end);
    for (std::uint32_t k = begin; k < end; ++k) {
      check();
    }
    nodes_[n] = bound(begin, end);
    if (end - begin > polygons_in_leaf) {
      const auto middle = static_cast<std::uint32_t>(halve(begin, end));
      nodes_[n].first = static_cast<std::uint32_t>(nodes_.size());
      nodes_[n].second = nodes_[n].first + 1;
      nodes_.push_back({{}, {}, 0, 0, begin, middle});
      nodes_.push_back({{}, {}, 0, 0, middle, end});
    }
  }
}

DiskTree::Node DiskTree::bound(std::uint32_t begin, std::uint32_t end) const {
  Vec3 sum, middle;
  for (std::uint32_t k = begin; k < end; ++k) {
    sum = sum + at(planes_, at(set_.polygons, polygons_[k]).plane).normal;
    middle = middle + at(centers_, polygons_[k]);
  }
  Node node{middle / static_cast<double>(end - begin),
            norm(sum) > 0 ? normalized(sum) : Vec3{0, 0, 1},
            0,
            0,
            begin,
            end};
  double low = HUGE_VAL, high = -HUGE_VAL, squared_radius = 0;
  for (std::uint32_t k = begin; k < end; ++k) {
    const PolygonSet::Polygon& polygon = at(set_.polygons, polygons_[k]);
    for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
      const Vec3 from_center = set_.places[c] - node.center;
      const double along = dot(from_center, node.axis);
      low = std::min(low, along);
      high = std::max(high, along);
      const Vec3 across = from_center - along * node.axis;
      squared_radius = std::max(squared_radius, dot(across, across));
    }
  }
  // A little larger, by more than its rounding errors.
  constexpr double margin = 1 + 0x1p-30;
  node.center = node.center + 0.5 * (low + high) * node.axis;
  node.half_height = margin * 0.5 * (high - low) + 0x1p-40 * max_abs(node.center);
  node.radius = margin * std::sqrt(squared_radius);
  return node;
}

/// Sorts a range of polygons into halves at the median of their centers along its longest extent.
std::size_t DiskTree::halve(std::uint32_t begin, std::uint32_t end) {
  Bounds bounds;
  for (std::uint32_t k = begin; k < end; ++k) {
    bounds.add(at(centers_, polygons_[k]));
  }
  const Vec3 size = bounds.high - bounds.low;
  const double longest = max_abs(size);
  double Vec3::*axis = size.x == longest ? &Vec3::x : size.y == longest ? &Vec3::y : &Vec3::z;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto place = [&](std::uint32_t k) { return polygons_.begin() + k; };
  std::nth_element(place(begin), place(middle), place(end), [&](std::int32_t a, std::int32_t b) {
    const double x = at(centers_, a).*axis, y = at(centers_, b).*axis;
    return x != y ? x < y : a < b;
  });
  return middle;
}

}  // namespace transillum
