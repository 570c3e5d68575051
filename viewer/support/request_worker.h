// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "support/thread_priority.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// What becomes of the work under way when something newer is asked for.
enum class UnderWay { given_up, goes_on };

/// A thread of its own that does what was asked for last.
///
/// Threads: its functions may be called by any; the work is done by its own. Where the work uses
/// members of its owner, they must outlive it: declare it last.
template <class Request>
class RequestWorker {
 public:
  /// `work` may throw Canceled, and nothing else.
  explicit RequestWorker(std::function<void(const Request&, const Cancellation&)> work)
      : work_(std::move(work)), thread_([this] { run(); }) {}
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

  /// Takes the place of what still waits.
  void request(Request request, UnderWay under_way = UnderWay::given_up) {
    {
      const std::lock_guard lock(mutex_);
      if (under_way == UnderWay::given_up) {
        cancellation_.cancel();
      }
      request_ = std::move(request);
    }
    wake_.notify_one();
  }
  /// Gives up what is under way, and what waits; returns the latter.
  std::optional<Request> clear() {
    const std::lock_guard lock(mutex_);
    cancellation_.cancel();
    return std::exchange(request_, std::nullopt);
  }

 private:
  void run() {
    give_way_to_the_window();
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return quit_ || request_; });
      if (quit_) {
        return;
      }
      const Request request = *std::exchange(request_, std::nullopt);
      cancellation_ = Cancellation();
      const Cancellation cancellation = cancellation_;
      lock.unlock();
      try {
        work_(request, cancellation);
      } catch (const Canceled&) {
        // Nobody waits for it any more.
      }
      lock.lock();
    }
  }

  const std::function<void(const Request&, const Cancellation&)> work_;
  std::mutex mutex_;  // guards all below but the thread
  std::condition_variable wake_;
  std::optional<Request> request_;
  bool quit_ = false;
  Cancellation cancellation_;
  std::thread thread_;
};

}  // namespace transillum::viewer
