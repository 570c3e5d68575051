// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QElapsedTimer>

namespace transillum::viewer {

/// Wall time since the timer was started, s.
inline double seconds(const QElapsedTimer& timer) {
  return 1e-9 * static_cast<double>(timer.nsecsElapsed());
}

}  // namespace transillum::viewer
