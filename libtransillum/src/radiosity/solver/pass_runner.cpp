// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/pass_runner.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <utility>
#include <vector>

#include "radiosity/tsan_scope.h"

namespace transillum {
namespace {

/// Stands for what has been done before the workers start: an address that they know without
/// reading anything.
constexpr char start_of_passes = 0;

}  // namespace

void PassRunner::run(int first, int last, const std::function<Pass(int)>& make,
                     const std::function<bool(int, Pass)>& absorb) const {
  std::atomic<bool> going{true};
  int next = first;
  // Passes under way have places that they take in turn: at most as many are let in, and they
  // leave in order, so a pass finds its place left by the one before it there.
  std::vector<Pass> under_way(static_cast<std::size_t>(2 * threads_));
  const auto place_of = [&](int k) {
    return &under_way[static_cast<std::size_t>(k) % under_way.size()];
  };
  const auto source = [&](tbb::flow_control& control) {
    tsan_acquire(&start_of_passes);
    const TsanScope turn(&next);
    if (next >= last || !going) {
      control.stop();
      return last;
    }
    const TsanScope handed_on(place_of(next));
    return next++;
  };
  const auto work = [&](int k) {
    tsan_acquire(&start_of_passes);
    const TsanScope turn(place_of(k));
    *place_of(k) = make(k);
    return k;
  };
  const auto sink = [&](int k) {
    tsan_acquire(&start_of_passes);
    const TsanScope turn(this), handed_on(place_of(k));
    if (!absorb(k, std::move(*place_of(k)))) {
      going = false;
    }
  };
  const auto conclude = [&] {
    tsan_acquire(&next);
    tsan_acquire(this);
    for (const Pass& place : under_way) {
      tsan_acquire(&place);
    }
  };
  // More threads than cores, where that is asked for, need the permission.
  const tbb::global_control permission(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(threads_));
  tbb::task_arena arena(threads_);
  const auto filters = tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, source) &
                       tbb::make_filter<int, int>(tbb::filter_mode::parallel, work) &
                       tbb::make_filter<int, void>(tbb::filter_mode::serial_in_order, sink);
  tsan_release(&start_of_passes);
  try {
    arena.execute([&] { tbb::parallel_pipeline(under_way.size(), filters); });
  } catch (...) {
    conclude();
    throw;
  }
  conclude();
}

}  // namespace transillum
