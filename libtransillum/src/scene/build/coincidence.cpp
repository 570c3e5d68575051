// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/patch_builder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "scene/build/cover_rank.h"
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

/// One side of a face on points that others share.
struct Side {
  std::int32_t face;
  bool along;  ///< faces the way of the first side on these points
  CoverRank rank;
};

/// The sides that a face lights, from its first patch and, if that is its opposite, the second.
void add_sides(std::size_t face, const std::vector<Patch>& patches,
               const std::vector<Material>& materials, std::vector<Side>& sides, Vec3& first) {
  const auto number = static_cast<std::int32_t>(face);
  auto patch = first_patch_of(face, patches);
  for (const Vec3 front = patch != patches.end() ? patch->normal : Vec3{};
       patch != patches.end() && patch->face == number; ++patch) {
    if (sides.empty()) {
      first = patch->normal;
    }
    const auto id = static_cast<PatchId>(patch - patches.begin());
    sides.push_back({number, dot(patch->normal, first) > 0,
                     cover_rank(at(materials, patch->material).exitance, patch->area, id)});
    if (patch + 1 == patches.end() || dot((patch + 1)->normal, front) > 0) {
      return;
    }
  }
}

/// Adds the faces that are not the uncovered one on any of their sides.
void add_covered(const std::vector<Side>& sides, std::vector<std::int32_t>& covered) {
  std::array<std::optional<CoverRank>, 2> best;
  for (const Side& side : sides) {
    std::optional<CoverRank>& least = best[side.along ? 1 : 0];
    least = least ? std::min(*least, side.rank) : side.rank;
  }
  for (std::size_t k = 0; k < sides.size();) {
    bool visible = false;
    const std::int32_t face = sides[k].face;
    for (; k < sides.size() && sides[k].face == face; ++k) {
      visible = visible || sides[k].rank == best[sides[k].along ? 1 : 0];
    }
    if (!visible) {
      covered.push_back(face);
    }
  }
}

}  // namespace

std::vector<Patch>::const_iterator first_patch_of(std::size_t face,
                                                  const std::vector<Patch>& patches) {
  const auto number = static_cast<std::int32_t>(face);
  const auto found = std::lower_bound(patches.begin(), patches.end(), number,
                                      [](const Patch& p, std::int32_t f) { return p.face < f; });
  return found != patches.end() && found->face == number ? found : patches.end();
}

std::vector<std::int32_t> covered_faces(
    const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
    const std::vector<Patch>& patches, const std::vector<Material>& materials) {
  std::map<std::size_t, std::vector<std::size_t>> later;
  for (const auto& [face, earliest] : pairs) {
    later[earliest].push_back(face);
  }
  std::vector<std::int32_t> covered;
  for (const auto& [earliest, faces] : later) {
    std::vector<Side> sides;
    Vec3 first;
    add_sides(earliest, patches, materials, sides, first);
    for (const std::size_t face : faces) {
      add_sides(face, patches, materials, sides, first);
    }
    add_covered(sides, covered);
  }
  std::sort(covered.begin(), covered.end());
  return covered;
}

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
