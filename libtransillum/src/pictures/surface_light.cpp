// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "pictures/gathered_light.h"
#include "pictures/hit_light.h"
#include "pictures/interpolated_light.h"
#include "pictures/lamp_light.h"
#include "pictures/light_by_picker.h"
#include "pictures/lobe_light.h"
#include "transillum/picture.h"
#include "visibility/embree/picking.h"

namespace transillum {
namespace {

/// Rays of the points between which light is interpolated.
int interpolated_rays(const Scene& scene) {
  return scene.patch_count() < 10000 ? 2048 : scene.patch_count() < 50000 ? 1024 : 512;
}

constexpr int least_lobe_rays = 64;

}  // namespace

struct [[gnu::visibility("hidden")]] SurfaceLight::Impl {
  std::shared_ptr<const Solution> solution;
  const Scene& scene;
  bool is_interpolated;
  std::shared_ptr<const Picker> picker;
  const EmbreeScene& embree;
  PlanePoints points;
  LampLight lamps;
  HitLight hits;
  GatheredLight gathered;
  InterpolatedLight interpolated;
  std::optional<LobeLight> lobes;

  Impl(std::shared_ptr<const Solution> shown, int gather, const Cancellation& cancellation,
       std::shared_ptr<const Picker> asked)
      : solution(std::move(shown)),
        scene(*solution->scene),
        is_interpolated(gather == 0),
        picker(std::move(asked)),
        embree(picker->embree()),
        points(scene, cancellation),
        lamps(*solution, embree, cancellation),
        hits(*solution, embree, points, lamps),
        gathered(*solution, embree, hits, gather > 0 ? gather : interpolated_rays(scene)),
        interpolated(scene, points, gathered, lamps) {
    if (solution->glossy) {
      lobes.emplace(scene, gathered, lamps, std::max(gather, least_lobe_rays), cancellation);
    }
  }

  struct Query {
    const Cancellation& cancellation;
    std::uint64_t salt = 0;
    Interpolation precision = {};
  };
  Rgb irradiance(PatchId patch, const Vec3& x, const Query& query) const {
    return lamps.at_point(patch, x, query.cancellation) +
           (is_interpolated
                ? interpolated.at_point(patch, x, query.precision, query.cancellation)
                : gathered.at_point(x, scene.patch(patch).normal, query.salt, query.cancellation)
                      .irradiance);
  }
  /// E and what `reflectance` makes of H.
  Rgb radiosity(PatchId patch, const Vec3& x, const Rgb& reflectance, const Query& query) const {
    return max_abs(reflectance) == 0
               ? scene.exitance(patch)
               : scene.exitance(patch) + reflectance * irradiance(patch, x, query);
  }
};

SurfaceLight::SurfaceLight(std::shared_ptr<const Solution> solution, int gather,
                           const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(solution, gather, cancellation,
                                   std::make_shared<const Picker>(solution->scene, cancellation))) {
}
SurfaceLight::SurfaceLight(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SurfaceLight::~SurfaceLight() = default;
SurfaceLight::SurfaceLight(SurfaceLight&&) noexcept = default;
SurfaceLight& SurfaceLight::operator=(SurfaceLight&&) noexcept = default;

SurfaceLight LightByPicker::light(std::shared_ptr<const Solution> solution,
                                  std::shared_ptr<const Picker> picker,
                                  const Cancellation& cancellation) {
  return SurfaceLight(std::make_unique<SurfaceLight::Impl>(std::move(solution), 0, cancellation,
                                                           std::move(picker)));
}

Rgb SurfaceLight::radiosity(PatchId patch, const Vec3& point, const Cancellation& cancellation,
                            const Interpolation& precision) const {
  return impl_->radiosity(patch, point, reflectance_of(*impl_->solution, patch),
                          {cancellation, 0, precision});
}

Rgb SurfaceLight::direct_irradiance(PatchId patch, const Vec3& point,
                                    const Cancellation& cancellation) const {
  return impl_->lamps.at_point(patch, point, cancellation);
}

Rgb SurfaceLight::radiance(const Vec3& origin, const Vec3& direction, std::uint64_t salt,
                           const Cancellation& cancellation) const {
  const Vec3 along = normalized(direction);
  const auto hit = impl_->picker->first_lit_hit(origin, along);
  const Sky& sky = impl_->solution->sky;
  Rgb light;
  if (hit) {
    light = impl_->radiosity(hit->patch, hit->point, impl_->scene.reflectance(hit->patch),
                             {cancellation, salt});
    if (impl_->lobes) {
      light += impl_->lobes->at_point(hit->patch, hit->point, -along, salt, cancellation);
    }
  } else if (sky.is_set()) {
    light = sky.relative_radiance(along) * sky.exitance;
  }
  return 1 / std::numbers::pi * light;
}

Rgb SurfaceLight::irradiance(const Vec3& origin, const Vec3& direction, std::uint64_t salt,
                             const Cancellation& cancellation) const {
  const auto hit = impl_->picker->first_lit_hit(origin, direction);
  return hit ? impl_->irradiance(hit->patch, hit->point, {cancellation, salt}) : Rgb();
}

bool SurfaceLight::meets_surface(const Vec3& origin, const Vec3& direction) const {
  return impl_->picker->first_lit_hit(origin, normalized(direction)).has_value();
}

int SurfaceLight::gathered_lamps() const { return impl_->lamps.gathered_count(); }

}  // namespace transillum
