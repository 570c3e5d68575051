// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/for_each_index.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/form_factors.h"

namespace transillum {

/// Pairs of j and F_ij > 0 of one row i, by rising j.
using FormFactorRow = std::vector<std::pair<PatchId, double>>;

struct RowGathering {
  PatchId rows;
  int threads;           ///< 0: one per processor
  PatchId batch;         ///< rows per thread between reports of progress
  std::uint64_t memory;  ///< limit of the matrix, bytes
};

/// The matrix row by row.
/// @param make_worker called once per thread; its result's gather(i) returns row i, a pure function
/// of i.
/// @throws Canceled, MemoryLimitExceeded
template <class MakeWorker>
FormFactors gather_rows(const RowGathering& gathering, MakeWorker make_worker,
                        const Cancellation& cancellation,
                        const std::function<void(double)>& progress) {
  const auto [patches, requested_threads, batch, memory] = gathering;
  const int threads = thread_count(requested_threads);
  WorkerThreads worker_threads(threads);
  oneapi::tbb::enumerable_thread_specific<decltype(make_worker())> workers(make_worker);
  FormFactors form_factors;
  form_factors.row_begin.push_back(0);
  std::vector<FormFactorRow> rows(static_cast<std::size_t>(batch * threads));
  for (PatchId first = 0; first < patches; first += batch * threads) {
    const PatchId end = std::min(first + batch * threads, patches);
    for_each_index(worker_threads, first, end, [&](PatchId i) {
      cancellation.throw_if_canceled();
      at(rows, i - first) = workers.local().gather(i);
    });
    for (PatchId i = first; i < end; ++i) {
      for (const auto& [source, value] : at(rows, i - first)) {
        form_factors.source.push_back(source);
        form_factors.value.push_back(value);
      }
      form_factors.row_begin.push_back(form_factors.size());
    }
    if (form_factors.size() * (sizeof(PatchId) + sizeof(double)) > memory) {
      throw MemoryLimitExceeded("the form factors exceed the memory limit");
    }
    if (progress) {
      progress(static_cast<double>(end) / patches);
    }
  }
  return form_factors;
}

}  // namespace transillum
