// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

namespace transillum::mpi {

/// Pauses between two looks at what is awaited: short ones first, then longer ones, so that a
/// process that waits leaves its core to others. MPI's own waiting keeps the core busy.
class Pauses {
 public:
  /// @param longest of the pauses
  explicit Pauses(std::chrono::microseconds longest = std::chrono::milliseconds(1))
      : longest_(longest) {}
  /// To be called after progress.
  void restart() { next_ = shortest; }
  /// The next pause; each is half as long again as the one before.
  std::chrono::microseconds next() {
    const auto pause = next_;
    next_ = std::min(longest_, next_ * 3 / 2);
    return pause;
  }

 private:
  static constexpr std::chrono::microseconds shortest{20};
  std::chrono::microseconds longest_, next_ = shortest;
};

/// Waits for a request of MPI.
/// @param meanwhile called before each pause
inline void wait_for(MPI_Request& request, const std::function<void()>& meanwhile = {},
                     Pauses pauses = Pauses()) {
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) {
      return;
    }
    if (meanwhile) {
      meanwhile();
    }
    std::this_thread::sleep_for(pauses.next());
  }
}

}  // namespace transillum::mpi
