// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/form_factor.h"
#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// A point of the scene as a corner of the patches of one plane that meet there.
struct PlanePoint {
  Vec3 place;   ///< moved a little into these patches, so that it is on none of their borders, m
  Vec3 normal;  ///< normal of these patches
};

/// The pieces of each patch, and the points that patches of a plane share.
///
/// Threads: immutable once built.
class PlanePoints {
 public:
  /// Keeps a reference to `scene`.
  /// @throws Canceled
  explicit PlanePoints(const Scene& scene, const Cancellation& cancellation = {});

  const std::vector<PlanePoint>& points() const { return points_; }
  /// The patches that meet at a point, ascending.
  std::span<const PatchId> patches_at(std::int32_t point) const {
    const std::size_t begin = at(first_patch_, point), end = at(first_patch_, point + 1);
    return {patches_.data() + begin, end - begin};
  }
  /// Index into points() of a corner of a piece.
  std::int32_t of_corner(std::size_t piece, std::size_t corner) const {
    return of_corner_[first_corner_[piece] + corner];
  }
  /// The first piece of a patch; the others follow.
  std::size_t first_piece(PatchId patch) const { return at(first_piece_, patch); }
  /// One past the last piece of a patch.
  std::size_t end_piece(PatchId patch) const { return at(first_piece_, patch + 1); }

  /// The corners of a piece.
  Corners outline(std::size_t piece) const;

  /// `x` moved toward `middle` by a little.
  Vec3 inward(const Vec3& x, const Vec3& middle) const;

 private:
  const Scene& scene_;
  double step_;  ///< m
  std::vector<PlanePoint> points_;
  std::vector<std::uint32_t> first_patch_;  ///< by point, and the number of patches_
  std::vector<PatchId> patches_;            ///< at one point after the other
  std::vector<std::size_t> first_piece_;    ///< by patch, and the number of pieces
  std::vector<std::size_t> first_corner_;   ///< by piece
  std::vector<std::int32_t> of_corner_;
};

}  // namespace transillum
