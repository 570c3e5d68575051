// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/first_shot.h"

namespace transillum {

/// By how many points the direct light of each patch is shot, where an accuracy takes more than the
/// options say.
class ShotPoints {
 public:
  /// @param options of the shot
  /// @param patches number
  ShotPoints(const ShotOptions& options, std::size_t patches);

  /// One per patch; empty until refine().
  const std::vector<int>& of_patches() const { return points_; }
  /// Multiplies the points of some patches, up to EngineOptions::largest_points.
  /// @returns false, with no change, where they have that many, or where the shot would take too
  /// much work
  bool refine(const std::vector<PatchId>& patches);

  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive.empty_or(self.patches_, self.points_);
    for (const int points : self.points_) {
      archive.require(points > 0 && points <= EngineOptions::largest_points);
    }
  }

 private:
  std::size_t patches_;
  int usual_;
  std::vector<int> points_;
};

}  // namespace transillum
