// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <unistd.h>

#include <cstdint>

namespace transillum {

/// Limit of kept form factors, or of a recorded map, bytes: `requested`, or if that is 0 a quarter
/// of the machine's memory.
inline std::uint64_t memory_limit(std::uint64_t requested) {
  if (requested > 0) {
    return requested;
  }
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE)) / 4;
}

/// Memory that this process can still take, bytes: the least of what the machine has available with
/// its swap space, what its control group allows, and its own limit of addresses (ulimit -v).
std::uint64_t free_memory();

/// Returns memory that this process has freed to the machine, after a large part of the work. The
/// allocator would keep it in the pools of threads. Takes milliseconds.
void return_freed_memory();

}  // namespace transillum
