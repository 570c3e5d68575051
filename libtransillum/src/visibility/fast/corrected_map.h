// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "transillum/visibility_map.h"

namespace transillum {

/// The state of V in engine corrected, which cuts nothing: whole projected fragments, each with the
/// part of its area that the engine takes as visible from below.
struct CorrectedMap {
  /// A projected fragment.
  struct Fragment {
    PatchId patch;        ///< patch of the fragment
    bool front_facing;    ///< the fragment receives; its back is visible, and `open` is not used
    double area;          ///< area of its projection, m², > 0
    double open;          ///< visible part according to the engine, m²; may be negative
    double exact;         ///< visible part, exact, m²
    std::uint32_t begin;  ///< first index in `corners`
    std::uint32_t end;    ///< one past the last index
  };

  PlaneFrame frame;                 ///< frame of the direction
  std::vector<Fragment> fragments;  ///< in the order of the steps: farthest along omega first
  std::vector<Vec2> corners;        ///< corners of all parts

  /// Corners of a part.
  std::span<const Vec2> outline(const Fragment& fragment) const {
    return {corners.data() + fragment.begin, fragment.end - fragment.begin};
  }
  /// Sum of |open - exact| over the sum of both, over the emitting parts: 0 if the engine is exact.
  double wrong_share() const;
};

/// The state of engine corrected after step `step` (-1: before the first) of a recorded direction.
/// @throws Canceled
CorrectedMap corrected_map_after(const std::shared_ptr<const Scene>& scene,
                                 const std::shared_ptr<const BspTree>& tree,
                                 const MapRecord& record, std::int32_t step,
                                 const Cancellation& cancellation = {});

}  // namespace transillum
