// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <optional>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// What a ray meets.
struct PickedPoint {
  PatchId patch = no_patch;
  double distance = 0;  ///< from the ray's origin, meters
  Vec3 point;
  bool lit_side = false;  ///< met on the side that lights and receives
};

/// Finds patches along rays, by Embree.
///
/// Surfaces nearer to each other, or to the ray's origin, than 1e-5 of the scene's size may be
/// taken for one another. Memory and time to build grow with the number of patches, a query's time
/// with its logarithm. Threads: immutable, any number may ask.
class Picker {
 public:
  /// @throws Canceled
  explicit Picker(std::shared_ptr<const Scene> scene, const Cancellation& cancellation = {});
  ~Picker();
  Picker(Picker&&) noexcept;
  Picker& operator=(Picker&&) noexcept;

  /// What the ray meets first. Of coincident opposite patches it is the one lit on the ray's side.
  /// `direction`: of any length but 0.
  std::optional<PickedPoint> first_hit(const Vec3& origin, const Vec3& direction) const;
  /// The same, looking through patches from behind: what is seen of rooms from outside.
  std::optional<PickedPoint> first_lit_hit(const Vec3& origin, const Vec3& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace transillum
