// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/coincidence.h"

#include <algorithm>
#include <cstdint>

#include "transillum/at.h"

namespace transillum {
namespace {

std::vector<PointId> point_set(const SceneDescription& description,
                               const std::vector<PointId>& welded, std::size_t face) {
  std::vector<PointId> set;
  for (const PointId p : description.outline(face)) {
    set.push_back(at(welded, p));
  }
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  return set;
}

std::uint64_t hash_of(const std::vector<PointId>& set) {
  std::uint64_t h = set.size();
  for (const PointId p : set) {
    h = (h ^ static_cast<std::uint64_t>(p)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 31;
  }
  return h;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> coincident_faces(
    const SceneDescription& description, const std::vector<PointId>& welded) {
  std::vector<std::pair<std::uint64_t, std::size_t>> hashed;
  hashed.reserve(description.face_count());
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const std::vector<PointId> set = point_set(description, welded, f);
    if (set.size() >= 3) {
      hashed.emplace_back(hash_of(set), f);
    }
  }
  std::sort(hashed.begin(), hashed.end());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < hashed.size();) {
    std::size_t end = i + 1;
    while (end < hashed.size() && hashed[end].first == hashed[i].first) {
      ++end;
    }
    const auto first =
        end - i > 1 ? point_set(description, welded, hashed[i].second) : std::vector<PointId>();
    for (std::size_t k = i + 1; k < end; ++k) {
      // Different sets with the same hash (one pair in 2^64) are not compared with each other.
      if (point_set(description, welded, hashed[k].second) == first) {
        pairs.emplace_back(hashed[k].second, hashed[i].second);
      }
    }
    i = end;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace transillum
