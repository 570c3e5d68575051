// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <time.h>

#include <cmath>
#include <memory>
#include <vector>

#include "transillum/scene.h"

namespace transillum::benchmarks {

inline double seconds_on(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds that `work` takes by a clock: CLOCK_THREAD_CPUTIME_ID for the CPU time of one core,
/// CLOCK_MONOTONIC for wall time.
template <class Work>
double seconds_of(clockid_t clock, Work&& work) {
  const double start = seconds_on(clock);
  work();
  return seconds_on(clock) - start;
}

/// Directions that are not the first points of any sequence, so that none is along an axis.
std::vector<Vec3> some_directions(int count);

/// Slope of log y over log x by least squares.
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace transillum::benchmarks
