// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// In a file of its own, as Boost asks: its MD5 reads the bytes of other types as integers, which
// must not be inlined where these are written.
#include "io/content_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <boost/uuid/detail/md5.hpp>
#include <cstring>
#include <span>

namespace transillum {
namespace {

constexpr std::string_view xxh3_name = "xxh3-";

std::string hexadecimal(std::span<const unsigned char> bytes) {
  std::string text;
  for (const unsigned char byte : bytes) {
    text += fmt::format("{:02x}", byte);
  }
  return text;
}

}  // namespace

struct ContentHash::State {
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> xxh3{nullptr, XXH3_freeState};
  boost::uuids::detail::md5 md5;
};

ContentHash::ContentHash(Method method) : state_(std::make_unique<State>()) {
  if (method == Method::xxh3) {
    state_->xxh3.reset(XXH3_createState());
    XXH3_128bits_reset(state_->xxh3.get());
  }
}
ContentHash::~ContentHash() = default;

ContentHash::Method ContentHash::method_of(std::string_view digits) {
  return digits.starts_with(xxh3_name) ? Method::xxh3 : Method::md5;
}

void ContentHash::append(const void* data, std::size_t size) {
  if (state_->xxh3) {
    XXH3_128bits_update(state_->xxh3.get(), data, size);
  } else {
    state_->md5.process_bytes(data, size);
  }
}

std::string ContentHash::digits() {
  if (state_->xxh3) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->xxh3.get()));
    return std::string(xxh3_name) + hexadecimal(canonical.digest);
  }
  boost::uuids::detail::md5::digest_type digest;
  state_->md5.get_digest(digest);
  std::array<unsigned char, sizeof digest> bytes{};
  std::memcpy(bytes.data(), &digest, sizeof digest);
  return hexadecimal(bytes);
}

}  // namespace transillum
