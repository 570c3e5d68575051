// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

namespace transillum::viewer {

/// The state that a solve is to reach before it pauses. With rounds of refinement, `finished` and
/// `passes` are about the solve after the last round.
struct Goal {
  enum class Kind { pause, direction, iteration, passes, finished };
  Kind kind = Kind::pause;
  std::int64_t passes = 0;  ///< for Kind::passes: passes_done() of the solve
  /// Whether a scene without light is solved, for the form factors that give light to a lamp made
  /// in the window. Without it, such a scene is only opened.
  bool without_light = false;
};

}  // namespace transillum::viewer
