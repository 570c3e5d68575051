// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <numbers>
#include <utility>

#include "base/for_each_index.h"
#include "radiosity/glossy/glossy_data.h"
#include "transillum/at.h"

namespace transillum {

Rgb GlossyLight::Data::shot_radiance(PatchId i) const {
  return 1 / std::numbers::pi * at(shot->exitance, i);
}

GlossyLight::GlossyLight(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

const Scene& GlossyLight::scene() const { return *data_->scene; }
const std::vector<Vec3>& GlossyLight::directions() const { return data_->directions; }
bool GlossyLight::is_glossy(PatchId i) const { return at(data_->index_of, i) >= 0; }

Vec3 GlossyLight::direction(PatchId i, int pass) const {
  const Vec3& omega = at(data_->directions, pass);
  return dot(omega, data_->scene->patch(i).normal) < 0 ? -omega : omega;
}

std::span<const Rgb> GlossyLight::arriving(PatchId i) const {
  const std::int32_t g = at(data_->index_of, i);
  if (g < 0) {
    return {};
  }
  const std::size_t passes = data_->passes();
  return {data_->arriving.data() + static_cast<std::size_t>(g) * passes, passes};
}

Rgb GlossyLight::leaving(PatchId i, int pass) const {
  const std::int32_t g = at(data_->index_of, i);
  const auto p = static_cast<std::size_t>(pass);
  const Rgb& lambertian = at(data_->lambertian[data_->replica_of(p)], i);
  const Rgb emitted = data_->shot ? data_->shot_radiance(i) : Rgb{};
  return emitted +
         (g < 0 ? lambertian
                : lambertian + data_->reflected[static_cast<std::size_t>(g) * data_->passes() + p]);
}

Rgb GlossyLight::sun_irradiance(PatchId i) const {
  Rgb sum;
  if (data_->rays && is_glossy(i)) {
    for (const ShotRay& ray : data_->rays->of(static_cast<std::size_t>(at(data_->index_of, i)))) {
      if (ray.source == data_->scene->patch_count()) {
        sum += ray.irradiance * at(data_->ray_sources, ray.source);
      }
    }
  }
  return sum;
}

Rgb GlossyLight::radiance(PatchId i, const Vec3& toward) const {
  if (!(dot(toward, data_->scene->patch(i).normal) > 0)) {
    return {};
  }
  const std::int32_t g = at(data_->index_of, i);
  Rgb sum;
  for (std::size_t r = 0; r < data_->replicas(); ++r) {
    Rgb radiance = at(data_->lambertian[r], i);
    if (g >= 0 && !data_->lobes.empty()) {
      const auto k = static_cast<std::size_t>(g);
      const Rgb* from = arriving(i).data() + data_->begin[r];
      radiance += data_->fractions[k] * data_->lobes[r]->reflected_toward(from, k, toward);
    }
    sum += radiance;
  }
  Rgb result = 1 / static_cast<double>(data_->replicas()) * sum;
  if (data_->shot) {
    result += data_->shot_radiance(i);
  }
  if (data_->rays && g >= 0 && !data_->lobes.empty()) {
    const auto k = static_cast<std::size_t>(g);
    result += data_->fractions[k] * data_->lobes.front()->reflected_toward(
                                        data_->rays->of(k), data_->ray_sources, k, toward);
  }
  return result;
}

std::vector<Rgb> GlossyLight::radiance_toward(const Vec3& eye, int threads) const {
  std::vector<Rgb> result(data_->index_of.size());
  WorkerThreads workers(thread_count(threads));
  for_each_index(workers, PatchId{0}, data_->scene->patch_count(), [&](PatchId i) {
    const Vec3 to_eye = eye - data_->scene->patch(i).center;
    const double distance = norm(to_eye);
    if (distance > 0) {
      at(result, i) = radiance(i, to_eye / distance);
    }
  });
  return result;
}

}  // namespace transillum
