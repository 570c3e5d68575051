// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// In a file of its own, as Boost asks: its MD5 reads the bytes of other types as integers, which
// must not be inlined where these are written.
#include "io/content_hash.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

namespace transillum {

void ContentHash::append(const void* data, std::size_t size) { md5_.process_bytes(data, size); }

std::string ContentHash::digits() {
  boost::uuids::detail::md5::digest_type digest;
  md5_.get_digest(digest);
  std::array<unsigned char, sizeof digest> bytes{};
  std::memcpy(bytes.data(), &digest, sizeof digest);
  std::string text;
  for (const unsigned char byte : bytes) {
    text += fmt::format("{:02x}", byte);
  }
  return text;
}

}  // namespace transillum
