// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>

namespace transillum::cli {

using WallClock = std::chrono::steady_clock;

/// Wall time since `start`, s.
inline double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

}  // namespace transillum::cli
