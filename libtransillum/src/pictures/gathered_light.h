// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/linear_basis.h"
#include "transillum/solution.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {

/// Two vectors that make a right-handed frame with a unit normal.
struct TangentFrame {
  explicit TangentFrame(const Vec3& normal);
  Vec3 turned(const Vec3& local) const { return local.x * u + local.y * v + local.z * w; }

  Vec3 u, v, w;
};

/// The light of a solution that rays from points of its surfaces meet: B of what they hit, without
/// the exitance of lamps, and the sky.
///
/// Threads: immutable once built.
class GatheredLight {
 public:
  /// Keeps `solution` alive.
  /// @param lamps patches whose exitance is not gathered, ascending
  /// @param rays to gather by, from each point.
  /// @throws Canceled
  GatheredLight(std::shared_ptr<const Solution> solution, const std::vector<PatchId>& lamps,
                int rays, const Cancellation& cancellation);

  /// What a point receives.
  struct Gathered {
    Rgb irradiance;       ///< W/m²
    double distance = 0;  ///< harmonic mean of the distances of what the rays hit, m
  };
  /// @param x on a surface, m
  /// @param normal unit
  /// @param variant one of many sequences of rays; any number
  Gathered at_point(const Vec3& x, const Vec3& normal, std::uint64_t variant) const;

  /// pi times the radiance that arrives at x against `direction`, lamps included, W/m².
  /// @param direction unit
  Rgb arriving(const Vec3& x, const Vec3& normal, const Vec3& direction) const;

  int rays() const { return rays_; }

 private:
  struct Met {
    PatchId patch = no_patch;  ///< no_patch: nothing is met
    bool is_lit = false;
    double distance = 0;  ///< m
    Vec3 point;           ///< m
  };
  Met meet(const Vec3& start, const Vec3& direction) const;
  Vec3 start_of(const Vec3& x, const Vec3& normal) const;
  Rgb leaving(const Met& met) const;

  std::shared_ptr<const Solution> solution_;
  const Scene& scene_;
  EmbreeScene embree_;
  int rays_;
  std::vector<Rgb> means_;  ///< B without the exitance of lamps
  std::vector<std::uint8_t> is_lamp_;
  std::vector<LinearTerm> terms_;  ///< of B
  std::vector<LinearBasis> bases_;
  std::vector<std::vector<Vec3>> tables_;  ///< directions about +z, by the cosine
};

}  // namespace transillum
