// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/patch_forecast.h"

#include <QMetaObject>

#include "scene/build/patch_count.h"

namespace transillum::viewer {

PatchForecast::PatchForecast(QObject* parent)
    : QObject(parent),
      worker_([this](const Request& request,
                     const Cancellation& cancellation) { count(request, cancellation); },
              [this](const Request&, const QString& message) {
                QMetaObject::invokeMethod(
                    this, [this, message] { emit failed(message); }, Qt::QueuedConnection);
              }) {}

void PatchForecast::request(std::shared_ptr<const LoadedScene> loaded,
                            const SceneOptions& options) {
  worker_.request({whole_of(loaded), options});
}

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

void PatchForecast::count(const Request& request, const Cancellation& cancellation) {
  const auto faces = unrefined(request, cancellation);
  const double area = request.options.max_patch_area;
  const std::int64_t patches = area > 0 ? count_patches(*faces, area) : faces->patch_count();
  QMetaObject::invokeMethod(
      this, [this, options = request.options, patches] { emit counted(options, patches); },
      Qt::QueuedConnection);
}

}  // namespace transillum::viewer
