// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

namespace transillum {

/// The work done so far: wall time, s, and number of passes.
struct SolverTiming {
  double seconds_transfers = 0;  ///< in passes
  double seconds_iterate = 0;    ///< in everything else
  std::int64_t passes_made = 0;  ///< by the engine, in all iterations
};

}  // namespace transillum
