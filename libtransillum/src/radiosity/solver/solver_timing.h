// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

namespace transillum {

/// The work done so far: wall time, s, and number of passes.
struct SolverTiming {
  double seconds_transfers = 0;  ///< in passes
  double seconds_iterate = 0;    ///< in everything else
  std::int64_t passes_made = 0;  ///< by the engine, in all iterations

  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive(self.seconds_transfers, self.seconds_iterate, self.passes_made);
  }
};

}  // namespace transillum
