// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <string>
#include <utility>

namespace transillum {

/// Formats text into memory and writes it to a stream in large blocks, since streams are slow on
/// small pieces. The destructor writes the rest.
class TextBuffer {
 public:
  explicit TextBuffer(std::ostream& out) : out_(out) {}
  ~TextBuffer() { flush(); }
  TextBuffer(const TextBuffer&) = delete;
  TextBuffer& operator=(const TextBuffer&) = delete;

  template <typename... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() > 1U << 16) {
      flush();
    }
  }

 private:
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::ostream& out_;
  fmt::memory_buffer buffer_;
};

/// `text` as valid UTF-8: invalid bytes become U+FFFD, control characters become blanks. For names
/// of files, scenes and materials, which may contain any bytes.
std::string clean_text(const std::string& text);

/// clean_text() with &, <, > and " escaped, for XML content and attributes.
std::string xml_text(const std::string& text);

}  // namespace transillum
