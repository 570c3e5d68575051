// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "transillum/scene.h"
#include "visibility/queries/exact_side.h"
#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// Lines between projected patches, in scenes with many thin ones: the octagons of two needles
/// overlap where both are long, though they are far apart, or touch in a corner
/// (decisions/0088-needles.md). Patches are compared as they are before the tree cuts them, whose
/// corners are points of the grid. Not thread-safe.
class NeedleLines {
 public:
  NeedleLines(const Scene& scene, const ProjectedFragments& projected)
      : scene_(scene), projected_(projected) {}

  /// Finds the lines of the current projection; there are none where few fragments are thin.
  void fill();
  /// Whether are_apart() may be called.
  bool exist() const { return !lines_.empty(); }
  /// Sets the fragment that others are compared with.
  void begin(std::int32_t fragment);
  /// Whether a fragment certainly has no area in common with the one set by begin().
  bool are_apart(std::int32_t fragment) const {
    const Strip& strip = at(strips_, fragment);
    float low = HUGE_VALF, high = -HUGE_VALF;
    for (std::size_t k = 0; k < count_; ++k) {
      const float along = strip.x * x_[k] + strip.y * y_[k];
      low = std::min(low, along);
      high = std::max(high, along);
    }
    return low > strip.high || high < strip.low || lines_separate(fragment);
  }

 private:
  /// The points p of a thin fragment: low <= (x, y) * p <= high, with the rounding of floats.
  struct Strip {
    float x = 0, y = 0, low = -HUGE_VALF, high = HUGE_VALF;
  };
  /// The other side of a line than its patch: the points p with (x, y) * p > beyond; where that is
  /// less than 2 `rounding` more, floats do not decide. By default there are none.
  struct HalfPlane {
    float x = 0, y = 0, beyond = HUGE_VALF;
  };
  /// The lines of the two longest edges of a patch that is thin, which lies on one side of each.
  struct Pair {
    std::array<GridLine, 2> lines;
    /// 1: the patch lies left of the line; -1: right; 0: there is no line
    std::array<std::int8_t, 2> sides{};
    std::array<HalfPlane, 2> beside;  ///< the other sides of the lines
  };

  Strip strip_of(const ProjectedFragments::Fragment& fragment) const;
  Pair lines_of(PatchId patch) const;
  static HalfPlane other_side(const GridLine& line, int side);
  bool lines_separate(std::int32_t fragment) const;
  template <class Corner>
  bool separates(const Pair& pair, PatchId patch, std::size_t corners, Corner corner) const;

  const Scene& scene_;
  const ProjectedFragments& projected_;
  std::vector<Pair> lines_;    ///< by patch
  std::vector<Strip> strips_;  ///< by fragment
  // The fragment of begin():
  PatchId own_ = 0;
  std::size_t count_ = 0;  ///< number of its corners
  std::array<float, FragmentOutlines::max_corners> x_{}, y_{};
};

}  // namespace transillum
