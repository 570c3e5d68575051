// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "pictures/lamp_light.h"
#include "pictures/plane_points.h"
#include "transillum/linear_basis.h"
#include "transillum/solution.h"

namespace transillum {

/// The radiosity of a solution at points that rays meet. To the functions of the solution, which
/// are constant or linear, it adds how the light of lamps differs from them within a patch: a
/// quadratic function through exact values. To constants it also adds the slope of the other light,
/// by the patches around it. Neither changes what the patch sends as a whole.
///
/// Threads: any number may query; a value does not depend on the order of queries.
class HitLight {
 public:
  /// Keeps references to all.
  HitLight(const Solution& solution, const PlanePoints& points, const LampLight& lamps);
  ~HitLight();
  HitLight(const HitLight&) = delete;
  HitLight& operator=(const HitLight&) = delete;

  /// B without the exitance of lamps, W/m².
  /// @param x on the patch, m
  Rgb at_point(PatchId patch, const Vec3& x) const;
  /// The exitance of a lamp, W/m²; 0 if the patch is none that LampLight treats.
  Rgb exitance(PatchId patch) const;
  /// The fraction that a patch reflects, by its lobe too if the solve has lobes.
  Rgb reflectance(PatchId patch) const;

 private:
  /// The light of lamps on a patch as a quadratic function of the basis.
  struct DirectLight;

  /// How light that is not of lamps changes along the functions of the basis.
  struct Slope {
    Rgb first, second;
  };

  template <class Value, class Make>
  const Value& kept(std::atomic<const Value*>& place, Make make) const;
  const DirectLight& direct_on(PatchId patch) const;
  const Slope& slope_on(PatchId patch) const;
  Slope slope_by_neighbors(PatchId patch) const;
  Rgb rest_on(PatchId patch) const;
  std::unique_ptr<const DirectLight> fitted(PatchId patch) const;

  const Solution& solution_;
  const Scene& scene_;
  const PlanePoints& points_;
  const LampLight& lamps_;
  std::vector<std::uint8_t> is_lamp_;
  std::vector<LinearBasis> bases_;
  mutable std::vector<std::atomic<const DirectLight*>> direct_;  ///< by patch; null means unknown
  mutable std::vector<std::atomic<const Slope*>> slopes_;        ///< likewise
};

}  // namespace transillum
