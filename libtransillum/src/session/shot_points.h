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
  /// The work of the shot, in units of the shot by the options.
  double work() const { return work_of(points_); }
  /// The work by which refine() would add to that; infinite where the patches have as many points
  /// as are allowed, or the shot would take too much.
  double work_to_refine(const std::vector<PatchId>& patches) const;
  /// Multiplies the points of some patches, up to EngineOptions::largest_points.
  void refine(const std::vector<PatchId>& patches) { points_ = refined(patches); }

  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive.empty_or(self.patches_, self.points_);
    for (const int points : self.points_) {
      archive.require(points > 0 && points <= EngineOptions::largest_points);
    }
  }

 private:
  std::vector<int> refined(const std::vector<PatchId>& patches) const;
  double work_of(const std::vector<int>& points) const;

  std::size_t patches_;
  int usual_;
  std::vector<int> points_;
};

}  // namespace transillum
