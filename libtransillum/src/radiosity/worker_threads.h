// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace transillum {

/// `requested` threads, or the number of cores if that is 0.
inline int thread_count(int requested) {
  return requested > 0 ? requested : oneapi::tbb::info::default_concurrency();
}

/// An arena of exactly `count` threads, also where these are more than the cores, to which TBB
/// limits itself unless permitted more.
class WorkerThreads {
 public:
  explicit WorkerThreads(int count)
      : permission_(oneapi::tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(count)),
        arena_(count) {}
  oneapi::tbb::task_arena& arena() { return arena_; }

 private:
  oneapi::tbb::global_control permission_;
  oneapi::tbb::task_arena arena_;
};

}  // namespace transillum
