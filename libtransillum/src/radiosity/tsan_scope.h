// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Tells ThreadSanitizer what happens before what where the lock or the queue is inside TBB, which
// is not compiled with it: only what TBB promises, so that whatever else threads share is still
// reported as a race. Nothing in other builds; it locks nothing
// (decisions/0012-fuzzing-and-sanitizers.md).
#if defined(__SANITIZE_THREAD__)
#define TRANSILLUM_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TRANSILLUM_THREAD_SANITIZER
#endif
#endif

#ifdef TRANSILLUM_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace transillum {

/// What this thread has done is handed over at `place`, any address that stands for it.
inline void tsan_release([[maybe_unused]] const void* place) {
#ifdef TRANSILLUM_THREAD_SANITIZER
  __tsan_release(const_cast<void*>(place));
#endif
}

/// What was handed over at `place` has happened before what follows.
inline void tsan_acquire([[maybe_unused]] const void* place) {
#ifdef TRANSILLUM_THREAD_SANITIZER
  __tsan_acquire(const_cast<void*>(place));
#endif
}

/// Turns at one place do not overlap: each takes over from the one before.
class TsanScope {
 public:
  explicit TsanScope(const void* place) : place_(place) { tsan_acquire(place_); }
  ~TsanScope() { tsan_release(place_); }
  TsanScope(const TsanScope&) = delete;
  TsanScope& operator=(const TsanScope&) = delete;

 private:
  const void* place_;
};

}  // namespace transillum
