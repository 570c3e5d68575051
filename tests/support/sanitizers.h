// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Which sanitizers a test is built with: GCC defines macros, clang has features.
#ifdef __has_feature
#define TRANSILLUM_HAS_FEATURE(name) __has_feature(name)
#else
#define TRANSILLUM_HAS_FEATURE(name) 0
#endif

namespace transillum::testing {

#if defined(__SANITIZE_ADDRESS__) || TRANSILLUM_HAS_FEATURE(address_sanitizer)
constexpr bool has_address_sanitizer = true;
#else
constexpr bool has_address_sanitizer = false;
#endif

#if defined(__SANITIZE_THREAD__) || TRANSILLUM_HAS_FEATURE(thread_sanitizer)
constexpr bool has_thread_sanitizer = true;
#else
constexpr bool has_thread_sanitizer = false;
#endif

}  // namespace transillum::testing
