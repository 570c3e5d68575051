// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

namespace transillum {

/// Memory that this process can still take, bytes: the least of what the machine has available with
/// its swap space, what its control group allows, and its own limit of addresses (ulimit -v).
std::uint64_t free_memory();

}  // namespace transillum
