// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pictures/gathered_light.h"
#include "pictures/lamp_light.h"
#include "transillum/glossy.h"

namespace transillum {

/// The light that the lobes of a glossy solve reflect toward a point: by rays that the lobe
/// distributes, of lamps also by rays to points of theirs, and of the sun by rays toward it.
///
/// Threads: immutable once built.
class LobeLight {
 public:
  /// @param lamps the lamps and sun of GatheredLight.
  /// @param rays from each point.
  /// @throws Canceled
  LobeLight(const Scene& scene, const GatheredLight& gathered, const LampLight& lamps, int rays,
            const Cancellation& cancellation);

  /// pi times the radiance that the lobe of a patch sends from x, W/m²; 0 without a lobe.
  /// @param toward unit, away from the surface
  /// @param salt names one of many sequences of rays
  /// @throws Canceled
  Rgb at_point(PatchId patch, const Vec3& x, const Vec3& toward, std::uint64_t salt,
               const Cancellation& cancellation) const;

 private:
  struct Used {
    Lobe lobe;
    std::unique_ptr<LobeFunction> function;
  };
  struct Query;
  struct LampTriangle {
    Vec3 corner, first, second;  ///< edges from the corner, m
    double end;                  ///< power of it and all before, W
  };
  double weight_of(const Query& query, const Vec3& direction, PatchId lamp,
                   const Vec3& place) const;
  Rgb by_lobe(const Query& query, double u, double v) const;
  Rgb by_lamps(const Query& query, double u, double v) const;

  const Scene& scene_;
  const GatheredLight& gathered_;
  const LampLight& lamp_light_;
  int rays_, lamp_rays_ = 0;
  std::vector<Used> lobes_;  ///< by material; no function: no lobe
  std::vector<LampTriangle> lamps_;
};

}  // namespace transillum
