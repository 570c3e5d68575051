// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <optional>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

class EmbreeScene;

/// The first intersection of a ray with the scene.
struct PickedPoint {
  PatchId patch = no_patch;  ///< the patch hit
  double distance = 0;       ///< from the ray's origin, m
  Vec3 point;                ///< the intersection, m
  bool lit_side = false;     ///< the front side was hit, which emits and receives
};

/// Finds patches along rays.
///
/// Surfaces closer to each other, or to the ray's origin, than 1e-5 of the scene's size may be
/// confused. Memory and construction time grow with the number of patches, query time with its
/// logarithm. Threads: immutable; any number may query.
class Picker {
 public:
  /// Builds the acceleration structure; keeps `scene` alive.
  /// @throws Canceled
  explicit Picker(std::shared_ptr<const Scene> scene, const Cancellation& cancellation = {});
  ~Picker();
  /// The moved-from object may only be destroyed or assigned to.
  Picker(Picker&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  Picker& operator=(Picker&&) noexcept;

  /// The first hit on either side of a patch. Of two coincident opposite patches it is the one
  /// whose front side faces the ray.
  /// @param origin m.
  /// @param direction of any length but 0.
  /// @returns nothing if the ray hits no patch.
  std::optional<PickedPoint> first_hit(const Vec3& origin, const Vec3& direction) const;
  /// The first hit on a front side; back sides are transparent, as when a room is seen from
  /// outside.
  std::optional<PickedPoint> first_lit_hit(const Vec3& origin, const Vec3& direction) const;

  /// The scene that rays meet.
  const std::shared_ptr<const Scene>& scene() const;
  /// The structure that the picker asks, for other rays in the same scene; lives as long as it.
  const EmbreeScene& embree() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace transillum
