// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Annotations for ThreadSanitizer where the lock or queue is inside TBB, which is not compiled with
// it. They state only the order that TBB guarantees, so that other races are still reported. They
// lock nothing, and are empty in other builds (decisions/0012-fuzzing-and-sanitizers.md).
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

/// Releases what this thread has done so far at `place`, any address that represents it.
inline void tsan_release([[maybe_unused]] const void* place) {
#ifdef TRANSILLUM_THREAD_SANITIZER
  __tsan_release(const_cast<void*>(place));
#endif
}

/// Whatever was released at `place` happens before whatever follows.
inline void tsan_acquire([[maybe_unused]] const void* place) {
#ifdef TRANSILLUM_THREAD_SANITIZER
  __tsan_acquire(const_cast<void*>(place));
#endif
}

/// Scopes at one place do not overlap: each acquires what the one before released.
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
