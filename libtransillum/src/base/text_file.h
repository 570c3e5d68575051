// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Text files and their lines: reading a whole file, its lines, words and numbers, and a stream that
// filters lines before a parser gets them.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "transillum/cancellation.h"

namespace transillum {

/// Largest file of a scene accepted, in bytes.
inline constexpr std::uintmax_t largest_scene_file = std::uintmax_t{1} << 30;

/// The bytes of a file.
/// @throws InputError if it is missing, not a regular file, unreadable or larger than `limit` bytes
std::string read_binary_file(const std::filesystem::path& path, std::uintmax_t limit);

/// The text of a file.
/// @throws InputError if it is missing, not a regular file, unreadable, larger than `limit` bytes,
/// or binary.
std::string read_text_file(const std::filesystem::path& path, std::uintmax_t limit);

/// `text` in backquotes for a message: control characters replaced, at most 40 bytes.
std::string in_quotes(std::string_view text);
/// Without leading and trailing blanks.
std::string_view trimmed(std::string_view text);
/// Without a pair of quotes, " or ', around it.
std::string_view unquoted(std::string_view text);
/// With A to Z as a to z; other letters stay.
std::string lower_case(std::string_view text);
/// The extension in lower case: `.csv` of `RESULT.CSV`.
std::string lower_case_ending(const std::filesystem::path& path);
/// The words between blanks, the first `most` of them.
void split_words(std::string_view text, std::vector<std::string_view>& words,
                 std::size_t most = std::string_view::npos);

/// The double nearest to a decimal number, in any locale: infinity beyond the range of double, also
/// "nan" and "inf". Empty if `word` is not a number.
std::optional<double> parse_number(std::string_view word);

/// A logical line of a file: lines joined by a backslash at the end are treated as one.
struct TextLine {
  std::int32_t number = 0;  ///< number of its first physical line, from 1
  std::string_view keyword;
  std::string_view rest;  ///< trimmed
};

/// The logical lines of a text, without comments, empty lines and a byte order mark. Time and
/// memory are linear in the text, however its lines are joined.
class LineReader {
 public:
  LineReader(std::string_view text, const Cancellation& cancellation);

  /// The next line, valid until the next call; empty at the end of the text.
  /// @throws Canceled
  std::optional<TextLine> next();

 private:
  bool join_physical_lines();
  std::string_view physical_line();

  std::string_view text_;
  const Cancellation& cancellation_;
  std::size_t position_ = 0;
  std::int32_t lines_read_ = 0;
  std::int32_t line_number_ = 0;
  std::string line_;
};

/// A stream buffer that passes a text to a parser one line at a time. Every line goes through a
/// filter before it is parsed, and the parser's callbacks refer to the line passed last.
class LineFeed : public std::streambuf {
 public:
  /// Inspects a line; returns whether to pass it to the parser.
  using Filter = std::function<bool(const TextLine&)>;

  LineFeed(std::string_view text, Filter filter, const Cancellation& cancellation);

 protected:
  int_type underflow() override;

 private:
  LineReader lines_;
  Filter filter_;
  std::string passed_;
};

}  // namespace transillum
