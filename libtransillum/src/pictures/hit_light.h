// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/kept.h"
#include "pictures/lamp_light.h"
#include "pictures/plane_points.h"
#include "transillum/linear_basis.h"
#include "transillum/solution.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {

/// The radiosity of a solution at points that rays meet. To the functions of the solution, which
/// are constant or linear, it adds how the light of sources differs from them within a patch: a
/// quadratic function through values at points, of lamps exact ones. To constants it also adds the
/// slope of the other light, by the patches around it. Neither changes what the patch sends as a
/// whole.
///
/// Threads: any number may query; a value does not depend on the order of queries.
class HitLight {
 public:
  /// Keeps references to all.
  HitLight(const Solution& solution, const EmbreeScene& embree, const PlanePoints& points,
           const LampLight& lamps);
  ~HitLight();
  HitLight(const HitLight&) = delete;
  HitLight& operator=(const HitLight&) = delete;

  /// B without the exitance of lamps, W/m².
  /// @param x on the patch, m
  /// @throws Canceled
  Rgb at_point(PatchId patch, const Vec3& x, const Cancellation& cancellation) const;
  /// The exitance of a lamp, W/m²; 0 if the patch is none that LampLight treats.
  Rgb exitance(PatchId patch) const;

 private:
  struct PatchLight;

  /// How light that is not of lamps changes along the functions of the basis.
  struct Slope {
    Rgb first, second;
  };

  Rgb mean_on(PatchId patch) const;
  bool is_open(PatchId patch, const Vec3& x) const;
  Rgb sources_at(PatchId patch, const Vec3& x, const Cancellation& cancellation) const;
  bool is_partly_open(PatchId patch) const;
  const PatchLight& light_on(PatchId patch, const Cancellation& cancellation) const;
  std::unique_ptr<const PatchLight> light_of(PatchId patch, const Cancellation& cancellation) const;
  Slope slope_by_neighbors(PatchId patch, const Cancellation& cancellation) const;
  Rgb rest_on(PatchId patch, const Cancellation& cancellation) const;

  const Solution& solution_;
  const Scene& scene_;
  const EmbreeScene& embree_;
  const PlanePoints& points_;
  const LampLight& lamps_;
  bool has_gathered_sources_;
  std::vector<std::uint8_t> is_lamp_;
  std::vector<LinearBasis> bases_;
  std::vector<Kept<PatchLight>> light_;  ///< by patch
  std::vector<Kept<Slope>> slopes_;      ///< by patch
};

}  // namespace transillum
