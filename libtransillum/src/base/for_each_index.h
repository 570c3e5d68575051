// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include "base/tsan_scope.h"
#include "base/worker_threads.h"

namespace transillum {

/// Calls body(i) for each i of [first, end) on the threads of `workers`, in any order. What
/// precedes the call happens before every body, and every body before what follows. Rethrows what a
/// body throws.
template <class Index, class Body>
void for_each_index(WorkerThreads& workers, Index first, Index end, const Body& body) {
  // Static, not captured: a worker must acquire before it reads anything captured.
  static const char start = 0, done = 0;
  // In a destructor, so that it also runs where `body` throws.
  struct AtEnd {
    void (*annotate)(const void*);
    const void* place;
    ~AtEnd() { annotate(place); }
  };
  const AtEnd all{tsan_acquire, &done};
  const auto visit = [&](Index i) {
    tsan_acquire(&start);
    const AtEnd one{tsan_release, &done};
    body(i);
  };
  tsan_release(&start);
  workers.arena().execute([&] { oneapi::tbb::parallel_for(first, end, visit); });
}

}  // namespace transillum
