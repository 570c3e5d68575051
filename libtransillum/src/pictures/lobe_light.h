// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pictures/gathered_light.h"
#include "transillum/glossy.h"

namespace transillum {

/// The light that the lobes of a glossy solve reflect toward a point, gathered by rays about the
/// mirror direction.
///
/// Threads: immutable once built.
class LobeLight {
 public:
  /// @param rays from each point.
  /// @throws Canceled
  LobeLight(const Scene& scene, const GatheredLight& gathered, int rays,
            const Cancellation& cancellation);

  /// pi times the radiance that the lobe of a patch sends from x, W/m²; 0 without a lobe.
  /// @param toward unit, away from the surface
  /// @param variant one of many sequences of rays; any number
  Rgb at_point(PatchId patch, const Vec3& x, const Vec3& toward, std::uint64_t variant) const;

 private:
  struct Used {
    Lobe lobe;
    std::unique_ptr<LobeFunction> function;
  };

  const Scene& scene_;
  const GatheredLight& gathered_;
  int rays_;
  std::vector<Used> lobes_;  ///< by material; no function: no lobe
};

}  // namespace transillum
