// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>

namespace transillum::fuzz {

/// Reads an input byte by byte; zeros after its end.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  bool empty() const { return next_ >= bytes_.size(); }
  unsigned byte() { return empty() ? 0u : bytes_[next_++]; }
  /// A whole number from 0 to count - 1, count <= 256.
  unsigned below(unsigned count) { return byte() % count; }
  bool flag() { return (byte() & 1u) != 0; }
  /// In [0,1), with 32 bits. Most values are not sums of few powers of two, so results computed
  /// from them are rounded.
  double fraction() {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) {
      bits = bits << 8 | byte();
    }
    return bits * 0x1p-32;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

}  // namespace transillum::fuzz
