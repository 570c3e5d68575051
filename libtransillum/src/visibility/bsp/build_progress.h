// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <functional>
#include <thread>

namespace transillum {

/// Reports the share of the work of building a tree that is done. Any thread may add work; only the
/// thread that constructed this reports, so that shares never decrease.
class BuildProgress {
 public:
  /// Work of sorting `polygons`: n times log2 n.
  static std::int64_t work(std::size_t polygons) {
    return static_cast<std::int64_t>(polygons) * std::bit_width(polygons);
  }

  /// @param report may be empty; not copied.
  BuildProgress(std::size_t polygons, const std::function<void(double)>& report)
      : total_(static_cast<double>(std::max<std::int64_t>(1, work(polygons)))), report_(report) {}

  void add(std::int64_t work) {
    const std::int64_t done = done_.fetch_add(work, std::memory_order_relaxed) + work;
    if (!report_ || std::this_thread::get_id() != thread_) {
      return;
    }
    const double share = std::min(1.0, static_cast<double>(done) / total_);
    if (share >= reported_ + least_step) {
      reported_ = share;
      report_(share);
    }
  }

 private:
  static constexpr double least_step = 0.005;
  const double total_;
  const std::function<void(double)>& report_;
  const std::thread::id thread_ = std::this_thread::get_id();
  std::atomic<std::int64_t> done_ = 0;
  double reported_ = 0;
};

}  // namespace transillum
