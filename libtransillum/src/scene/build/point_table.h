// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// Assigns one number to all points with exactly the same coordinates; -0 equals 0.
class PointTable {
 public:
  /// The number of the point at `position`, added if it is new.
  /// @throws InputError if there are more points than PointId can number.
  PointId id_of(const Vec3& position);
  const std::vector<Vec3>& points() const { return points_; }
  std::vector<Vec3> take() { return std::move(points_); }

 private:
  void grow();
  std::size_t slot_of(const Vec3& position) const;

  std::vector<Vec3> points_;
  std::vector<PointId> slots_;  // hash table with open addressing; -1: free
};

/// A face's corners as points of `table`, without repeated ones.
/// @param points of the description, to which `outline` refers
/// @param welded for each of them its number in `table`, or -1; filled as points are met
std::vector<PointId> welded_outline(std::span<const PointId> outline,
                                    const std::vector<Vec3>& points, std::vector<PointId>& welded,
                                    PointTable& table);

}  // namespace transillum
