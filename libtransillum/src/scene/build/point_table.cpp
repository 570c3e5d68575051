// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/point_table.h"

#include <bit>
#include <limits>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr PointId free_slot = -1;

std::uint64_t mix(std::uint64_t h, double value) {
  h ^= std::bit_cast<std::uint64_t>(value);
  h *= 0x9e3779b97f4a7c15u;
  return h ^ (h >> 29);
}

}  // namespace

std::size_t PointTable::slot_of(const Vec3& position) const {
  const std::uint64_t h = mix(mix(mix(0, position.x), position.y), position.z);
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>(h) & mask;
  while (slots_[slot] != free_slot && at(points_, slots_[slot]) != position) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

void PointTable::grow() {
  slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), free_slot);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    slots_[slot_of(points_[i])] = static_cast<PointId>(i);
  }
}

PointId PointTable::id_of(const Vec3& position) {
  if (2 * points_.size() >= slots_.size()) {
    grow();
  }
  // Adding 0 turns -0 into 0, so equal points have equal bits.
  const Vec3 p{position.x + 0.0, position.y + 0.0, position.z + 0.0};
  const std::size_t slot = slot_of(p);
  if (slots_[slot] == free_slot) {
    if (points_.size() >= static_cast<std::size_t>(std::numeric_limits<PointId>::max())) {
      throw InputError("the scene has more than 2^31 points");
    }
    slots_[slot] = static_cast<PointId>(points_.size());
    points_.push_back(p);
  }
  return slots_[slot];
}

std::vector<PointId> welded_outline(std::span<const PointId> outline,
                                    const std::vector<Vec3>& points, std::vector<PointId>& welded,
                                    PointTable& table) {
  std::vector<PointId> result;
  for (const PointId p : outline) {
    PointId& id = at(welded, p);
    if (id < 0) {
      id = table.id_of(at(points, p));
    }
    if (result.empty() || result.back() != id) {
      result.push_back(id);
    }
  }
  while (result.size() > 1 && result.front() == result.back()) {
    result.pop_back();
  }
  return result;
}

}  // namespace transillum
