// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <unistd.h>

#include <cstdint>

namespace transillum {

/// Bytes that kept form factors may take: `wanted`, or where that is 0 a quarter of the machine's.
inline std::uint64_t memory_limit(std::uint64_t wanted) {
  if (wanted > 0) {
    return wanted;
  }
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE)) / 4;
}

}  // namespace transillum
