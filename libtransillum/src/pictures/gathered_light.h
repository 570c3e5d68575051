// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pictures/hit_light.h"
#include "pictures/surface_rays.h"
#include "transillum/solution.h"

namespace transillum {

/// The light of a solution that rays from points of its surfaces meet: B of what they hit, without
/// the exitance of lamps, and the sky.
///
/// Threads: immutable once built.
class GatheredLight {
 public:
  /// Keeps references to all but the last.
  /// @param rays to gather by, from each point.
  GatheredLight(const Solution& solution, const EmbreeScene& embree, const HitLight& light,
                int rays);

  /// The light that a point receives.
  struct Gathered {
    Rgb irradiance;  ///< W/m²
    double noise;    ///< half the difference of what two halves of the rays give, W/m²; the
                     ///< largest of the channels
  };
  /// @param x on a surface, m
  /// @param normal unit
  /// @param salt names one of many sequences of rays (`Salt`)
  /// @throws Canceled
  Gathered at_point(const Vec3& x, const Vec3& normal, std::uint64_t salt,
                    const Cancellation& cancellation) const;

  /// The light of a ray.
  struct Arriving {
    Rgb light;     ///< pi times its radiance without the exitance of a lamp, W/m²
    PatchId lamp;  ///< the lamp that is met, or no_patch
    Vec3 place;    ///< where a surface is met, m
  };
  /// @param direction unit
  /// @throws Canceled
  Arriving arriving(const Vec3& x, const Vec3& normal, const Vec3& direction,
                    const Cancellation& cancellation) const;

 private:
  Rgb brought(const Met& met, const Vec3& direction, const Cancellation& cancellation) const;
  Rgb brought(const Vec3& start, std::span<const Vec3> directions,
              const Cancellation& cancellation) const;

  const Solution& solution_;
  const Scene& scene_;
  const HitLight& light_;
  const EmbreeScene& embree_;
  /// Directions about +z, by the cosine, in two sets each.
  std::vector<std::array<std::vector<Vec3>, 2>> tables_;
};

}  // namespace transillum
