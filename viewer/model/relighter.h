// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "model/patch_materials.h"
#include "support/request_worker.h"
#include "transillum/form_factors.h"
#include "transillum/relight.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// Solves with other materials and stored form factors, on its own thread; the newest request
/// replaces the waiting one, and the running one is finished.
///
/// Threads: the public functions and the signals belong to the thread that created it.
class Relighter : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const FormFactors> form_factors;
    std::shared_ptr<const DirectLight> shot;  ///< may be null
    std::shared_ptr<const PatchMaterials> materials;
    std::vector<Rgb> start;  ///< initial B, W/m², one per patch
    std::vector<Rgb> sky;    ///< light that the patches receive from the sky, W/m²; may be empty
    double tolerance = 1e-6;
  };

  explicit Relighter(QObject* parent = nullptr);

  void request(Request request);
  /// Cancels the running request, removes the waiting one and drops undelivered results.
  void clear();
  bool busy() const { return newest_ != delivered_; }

 signals:
  /// The solution with `materials`.
  void relit(std::shared_ptr<const transillum::RelightResult> light,
             std::shared_ptr<const transillum::viewer::PatchMaterials> materials);
  void failed(const QString& message);

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  void work(const Task& task, const Cancellation& cancellation);
  /// If `light` is null, the request failed with `error`.
  void deliver(const Task& task, const std::shared_ptr<const RelightResult>& light,
               const QString& error);

  quint64 newest_ = 0, delivered_ = 0;  // numbers of requests; used by the owner's thread only

  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
