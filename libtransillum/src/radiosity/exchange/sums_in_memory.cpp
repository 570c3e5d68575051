// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A TBB pipeline of three filters: number the passes, make them in parallel, add them in order.
#include "radiosity/exchange/sums_in_memory.h"

#include <oneapi/tbb/parallel_pipeline.h>

#include <atomic>
#include <utility>
#include <vector>

#include "base/tsan_scope.h"
#include "base/worker_threads.h"

namespace transillum {
namespace {

/// The passes under way. The pipeline admits at most as many as there are slots, and they leave in
/// order, so pass k finds its slot free.
class Slots {
 public:
  explicit Slots(std::size_t count) : passes_(count) {}
  std::size_t count() const { return passes_.size(); }
  Pass& of(int k) { return passes_[static_cast<std::size_t>(k) % passes_.size()]; }
  const std::vector<Pass>& all() const { return passes_; }

 private:
  std::vector<Pass> passes_;
};

/// Tells ThreadSanitizer the order that TBB's pipeline guarantees: each filter body is wrapped in
/// a function that acquires what was done before. Does nothing in other builds.
class PipelineOrder {
 public:
  explicit PipelineOrder(Slots& slots) : slots_(slots) {}

  /// Bodies of the source run one after the other, and a pass admitted takes over its slot.
  template <class Body>
  auto source(Body body, int last) {
    return [this, body, last](tbb::flow_control& control) {
      tsan_acquire(&start);
      const TsanScope serial(&source_);
      const int k = body(control);
      if (k < last) {
        const TsanScope slot(&slots_.of(k));
      }
      return k;
    };
  }
  /// Bodies for different passes run at the same time.
  template <class Body>
  auto parallel(Body body) {
    return [this, body](int k) {
      tsan_acquire(&start);
      const TsanScope slot(&slots_.of(k));
      body(k);
      return k;
    };
  }
  /// Bodies of the sink run one after the other.
  template <class Body>
  auto sink(Body body) {
    return [this, body](int k) {
      tsan_acquire(&start);
      const TsanScope serial(&sink_), slot(&slots_.of(k));
      body(k);
    };
  }
  /// Runs the pipeline; what its filters did has happened before this returns or throws.
  template <class Work>
  void around(Work run) {
    struct AtEnd {
      const PipelineOrder& order;
      ~AtEnd() { order.acquire_all(); }
    };
    tsan_release(&start);
    const AtEnd end{*this};
    run();
  }

 private:
  void acquire_all() const {
    tsan_acquire(&source_);
    tsan_acquire(&sink_);
    for (const Pass& pass : slots_.all()) {
      tsan_acquire(&pass);
    }
  }

  /// Stands for what is done before the workers start. Static: a worker must be able to name it
  /// before it has acquired anything.
  static constexpr char start = 0;

  Slots& slots_;
  char source_ = 0, sink_ = 0;  ///< addresses that represent the serial filters
};

/// Makes passes on several threads and adds them in order, until `add` returns false: passes under
/// way, at most two per thread, are still added. An exception of either is rethrown here, after the
/// passes before it have been added.
template <class Make, class Add>
void run_pipeline(const PassLoop& loop, const Make& make, const Add& add) {
  Slots slots(static_cast<std::size_t>(2 * loop.threads));
  PipelineOrder order(slots);
  std::atomic<bool> going{true};
  int next = loop.first;
  const auto next_pass = [&](tbb::flow_control& control) {
    if (next < loop.last && going) {
      return next++;
    }
    control.stop();
    return loop.last;
  };
  const auto make_pass = [&](int k) { slots.of(k) = make(k); };
  const auto add_pass = [&](int k) {
    if (!add(k, std::move(slots.of(k)))) {
      going = false;
    }
  };
  using enum tbb::filter_mode;
  const auto pipeline =
      tbb::make_filter<void, int>(serial_in_order, order.source(next_pass, loop.last)) &
      tbb::make_filter<int, int>(parallel, order.parallel(make_pass)) &
      tbb::make_filter<int, void>(serial_in_order, order.sink(add_pass));
  WorkerThreads workers(loop.threads);
  order.around(
      [&] { workers.arena().execute([&] { tbb::parallel_pipeline(slots.count(), pipeline); }); });
}

}  // namespace

bool SumsInMemory::run(const PassLoop& loop) {
  bool going = true;
  const auto make = [&loop](int k) {
    Pass pass = loop.make(k);
    loop.prepare(k, pass);
    return pass;
  };
  const auto add = [&](int k, Pass pass) {
    loop.add(k, std::move(pass));
    loop.settle();
    if (!loop.observe(k)) {
      going = false;
    }
    return going;
  };
  if (loop.last - loop.first == 1) {
    add(loop.first, make(loop.first));
  } else {
    run_pipeline(loop, make, add);
  }
  return going;
}

const std::shared_ptr<PatchSums>& sums_in_memory() {
  static const std::shared_ptr<PatchSums> sums = std::make_shared<SumsInMemory>();
  return sums;
}

}  // namespace transillum
