// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/embree/picking.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "visibility/embree/embree_scene.h"

namespace transillum {

struct [[gnu::visibility("hidden")]] Picker::Impl {
  std::shared_ptr<const Scene> scene;
  EmbreeScene embree;

  Impl(std::shared_ptr<const Scene> picked, const Cancellation& cancellation)
      : scene(std::move(picked)), embree(*scene, cancellation) {}

  std::optional<PickedPoint> hit(const Vec3& origin, const Vec3& direction, bool lit_only) const {
    const Vec3 along = normalized(direction / max_abs(direction));
    // Start near the scene's ball: single precision has no digits to spare for the distance to it.
    const Vec3 far = embree.inside(origin);
    const double skipped = std::max(0.0, -dot(far, along) - 1.25);
    const Vec3 start = far + skipped * along;
    RTCRayHit ray = make_ray(start, along);
    embree.first_hit(ray, lit_only);
    if (!has_hit(ray)) {
      return std::nullopt;
    }

    PickedPoint picked;
    picked.patch = embree.patch_of(ray.hit.primID);
    const PatchId lit = embree.lit_at(picked.patch, start, along, ray.ray.tfar);
    picked.lit_side = lit != no_patch;
    if (picked.lit_side) {
      picked.patch = lit;
    }
    picked.distance = distance_to(picked.patch, origin, along,
                                  (skipped + static_cast<double>(ray.ray.tfar)) / embree.scale());
    picked.point = origin + picked.distance * along;
    return picked;
  }

  /// The distance along the ray to the plane of patch i, in double precision; `rough_distance` if
  /// the ray is nearly parallel to the plane.
  double distance_to(PatchId i, const Vec3& origin, const Vec3& along,
                     double rough_distance) const {
    constexpr double grazing = 1e-4;
    const Patch& patch = scene->patch(i);
    const double cosine = dot(patch.normal, along);
    if (std::abs(cosine) < grazing) {
      return rough_distance;
    }
    return std::max(0.0, dot(patch.normal, patch.center - origin) / cosine);
  }
};

Picker::Picker(std::shared_ptr<const Scene> scene, const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(std::move(scene), cancellation)) {}
const std::shared_ptr<const Scene>& Picker::scene() const { return impl_->scene; }
const EmbreeScene& Picker::embree() const { return impl_->embree; }
Picker::~Picker() = default;
Picker::Picker(Picker&&) noexcept = default;
Picker& Picker::operator=(Picker&&) noexcept = default;

std::optional<PickedPoint> Picker::first_hit(const Vec3& origin, const Vec3& direction) const {
  return impl_->hit(origin, direction, false);
}

std::optional<PickedPoint> Picker::first_lit_hit(const Vec3& origin, const Vec3& direction) const {
  return impl_->hit(origin, direction, true);
}

}  // namespace transillum
