// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Benchmarks, not tests: they print ratios and exponents within one run, since absolute times
// depend on the machine. Build and run:
//
//   cmake --preset release -DTRANSILLUM_BUILD_BENCHMARKS=ON
//   cmake --build build/release --target transillum_benchmarks
//   build/release/bin/transillum_benchmarks --benchmark_filter=Lines     (seconds)
//   build/release/bin/transillum_benchmarks --benchmark_filter=Accuracy  (minutes)
//   build/release/bin/transillum_benchmarks --benchmark_filter=Scaling   (minutes)
//   build/release/bin/transillum_benchmarks --benchmark_filter=Imperfect (a minute)
//   build/release/bin/transillum_benchmarks --benchmark_filter=Threads   (seconds; idle cores)
//
//   Lines     one pass of the fast engine on the sphere flake compared with 10 parallel lines per
//             patch with all their hits, traced by Embree in the fastest way found; prints
//             `lines ratio`
//   Accuracy  seconds on one core to an RMS error of B, on five scenes: passes compared with
//             cosine-weighted rays by Embree and with engine pairs, and the ratios;
//             TRANSILLUM_BENCHMARK_PLOT=FILE.svg draws the runs
//   Scaling   milliseconds per pass on increasingly fine scenes, and the fitted exponent;
//             TRANSILLUM_BENCHMARK_HUGE=1 adds a flake of a million patches
//   Imperfect sorting and a pass on scenes as files have them, against the flake in the same run
//   Threads   wall time of a solve on one thread over that on two
//
// Comparisons of one core measure CPU time, so other load on the machine has little effect.
#include <benchmark/benchmark.h>

#include "measure.h"
#include "transillum/directions.h"

namespace transillum::benchmarks {

std::vector<Vec3> some_directions(int count) {
  std::vector<Vec3> directions;
  for (const auto& sample : make_directions(Sampling::random, count, 77)) {
    directions.push_back(sample.direction);
  }
  return directions;
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double a = std::log(x[k]), b = std::log(y[k]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace transillum::benchmarks

BENCHMARK_MAIN();
