// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/simd_backend.h"

#include <cmath>

namespace transillum {

void recompute_far_lines(Cutter& cutter, const GridPoint* corners, const GridPoint& origin,
                         double far) {
  using Wide = long double;
  for (std::size_t k = 0; k < cutter.count; ++k) {
    if (!(std::abs(cutter.x[k]) + std::abs(cutter.y[k]) > far)) {
      continue;
    }
    const GridPoint &a = corners[k], &b = corners[k + 1 < cutter.count ? k + 1 : 0];
    cutter.c[k] =
        static_cast<double>(static_cast<Wide>(b.y - a.y) * static_cast<Wide>(a.x - origin.x) -
                            static_cast<Wide>(b.x - a.x) * static_cast<Wide>(a.y - origin.y));
  }
}

namespace {

const SimdBackend& widest() {
  static const SimdBackend backend = simd_backends().front();
  return backend;
}

}  // namespace

void set_cutter(Cutter& cutter, const GridPoint* corners, std::size_t count,
                const GridPoint& origin, double far) {
  widest().set(cutter, corners, count, origin, far);
}

bool cut_boundary(const BoundarySegments& region, const Cutter& cutter, BoundaryCut& cut,
                  BoundarySegments& outside) {
  return widest().cut(region, cutter, cut, outside);
}

Extent extent_of(const BoundarySegments& region) { return widest().extent(region); }

std::vector<SimdBackend> simd_backends() {
  std::vector<SimdBackend> backends;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    backends.push_back(avx512_backend());
  }
  if (__builtin_cpu_supports("avx2")) {
    backends.push_back(avx2_backend());
  }
#endif
  backends.push_back(scalar_backend());
  return backends;
}

}  // namespace transillum
