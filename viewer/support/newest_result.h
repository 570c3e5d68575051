// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QMetaObject>
#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "support/request_worker.h"

namespace transillum::viewer {

/// Computes results on a thread of its own and delivers them to the owner's thread. A newer request
/// replaces the waiting one. With CurrentJob::cancel, only the newest request is answered; with
/// CurrentJob::finish, the job that is running is finished and its result delivered as well.
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

  NewestResult(QObject& owner, Job job, Deliver deliver, CurrentJob current = CurrentJob::cancel,
               Pause pause = {})
      : owner_(owner),
        deliver_(std::move(deliver)),
        current_(current),
        worker_(
            [this, job = std::move(job)](const Task& task, const Cancellation& cancellation) {
              post(task, std::make_shared<const Result>(job(task.request, cancellation)), {});
            },
            [this](const Task& task, const QString& error) { post(task, nullptr, error); }, pause) {
  }

  void request(Request request, Start start = Start::at_once) {
    worker_.request({std::move(request), ++newest_}, current_, start);
  }
  /// Cancels the running job, removes the waiting request and drops undelivered results.
  void clear() {
    worker_.clear();
    delivered_ = ++newest_;
  }
  /// Whether the newest request has not been delivered yet.
  bool busy() const { return newest_ != delivered_; }

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  // Runs on the worker's thread; what it posts runs on the owner's thread.
  void post(const Task& task, std::shared_ptr<const Result> result, const QString& error) {
    const auto deliver = [this, task, result = std::move(result), error] {
      if (task.number == newest_ || (current_ == CurrentJob::finish && task.number > delivered_)) {
        delivered_ = task.number;
        deliver_(task.request, result, error);
      }
    };
    QMetaObject::invokeMethod(&owner_, deliver, Qt::QueuedConnection);
  }

  QObject& owner_;
  const Deliver deliver_;
  const CurrentJob current_;
  quint64 newest_ = 0, delivered_ = 0;  // numbers of requests; used by the owner's thread only
  RequestWorker<Task> worker_;
};

/// Keeps what NewestResult delivers until the next result or failure arrives.
template <class Request, class Result>
class KeptResult {
 public:
  /// @param changed  called when result() or error() has changed
  KeptResult(QObject& owner, typename NewestResult<Request, Result>::Job job,
             std::function<void()> changed, CurrentJob current)
      : results_(
            owner, std::move(job),
            [this, changed = std::move(changed)](
                const Request&, std::shared_ptr<const Result> result, const QString& error) {
              result_ = std::move(result);
              error_ = error;
              changed();
            },
            current) {}

  /// Nothing happens if it is the request of the last call.
  void request(const Request& request) {
    if (requested_ != request) {
      requested_ = request;
      results_.request(request);
    }
  }
  /// Releases the request and its result; a computation that runs is canceled.
  void clear() {
    results_.clear();
    requested_.reset();
    result_ = nullptr;
    error_.clear();
  }
  /// Clears unless it is the request of the last call. Returns whether there was another.
  bool clear_unless(const Request& request) {
    const bool other = requested_ && requested_ != request;
    if (other) {
      clear();
    }
    return other;
  }
  /// The newest result, which may belong to an older request; null if none has been computed or
  /// the last request failed.
  std::shared_ptr<const Result> result() const { return result_; }
  /// Why the last request failed; empty while the next is computed.
  QString error() const { return busy() ? QString() : error_; }
  bool busy() const { return results_.busy(); }

 private:
  std::optional<Request> requested_;
  std::shared_ptr<const Result> result_;
  QString error_;
  NewestResult<Request, Result> results_;
};

}  // namespace transillum::viewer
