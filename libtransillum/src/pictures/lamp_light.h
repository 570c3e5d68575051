// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "radiosity/sun_light.h"
#include "transillum/cancellation.h"
#include "transillum/solution.h"
#include "visibility/embree/embree_scene.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {

/// The fraction that a patch reflects, by its lobe too if the solve has lobes.
Rgb reflectance_of(const Solution& solution, PatchId patch);

/// The light of lamps and of the sun at points of surfaces: the visible part of each lamp in closed
/// form, the sun by rays toward it. Lamps are emitting faces: the most powerful, and where there
/// are many, those that are brighter than what reflects.
///
/// Threads: any number may query.
class LampLight {
 public:
  /// Keeps the scene of `solution` alive, and a reference to `embree`.
  /// @throws Canceled
  LampLight(const Solution& solution, const EmbreeScene& embree, const Cancellation& cancellation);

  /// The patches whose exitance it treats, ascending.
  const std::vector<PatchId>& patches() const { return patches_; }
  /// Number of emitting faces that are none of them, and their part of all power.
  int gathered_count() const { return gathered_count_; }
  double gathered_part() const { return gathered_part_; }
  /// Irradiance by all lamps and the sun at a point of a patch, W/m².
  /// @param x on the patch, m
  /// @throws Canceled
  Rgb at_point(PatchId patch, const Vec3& x, const Cancellation& cancellation) const;
  /// Called with a direction toward the sun and the irradiance that comes along it, W/m².
  using SunVisit = std::function<void(const Vec3& direction, const Rgb& irradiance)>;
  /// Visits the rays toward the sun that nothing blocks.
  /// @param x on the patch, m
  void visit_sun(PatchId patch, const Vec3& x, const SunVisit& visit) const;

 private:
  /// The view of one lamp from a patch.
  struct View {
    const LampPolygon* lamp;
    std::optional<PointView> shared;  ///< for all points; unset: blockers are found by point
  };
  using Views = std::vector<View>;
  using ViewsByPatch = std::unordered_map<PatchId, Views>;

  Views& views_of(PatchId patch, const Cancellation& cancellation) const;

  std::shared_ptr<const Scene> scene_;
  const EmbreeScene& embree_;
  Rgb sun_irradiance_;
  std::vector<SunRay> sun_rays_;  ///< empty without a sun
  ExchangeFinder finder_;
  std::vector<LampPolygon> lamps_;
  std::vector<PatchId> patches_;
  int gathered_count_ = 0;
  double gathered_part_ = 0;
  mutable oneapi::tbb::enumerable_thread_specific<ViewsByPatch> views_;
};

}  // namespace transillum
