// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "transillum/cancellation.h"

namespace transillum {

/// Largest scene file (OBJ or MTL) that is read, in bytes.
inline constexpr std::uintmax_t largest_scene_file = std::uintmax_t{1} << 30;

/// The text of a file.
/// @throws InputError where it is missing, no plain file, unreadable, larger than `limit` bytes,
/// or binary.
std::string read_text_file(const std::filesystem::path& path, std::uintmax_t limit);

/// The text that a message quotes: no control characters, not too long.
std::string in_quotes(std::string_view text);
/// Without blanks at either end.
std::string_view trimmed(std::string_view text);
/// The words between blanks.
void split_words(std::string_view text, std::vector<std::string_view>& words);

/// The nearest double to a decimal number, also "nan" and "inf"; nothing where it is no number.
std::optional<double> parse_number(std::string_view word);

/// A line of a file: continued lines (a backslash at the end) are one.
struct TextLine {
  std::int32_t number = 0;  ///< of its first line, from 1
  std::string_view keyword;
  std::string_view rest;  ///< trimmed
};

/// Hands the lines of a text to a parser one at a time, so that what the parser calls back about
/// belongs to the line that was handed out last, and every line is looked at before it is parsed.
class LineFeed : public std::streambuf {
 public:
  /// Looks at a line; returns whether the parser shall see it.
  using Look = std::function<bool(const TextLine&)>;

  LineFeed(std::string_view text, Look look, const Cancellation& cancellation);

 protected:
  int_type underflow() override;

 private:
  /// The next logical line, without its end; false at the end of the text.
  bool next_line();

  std::string_view text_;
  Look look_;
  const Cancellation& cancellation_;
  std::size_t position_ = 0;
  std::int32_t lines_read_ = 0;
  std::int32_t line_number_ = 0;
  std::string line_;
};

}  // namespace transillum
