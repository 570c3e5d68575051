// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Leaks in builds with AddressSanitizer. Open MPI keeps some memory of modules that it unloads,
// when it starts and in MPI_Finalize(); of those, a report at the end of the program could not say
// whose they are. What it keeps besides is named in tests/lsan.supp.

#if defined(__SANITIZE_ADDRESS__)
#define TRANSILLUM_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TRANSILLUM_ADDRESS_SANITIZER
#endif
#endif

#ifdef TRANSILLUM_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>
#endif

namespace transillum::mpi {

#ifdef TRANSILLUM_ADDRESS_SANITIZER
/// Allocations of this thread, as long as it lives, are not ours.
using AllocationsOfMpi = __lsan::ScopedDisabler;
/// Ends the process if something has leaked until now; later, nothing is checked.
inline void check_leaks() { __lsan_do_leak_check(); }
#else
struct AllocationsOfMpi {
  AllocationsOfMpi() {}
  ~AllocationsOfMpi() {}
};
inline void check_leaks() {}
#endif

}  // namespace transillum::mpi
