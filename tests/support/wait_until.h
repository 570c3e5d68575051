// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <thread>

namespace transillum::testing {

/// Waits for what another process or thread does: asks for `condition` every millisecond, and
/// returns whether it holds, at the latest after `longest`. The only place of the tests where a
/// thread sleeps (tests/unit/waits_test.cpp); with an event loop, see test::wait_for() of
/// tests/viewer/window_support.h.
template <class Condition>
[[nodiscard]] bool wait_until(const Condition& condition,
                              std::chrono::seconds longest = std::chrono::minutes(2)) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace transillum::testing
