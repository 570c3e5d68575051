// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/relighter.h"

#include <QMetaObject>
#include <utility>

namespace transillum::viewer {

Relighter::Relighter(QObject* parent)
    : QObject(parent),
      worker_(
          [this](const Task& task, const Cancellation& cancellation) { work(task, cancellation); },
          [this](const Task& task, const QString& message) { deliver(task, nullptr, message); }) {}

void Relighter::request(Request request) {
  // While a slider is dragged, a late picture is better than none.
  worker_.request({std::move(request), ++newest_}, CurrentJob::finish);
}

void Relighter::clear() {
  worker_.clear();
  delivered_ = newest_;
}

// On the worker's thread.
void Relighter::work(const Task& task, const Cancellation& cancellation) {
  const Request& request = task.request;
  RelightOptions options;
  options.tolerance = request.tolerance;
  options.start = request.start;
  options.sky_irradiance = request.sky;
  options.shot = request.shot.get();
  options.patch_materials = request.materials->of_patch;
  deliver(task,
          std::make_shared<const RelightResult>(relight(*request.scene, *request.form_factors,
                                                        request.materials->materials, options,
                                                        cancellation)),
          {});
}

// Runs on the worker's thread; what it posts runs on the owner's thread.
void Relighter::deliver(const Task& task, const std::shared_ptr<const RelightResult>& light,
                        const QString& error) {
  const auto emit_result = [this, light, error, number = task.number,
                            materials = task.request.materials] {
    if (number <= delivered_) {
      return;  // cleared since
    }
    delivered_ = number;
    if (light) {
      emit relit(light, materials);
    } else {
      emit failed(error);
    }
  };
  QMetaObject::invokeMethod(this, emit_result, Qt::QueuedConnection);
}

}  // namespace transillum::viewer
