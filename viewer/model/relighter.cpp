// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/relighter.h"

#include <QMetaObject>
#include <utility>

#include "transillum/errors.h"

namespace transillum::viewer {

Relighter::Relighter(QObject* parent)
    : QObject(parent), worker_([this](const Task& task, const Cancellation& cancellation) {
        work(task, cancellation);
      }) {}

void Relighter::request(Request request) {
  // What is under way goes on: while a slider is drawn, a late picture is better than none.
  worker_.request({std::move(request), ++asked_}, UnderWay::goes_on);
}

void Relighter::clear() {
  worker_.clear();
  delivered_ = asked_;
}

void Relighter::work(const Task& task, const Cancellation& cancellation) {
  const Request& request = task.request;
  std::shared_ptr<const Relit> light;
  QString error;
  try {
    RelightOptions options;
    options.tolerance = request.tolerance;
    options.start = request.start;
    options.shot = request.shot.get();
    light = std::make_shared<const Relit>(
        relight(*request.scene, *request.form_factors, request.materials, options, cancellation));
  } catch (const Canceled&) {
    // Nobody waits for it any more.
  } catch (const std::exception& failure) {
    error = QString::fromUtf8(failure.what());
  }
  QMetaObject::invokeMethod(
      this,
      [this, light, error, number = task.number, materials = request.materials] {
        if (number <= delivered_) {
          return;  // cleared since
        }
        delivered_ = number;
        if (light) {
          emit relit(light, materials);
        }
        if (!error.isEmpty()) {
          emit failed(error);
        }
      },
      Qt::QueuedConnection);
}

}  // namespace transillum::viewer
