// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How soon a computation ends after it was canceled, in CPU time: independent of the machine's
// load.
#pragma once

#include <pthread.h>

#include <atomic>
#include <ctime>
#include <optional>
#include <thread>

#include "support/wait_until.h"
#include "transillum/cancellation.h"
#include "transillum/errors.h"

namespace transillum::testing {

/// The limit: seconds from a cancellation to the end of a pass.
constexpr double longest_stop = 0.05;

inline double cpu_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// CPU time of this thread from the cancellation of `compute`, when it has taken `delay` seconds,
/// to its end; nothing where it ended before.
/// @param compute called with a Cancellation; computes in this thread only
template <class Compute>
std::optional<double> seconds_to_stop(const Compute& compute, double delay) {
  clockid_t clock{};
  if (::pthread_getcpuclockid(::pthread_self(), &clock) != 0) {
    return std::nullopt;
  }
  const Cancellation cancellation;
  const double start = cpu_seconds(clock);
  double canceled = 0;
  std::atomic<bool> ended = false;
  std::thread canceler([&] {
    (void)wait_until([&] { return cpu_seconds(clock) >= start + delay || ended; });
    canceled = cpu_seconds(clock);
    cancellation.cancel();
  });
  bool left = false;
  try {
    compute(cancellation);
  } catch (const Canceled&) {
    left = true;
  }
  const double stopped = cpu_seconds(clock);
  ended = true;
  canceler.join();
  return left ? std::optional(stopped - canceled) : std::nullopt;
}

}  // namespace transillum::testing
