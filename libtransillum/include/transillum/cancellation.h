// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <memory>

#include "transillum/errors.h"

namespace transillum {

/// A wish to stop, shared by all copies. Sticky: once set it stays set.
///
/// Threads: any thread may set or read any copy at any time. All that may take long, be it the
/// reading of a file, the building of a tree, a pass or the sums over passes, looks at it at least
/// every 50 ms and then throws Canceled.
class Cancellation {
 public:
  void cancel() const { flag_->store(true, std::memory_order_relaxed); }
  bool canceled() const { return flag_->load(std::memory_order_relaxed); }
  void throw_if_canceled() const {
    if (canceled()) {
      throw Canceled();
    }
  }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace transillum
