// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "sampling/sphere_neighbors.h"

#include <algorithm>

namespace transillum {

SphereNeighbors::SphereNeighbors(std::span<const Vec3> points, std::size_t listed, double radius)
    : cells_(std::max(1, static_cast<int>(2 / radius))) {
  sorted_.reserve(points.size());
  for (const Vec3& p : points) {
    sorted_.emplace_back(key(cell(p.x), cell(p.y), cell(p.z)),
                         static_cast<std::uint32_t>(sorted_.size()));
  }
  std::sort(sorted_.begin(), sorted_.end());
  for (std::size_t i = 0; i < listed; ++i) {
    begin_.push_back(near_.size());
    append_near(points, i, radius);
  }
  begin_.push_back(near_.size());
}

int SphereNeighbors::cell(double x) const {
  return std::clamp(static_cast<int>((x + 1) / 2 * cells_), 0, cells_ - 1);
}

std::int64_t SphereNeighbors::key(int x, int y, int z) const {
  return x + std::int64_t{cells_} * (y + std::int64_t{cells_} * z);
}

void SphereNeighbors::append_near(std::span<const Vec3> points, std::size_t i, double radius) {
  const auto cells_around = [this](double x) {
    return std::pair(std::max(cell(x) - 1, 0), std::min(cell(x) + 1, cells_ - 1));
  };
  const auto [x0, x1] = cells_around(points[i].x);
  const auto [y0, y1] = cells_around(points[i].y);
  const auto [z0, z1] = cells_around(points[i].z);
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      auto p = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(key(x0, y, z), 0U));
      for (const std::int64_t last = key(x1, y, z); p != sorted_.end() && p->first <= last; ++p) {
        const Vec3 apart = points[i] - points[p->second];
        if (p->second != i && dot(apart, apart) < radius * radius) {
          near_.push_back(p->second);
        }
      }
    }
  }
}

}  // namespace transillum
