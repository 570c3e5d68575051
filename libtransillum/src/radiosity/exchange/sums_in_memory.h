// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/patch_sums.h"

namespace transillum {

/// The sums of all patches in this process, which makes the passes on several threads.
class SumsInMemory : public PatchSums {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  /// A single pass is made on the thread that calls.
  bool run(const PassLoop& loop) override;
  void complete(std::span<double> /*values*/, PatchId /*patches*/) override {}
  void maxima(std::span<double> /*values*/) override {}
  void sums(std::span<std::int64_t> /*values*/) override {}
  void gather(std::span<const std::byte> bytes,
              const std::function<void(std::span<const std::byte>)>& take) override {
    take(bytes);
  }
  void check_same(std::span<const double> /*values*/) override {}
};

/// The one that solvers use by default. It has no state, so any number of them may.
const std::shared_ptr<PatchSums>& sums_in_memory();

}  // namespace transillum
