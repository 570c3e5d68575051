// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <utility>

#include "base/for_each_index.h"
#include "radiosity/glossy/glossy_data.h"
#include "transillum/at.h"

namespace transillum {

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
  const Rgb& lambertian = at(data_->lambertian, i);
  return g < 0 ? lambertian
               : lambertian + data_->reflected[static_cast<std::size_t>(g) * data_->passes() +
                                               static_cast<std::size_t>(pass)];
}

Rgb GlossyLight::radiance(PatchId i, const Vec3& toward) const {
  if (!(dot(toward, data_->scene->patch(i).normal) > 0)) {
    return {};
  }
  const std::int32_t g = at(data_->index_of, i);
  const Rgb& lambertian = at(data_->lambertian, i);
  if (g < 0 || data_->lobes == nullptr) {
    return lambertian;
  }
  const auto k = static_cast<std::size_t>(g);
  return lambertian +
         data_->fractions[k] * data_->lobes->reflected_toward(arriving(i).data(), k, toward);
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
