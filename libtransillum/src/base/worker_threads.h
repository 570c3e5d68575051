// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <cstddef>
#include <deque>
#include <exception>
#include <memory>
#include <new>
#include <thread>

namespace transillum {

/// `requested` threads, or the number of cores if that is 0.
inline int thread_count(int requested) {
  return requested > 0 ? requested : oneapi::tbb::info::default_concurrency();
}

/// An arena of `count` threads, also where these are more than the cores: the one that calls
/// arena().execute(), and others started here. If the system refuses to start some, half of those
/// that started do the work. TBB's own threads would end the program then: they start each other,
/// so that no caller could catch the error.
class WorkerThreads {
 public:
  explicit WorkerThreads(int count) : arena_(count, static_cast<unsigned>(count)) {
    try {
      for (int k = 1; k < count; ++k) {
        workers_.emplace_back(arena_);
      }
    } catch (const std::exception&) {
      // No more threads, mostly for want of memory: leave some for the work.
      for (std::size_t excess = workers_.size() - workers_.size() / 2; excess > 0; --excess) {
        workers_.pop_back();
      }
    }
  }
  oneapi::tbb::task_arena& arena() { return arena_; }

 private:
  /// A thread that executes tasks of the arena until the destructor begins.
  class Worker {
   public:
    explicit Worker(oneapi::tbb::task_arena& arena)
        : end_(pending_task()), thread_([this, &arena] { take_part(arena); }) {}
    ~Worker() {
      end_ = {};
      thread_.join();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

   private:
    oneapi::tbb::task_handle pending_task() {
      try {
        return group_->defer([] {});
      } catch (const std::bad_alloc&) {
        (void)group_.release();  // its destructor would wait for the task
        throw;
      }
    }
    void take_part(oneapi::tbb::task_arena& arena) noexcept {
      try {
        arena.execute([this] { group_->wait(); });
      } catch (const std::exception&) {
        // No memory to take part. Errors of tasks reach the caller that waits for them.
      }
    }

    std::unique_ptr<oneapi::tbb::task_group> group_ = std::make_unique<oneapi::tbb::task_group>();
    oneapi::tbb::task_handle end_;  ///< a task that never runs; group_ waits until it is destroyed
    std::thread thread_;
  };

  oneapi::tbb::task_arena arena_;  ///< all places are for these threads, none for TBB's own
  std::deque<Worker> workers_;
};

}  // namespace transillum
