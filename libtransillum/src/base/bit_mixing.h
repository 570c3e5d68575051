// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

namespace transillum {

/// The increment of splitmix64: numbers this far apart give unrelated bits when mixed.
inline constexpr std::uint64_t golden_step = 0x9e3779b97f4a7c15U;

/// Mixes the bits of x: a bijection of the 64-bit numbers (the finalizer of splitmix64).
inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace transillum
