// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "transillum/visibility_map.h"

namespace transillum {

/// What engine corrected believes of V: it cuts nothing and keeps no shapes, so fragments are
/// whole, each with how much of it counts as open from below.
struct CorrectedMap {
  struct Part {
    PatchId patch;
    bool front_facing;         ///< it receives, and shows its back: nobody asks what is open of it
    double area;               ///< of its projection, m², > 0
    double open;               ///< of that, what the engine takes as open, m²; may be below 0
    double exact;              ///< what is open of it, m²
    std::uint32_t begin, end;  ///< in `corners`
  };

  PlaneFrame frame;
  std::vector<Part> parts;  ///< in the order of the steps, those farthest toward omega first
  std::vector<Vec2> corners;

  std::span<const Vec2> outline(const Part& part) const {
    return {corners.data() + part.begin, part.end - part.begin};
  }
  /// Of what is open, by the engine or in truth, the share that is so by one of them alone.
  double wrong_share() const;
};

/// After step `step` (-1: before the first) of a recorded direction.
/// @throws Canceled
CorrectedMap corrected_map_after(const std::shared_ptr<const Scene>& scene,
                                 const std::shared_ptr<const BspTree>& tree,
                                 const MapRecord& record, std::int32_t step,
                                 const Cancellation& cancellation = {});

}  // namespace transillum
