// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <memory>

#include "transillum/errors.h"
#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// A cancellation flag shared by all copies. Sticky: once set, it stays set.
///
/// Threads: any thread may set or read any copy at any time. Every long operation (reading a file,
/// building a tree, a pass, summing passes) checks the flag at least every 50 ms and then throws
/// Canceled.
class Cancellation {
 public:
  /// Sets the flag of this copy and all others.
  void cancel() const { flag_->store(true, std::memory_order_relaxed); }
  /// Whether the flag is set.
  bool canceled() const { return flag_->load(std::memory_order_relaxed); }
  /// @throws Canceled if the flag is set.
  void throw_if_canceled() const {
    if (canceled()) {
      throw Canceled();
    }
  }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace TRANSILLUM_API transillum
