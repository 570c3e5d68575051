// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "radiosity/tsan_scope.h"

namespace transillum {

/// Calls `body` for each index of [first, end), by the threads of `arena`, in any order; what is
/// done before happens before all of it, and all of it before what follows.
template <class Index, class Body>
void for_each_index(oneapi::tbb::task_arena& arena, Index first, Index end, const Body& body) {
  // Not captured: what is captured has to be taken over first.
  static const char start = 0, done = 0;
  // Also where `body` throws.
  struct AtEnd {
    void (*tell)(const void*);
    const void* place;
    ~AtEnd() { tell(place); }
  };
  const AtEnd all{tsan_acquire, &done};
  const auto visit = [&](Index i) {
    tsan_acquire(&start);
    const AtEnd one{tsan_release, &done};
    body(i);
  };
  tsan_release(&start);
  arena.execute([&] { oneapi::tbb::parallel_for(first, end, visit); });
}

}  // namespace transillum
