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

/// What `work` takes on a clock: CLOCK_THREAD_CPUTIME_ID for one core whatever else is running,
/// CLOCK_MONOTONIC for the wall.
template <class Work>
double seconds_of(clockid_t clock, Work&& work) {
  const double start = seconds_on(clock);
  work();
  return seconds_on(clock) - start;
}

/// Directions that are no sequence's first points, so that no scene is seen along its axes.
std::vector<Vec3> some_directions(int count);

/// The slope of log y over log x, least squares.
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace transillum::benchmarks
