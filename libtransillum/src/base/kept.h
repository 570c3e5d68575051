// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <memory>

namespace transillum {

/// A value that is made when it is first asked for, and kept.
///
/// Threads: any number may ask. Several may make the value at once; one of theirs is kept, so that
/// it must not depend on who makes it.
template <class Value>
class Kept {
 public:
  Kept() = default;
  ~Kept() { delete value_.load(std::memory_order_acquire); }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  /// The value, which make() returns as a std::unique_ptr if it is unknown.
  template <class Make>
  const Value& get(const Make& make) const {
    if (const Value* const known = value_.load(std::memory_order_acquire)) {
      return *known;
    }
    std::unique_ptr<const Value> made = make();
    const Value* expected = nullptr;
    return value_.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)
               ? *made.release()
               : *expected;
  }

 private:
  mutable std::atomic<const Value*> value_{nullptr};  ///< null means unknown
};

}  // namespace transillum
