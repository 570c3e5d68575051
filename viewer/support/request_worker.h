// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A worker thread that computes the newest of its requests: base of all background jobs of the
// window except the solver.
#pragma once

#include <QString>
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "support/failure_text.h"
#include "support/thread_priority.h"
#include "transillum/cancellation.h"
#include "transillum/errors.h"

namespace transillum::viewer {

/// The effect of a new request on the job that is running.
enum class CurrentJob { cancel, finish };

/// When the job of a request begins: as soon as the worker is free, or only after the pause.
enum class Start { at_once, after_pause };

/// The pause between the end of a job and a request with Start::after_pause: the longer of the two.
struct Pause {
  std::chrono::milliseconds shortest{0};
  int job_times = 0;  ///< multiples of the last job's duration
};

/// A thread that runs a job for the newest request; requests that have not begun are replaced.
///
/// Threads: the public functions may be called from any thread; the job and the failure handler run
/// on the worker's own thread. The members of the owner that they use must outlive the worker:
/// declare the worker last.
template <class Request>
class RequestWorker {
 public:
  /// May throw anything; Canceled ends it without a message.
  using Job = std::function<void(const Request&, const Cancellation&)>;
  /// Called on the worker's thread with the request whose job threw, and a message for the user.
  using FailureHandler = std::function<void(const Request&, const QString& message)>;

  RequestWorker(Job job, FailureHandler failed, Pause pause = {})
      : job_(std::move(job)),
        failed_(std::move(failed)),
        pause_(pause),
        thread_([this] { run(); }) {}
  /// Cancels the running job and waits for it.
  ~RequestWorker() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
      cancellation_.cancel();
    }
    wake_.notify_one();
    thread_.join();
  }
  RequestWorker(const RequestWorker&) = delete;
  RequestWorker& operator=(const RequestWorker&) = delete;

  /// Replaces the waiting request, if any.
  void request(Request request, CurrentJob current = CurrentJob::cancel,
               Start start = Start::at_once) {
    {
      const std::lock_guard lock(mutex_);
      if (current == CurrentJob::cancel) {
        cancellation_.cancel();
      }
      waiting_ = std::move(request);
      start_ = start;
    }
    wake_.notify_one();
  }
  /// Cancels the running job and removes the waiting request, which is returned.
  std::optional<Request> clear() {
    const std::lock_guard lock(mutex_);
    cancellation_.cancel();
    return std::exchange(waiting_, std::nullopt);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void run() {
    lower_thread_priority();
    Clock::time_point pause_end = Clock::now();
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return quit_ || waiting_; });
      // A newer request may replace the waiting one during the pause.
      wake_.wait_until(lock, pause_end,
                       [this] { return quit_ || (waiting_ && start_ == Start::at_once); });
      if (quit_) {
        return;
      }
      if (!waiting_) {
        continue;  // cleared during the pause
      }
      const Request request = *std::exchange(waiting_, std::nullopt);
      const Clock::time_point begin = Clock::now();
      run_job(request, lock);
      const Clock::time_point end = Clock::now();
      pause_end =
          end + std::max<Clock::duration>(pause_.shortest, pause_.job_times * (end - begin));
    }
  }

  /// Runs the job without holding the lock. Throws nothing.
  void run_job(const Request& request, std::unique_lock<std::mutex>& lock) {
    try {
      try {
        cancellation_ = Cancellation();
        const Cancellation cancellation = cancellation_;
        lock.unlock();
        job_(request, cancellation);
      } catch (const Canceled&) {
        // The requester no longer needs the result.
      } catch (...) {
        if (lock.owns_lock()) {
          lock.unlock();
        }
        failed_(request, current_failure_text());
      }
    } catch (...) {
      // No memory for the message either: the next request may succeed.
    }
    if (!lock.owns_lock()) {
      lock.lock();
    }
  }

  const Job job_;
  const FailureHandler failed_;
  const Pause pause_;
  std::mutex mutex_;  // guards all below except the thread
  std::condition_variable wake_;
  std::optional<Request> waiting_;
  Start start_ = Start::at_once;  // start of waiting_
  bool quit_ = false;
  Cancellation cancellation_;
  std::thread thread_;
};

}  // namespace transillum::viewer
