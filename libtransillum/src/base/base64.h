// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/dataflow_exception.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cstddef>
#include <span>
#include <string>

namespace transillum {

/// The bytes of a string in base64, padded.
inline std::string to_base64(const std::string& bytes) {
  using namespace boost::archive::iterators;
  // The end of an incomplete quadruple is read from the zero behind the string.
  using Letters = base64_from_binary<transform_width<const char*, 6, 8>>;
  std::string text(Letters(bytes.data()), Letters(bytes.data() + bytes.size()));
  text.append((3 - bytes.size() % 3) % 3, '=');
  return text;
}

/// Decodes as many bytes as there is room for.
/// @param letters at least 4/3 of it
/// @returns false where one of them is none of base64, or padding comes earlier
inline bool from_base64(std::span<const char> letters, std::span<unsigned char> bytes) {
  using namespace boost::archive::iterators;
  using Bytes = transform_width<binary_from_base64<const char*>, 8, 6>;
  const std::size_t needed = (8 * bytes.size() + 5) / 6;
  if (needed > letters.size() ||
      std::find(letters.begin(), letters.begin() + static_cast<std::ptrdiff_t>(needed), '=') !=
          letters.begin() + static_cast<std::ptrdiff_t>(needed)) {
    return false;
  }
  try {
    std::copy_n(Bytes(letters.data()), bytes.size(), bytes.begin());
  } catch (const dataflow_exception&) {
    return false;
  }
  return true;
}

}  // namespace transillum
