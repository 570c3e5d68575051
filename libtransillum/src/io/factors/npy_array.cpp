// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// NumPy's format of arrays (numpy.lib.format): a mark, a version, the length of a head, the head as
// a Python dictionary {'descr': TYPE, 'fortran_order': BOOL, 'shape': TUPLE}, then the numbers.
#include "io/factors/npy_array.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <utility>

#include "base/text_file.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::string_view mark = "\x93NUMPY";
static_assert(std::endian::native == std::endian::little, "arrays are written in memory order");

/// The text after `'key':` in a dictionary, up to the next key or brace; empty if there is no such
/// key.
std::string_view value_of(std::string_view head, const std::string& key) {
  const std::string quoted = "'" + key + "':";
  const std::size_t at = head.find(quoted);
  if (at == std::string_view::npos) {
    return {};
  }
  std::string_view rest = trimmed(head.substr(at + quoted.size()));
  const std::size_t end = rest.starts_with("(") ? rest.find(')') : rest.find_first_of(",}");
  if (end == std::string_view::npos) {
    return {};
  }
  return trimmed(rest.substr(0, rest.starts_with("(") ? end + 1 : end));
}

}  // namespace

std::string npy_head(const std::string& type, const std::string& shape) {
  std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  constexpr std::size_t before = 10, alignment = 64;
  dictionary.append(alignment - 1 - (before + dictionary.size()) % alignment, ' ');
  dictionary += '\n';
  const auto length = static_cast<std::uint16_t>(dictionary.size());
  std::string head(mark);
  head += {'\x01', '\0', static_cast<char>(length & 0xff), static_cast<char>(length >> 8)};
  return head + dictionary;
}

NpyArray::NpyArray(std::string name, std::string bytes)
    : name_(std::move(name)), bytes_(std::move(bytes)) {
  constexpr std::size_t version_at = 6;
  if (!bytes_.starts_with(mark) || bytes_.size() < 12) {
    refuse("not an array of NumPy");
  }
  const bool first = bytes_[version_at] == 1;
  std::size_t length = 0;
  for (std::size_t k = first ? 2 : 4; k-- > 0;) {
    length = length << 8 | static_cast<unsigned char>(bytes_[version_at + 2 + k]);
  }
  begin_ = version_at + 2 + (first ? 2 : 4);
  if (length > bytes_.size() - begin_) {
    refuse("the head of the array is damaged");
  }
  read_head(std::string_view(bytes_).substr(begin_, length));
  begin_ += length;
  if (width_ == 0 || size_ != (bytes_.size() - begin_) / width_ ||
      size_ * width_ != bytes_.size() - begin_) {
    refuse(fmt::format("{} entries of type {} do not fill the array", size_, in_quotes(type_)));
  }
}

void NpyArray::refuse(const std::string& what) const { throw InputError(name_ + ": " + what); }

void NpyArray::read_head(std::string_view head) {
  type_ = unquoted(value_of(head, "descr"));
  const std::string_view digits =
      std::string_view(type_).substr(std::min<std::size_t>(type_.size(), 2));
  std::from_chars(digits.data(), digits.data() + digits.size(), width_);
  if (type_.size() < 3 || type_.size() > 8 || type_.front() == '>' || width_ == 0) {
    refuse(fmt::format("arrays of type {} are not read", in_quotes(type_)));
  }
  if (type_[1] == 'U') {
    width_ *= 4;
  }
  const std::string_view shape = value_of(head, "shape");
  if (shape == "()") {
    return;
  }
  std::string_view number = shape.size() > 2 ? shape.substr(1, shape.size() - 2) : shape;
  if (number.ends_with(",")) {
    number.remove_suffix(1);
  }
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), size_);
  if (shape.size() < 3 || error != std::errc() || end != number.data() + number.size()) {
    refuse(fmt::format("arrays of shape {} are not read", in_quotes(shape)));
  }
}

template <class Stored, class Value>
std::vector<Value> NpyArray::converted() const {
  std::vector<Value> values(size_);
  for (std::size_t k = 0; k < size_; ++k) {
    Stored value;
    std::memcpy(&value, bytes_.data() + begin_ + k * sizeof value, sizeof value);
    values[k] = static_cast<Value>(value);
  }
  return values;
}

std::vector<double> NpyArray::numbers() const {
  if (type_ == "<f8") {
    return converted<double, double>();
  }
  if (type_ == "<f4") {
    return converted<float, double>();
  }
  refuse(fmt::format("has type {}, not one of <f8 and <f4", in_quotes(type_)));
}

std::vector<std::int64_t> NpyArray::whole_numbers() const {
  if (type_ == "<i4") {
    return converted<std::int32_t, std::int64_t>();
  }
  if (type_ == "<i8") {
    return converted<std::int64_t, std::int64_t>();
  }
  refuse(fmt::format("has type {}, not one of <i4 and <i8", in_quotes(type_)));
}

std::string NpyArray::text() const {
  const bool wide = type_.starts_with("<U");
  if (size_ != 1 || (!wide && !type_.starts_with("|S"))) {
    refuse(fmt::format("has type {}, which is no text", in_quotes(type_)));
  }
  std::string text;
  for (std::size_t k = begin_; k < bytes_.size() && bytes_[k] != '\0'; k += wide ? 4 : 1) {
    text += bytes_[k];
  }
  return text;
}

}  // namespace transillum
