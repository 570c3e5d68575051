// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/patch_forecast.h"

#include "scene/build/patch_count.h"

namespace transillum::viewer {

std::shared_ptr<const Scene> PatchForecast::unrefined(const Request& request,
                                                      const Cancellation& cancellation) {
  SceneOptions options = request.options;
  options.max_patch_area = 0;
  const auto fits = [&](const Scene& scene) {
    return scene.options().max_patch_area == 0 && scene.options().two_sided == options.two_sided;
  };
  if (fits(*request.loaded->scene)) {
    return request.loaded->scene;
  }
  if (!faces_ || counted_.lock() != request.loaded || !fits(*faces_)) {
    faces_ = std::make_shared<const Scene>(*request.loaded->description, options, cancellation);
    counted_ = request.loaded;
  }
  return faces_;
}

PatchForecast::Answer PatchForecast::operator()(const Request& request,
                                                const Cancellation& cancellation) {
  const auto faces = unrefined(request, cancellation);
  const double area = request.patches > 0
                          ? max_patch_area_for(*faces, request.patches, cancellation)
                          : request.options.max_patch_area;
  return {area > 0 ? count_patches(*faces, area) : faces->patch_count(), area};
}

}  // namespace transillum::viewer
