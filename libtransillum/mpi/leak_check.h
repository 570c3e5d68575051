// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Leaks in builds with AddressSanitizer. Open MPI keeps some memory of modules that it unloads,
// when it starts and in MPI_Finalize(); of those, a report at the end of the program could not say
// whose they are. What it keeps besides is named in tests/lsan.supp.

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace transillum::mpi {

#ifdef __SANITIZE_ADDRESS__
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
