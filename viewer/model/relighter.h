// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "support/request_worker.h"
#include "transillum/form_factors.h"
#include "transillum/relight.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// Finds the light of other materials from kept form factors, on a thread of its own; the newest
/// request wins.
///
/// Threads: the public functions and the signals belong to the thread that made it.
class Relighter : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const FormFactors> form_factors;
    std::shared_ptr<const DirectLight> shot;  ///< may be null
    std::vector<Material> materials;
    std::vector<Rgb> start;  ///< B to start from
    double tolerance = 1e-6;
  };

  explicit Relighter(QObject* parent = nullptr);

  void request(Request request);
  /// Gives up what is under way and what waits.
  void clear();
  bool busy() const { return asked_ != delivered_; }

 signals:
  /// Of `materials`.
  void relit(std::shared_ptr<const transillum::Relit> light,
             std::vector<transillum::Material> materials);
  void failed(const QString& message);

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  void work(const Task& task, const Cancellation& cancellation);

  quint64 asked_ = 0, delivered_ = 0;  // the window's own

  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
