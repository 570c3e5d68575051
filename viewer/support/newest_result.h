// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QMetaObject>
#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <utility>

#include "support/request_worker.h"

namespace transillum::viewer {

/// Computes results on a thread of its own and delivers the result of the newest request to the
/// owner's thread. Results of requests that have been replaced or cleared are dropped.
///
/// Threads: the functions belong to the owner's thread. What the job uses must outlive this object:
/// declare it last.
template <class Request, class Result>
class NewestResult {
 public:
  using Job = std::function<Result(const Request&, const Cancellation&)>;
  /// If the job failed, `result` is null and `error` has a message for the user.
  using Deliver = std::function<void(const Request&, std::shared_ptr<const Result> result,
                                     const QString& error)>;

  NewestResult(QObject& owner, Job job, Deliver deliver)
      : owner_(owner),
        deliver_(std::move(deliver)),
        worker_(
            [this, job = std::move(job)](const Task& task, const Cancellation& cancellation) {
              post(task, std::make_shared<const Result>(job(task.request, cancellation)), {});
            },
            [this](const Task& task, const QString& error) { post(task, nullptr, error); }) {}

  void request(Request request) {
    worker_.request({std::move(request), ++newest_});
    busy_ = true;
  }
  void clear() {
    worker_.clear();
    ++newest_;
    busy_ = false;
  }
  /// Whether the newest request has not been delivered yet.
  bool busy() const { return busy_; }

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  // Runs on the worker's thread; what it posts runs on the owner's thread.
  void post(const Task& task, std::shared_ptr<const Result> result, const QString& error) {
    const auto deliver = [this, task, result = std::move(result), error] {
      if (task.number == newest_) {
        busy_ = false;
        deliver_(task.request, result, error);
      }
    };
    QMetaObject::invokeMethod(&owner_, deliver, Qt::QueuedConnection);
  }

  QObject& owner_;
  const Deliver deliver_;
  quint64 newest_ = 0;  // used by the owner's thread only
  bool busy_ = false;
  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
