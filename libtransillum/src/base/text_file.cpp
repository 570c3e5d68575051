// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "base/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::string_view blanks = " \t\v\f";
constexpr std::size_t bytes_between_cancellation_checks = std::size_t{1} << 20;
constexpr std::int64_t longest_shift = std::int64_t{1} << 60;  ///< exponent; no mantissa is longer

bool has_name_argument(std::string_view keyword) {
  return keyword == "usemtl" || keyword == "newmtl" || keyword == "mtllib";
}

/// Whether |x| >= 1, where x is a decimal number that may be out of the range of double.
bool is_at_least_one(std::string_view word) {
  const std::size_t mantissa_end = std::min(word.find_first_of("eE"), word.size());
  const std::string_view mantissa = word.substr(0, mantissa_end);
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) {
    return false;
  }
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto place = static_cast<std::int64_t>(first);
  // |x| is at least 10^power and below 10^(power + 1).
  std::int64_t power = place < point ? point - place - 1 : point - place;
  if (mantissa_end < word.size()) {
    std::string_view exponent = word.substr(mantissa_end + 1);
    const bool negative = exponent.starts_with('-');
    exponent.remove_prefix(negative || exponent.starts_with('+') ? 1 : 0);
    std::int64_t e = 0;
    if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), e).ec ==
        std::errc::result_out_of_range) {
      return !negative;  // longer than any mantissa
    }
    power += std::clamp<std::int64_t>(negative ? -e : e, -longest_shift, longest_shift);
  }
  return power >= 0;
}

}  // namespace

std::string read_binary_file(const std::filesystem::path& path, std::uintmax_t limit) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InputError(path.string() + ": no such file");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(path.string() + ": not a regular file");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) {
    throw InputError(path.string() + ": cannot be read");
  }
  if (size > limit) {
    throw InputError(
        fmt::format("{}: file has {} bytes; the limit is {}", path.string(), size, limit));
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file || file.gcount() != static_cast<std::streamsize>(size)) {
    throw InputError(path.string() + ": cannot be read");
  }
  return text;
}

std::string read_text_file(const std::filesystem::path& path, std::uintmax_t limit) {
  std::string text = read_binary_file(path, limit);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw InputError(path.string() + ": text in UTF-16; save it as UTF-8");
  }
  if (text.find('\0') != std::string::npos) {
    throw InputError(path.string() + ": a binary file, not a text file");
  }
  return text;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown;
  for (const char c : text.substr(0, longest)) {
    shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  if (text.size() > longest) {
    shown += "…";
  }
  return "`" + shown + "`";
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string_view unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == text.back() &&
                      (text.front() == '"' || text.front() == '\'');
  return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return lower;
}

std::string lower_case_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

void split_words(std::string_view text, std::vector<std::string_view>& words, std::size_t most) {
  words.clear();
  std::size_t begin = text.find_first_not_of(blanks);
  while (begin < text.size() && words.size() < most) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
}

std::optional<double> parse_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
  }
  if (!word.empty() && word.front() == '+') {
    return {};
  }
  double value = 0;
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end != last || word.empty()) {
    return {};
  }
  if (error == std::errc::result_out_of_range) {
    const double magnitude = is_at_least_one(word) ? HUGE_VAL : 0.0;
    return word.front() == '-' ? -magnitude : magnitude;
  }
  if (error != std::errc()) {
    return {};
  }
  return value;
}

LineReader::LineReader(std::string_view text, const Cancellation& cancellation)
    : text_(text), cancellation_(cancellation) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text_.starts_with(byte_order_mark)) {
    position_ = byte_order_mark.size();
  }
}

/// The text to the next end of a line; moves beyond it.
std::string_view LineReader::physical_line() {
  const std::size_t begin = position_;
  std::size_t end = std::string_view::npos;
  for (std::size_t from = begin; end == std::string_view::npos && from < text_.size();
       from += bytes_between_cancellation_checks) {
    cancellation_.throw_if_canceled();
    const std::size_t found =
        text_.substr(from, bytes_between_cancellation_checks).find_first_of("\r\n");
    end = found == std::string_view::npos ? found : from + found;
  }
  end = std::min(end, text_.size());
  const bool pair = end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n';
  position_ = end + (pair ? 2 : 1);
  ++lines_read_;
  return text_.substr(begin, end - begin);
}

/// Puts the next logical line, without its end, into line_; false at the end of the text.
bool LineReader::join_physical_lines() {
  line_.clear();
  line_number_ = lines_read_ + 1;
  if (position_ >= text_.size()) {
    return false;
  }
  bool blank = true, comment = false, continued = true;
  while (continued && position_ < text_.size()) {
    const std::string_view part = physical_line();
    continued = part.ends_with('\\');
    const std::string_view content = trimmed(continued ? part.substr(0, part.size() - 1) : part);
    // A comment ends with its line, even if it ends with a backslash (of a Windows path).
    comment = comment || (blank && content.starts_with('#'));
    continued = continued && !comment;
    blank = blank && content.empty();
    line_ += part;
    if (continued) {
      line_.back() = ' ';
    }
  }
  return true;
}

std::optional<TextLine> LineReader::next() {
  while (join_physical_lines()) {
    const std::string_view content = trimmed(line_);
    if (content.empty() || content.starts_with('#')) {
      continue;
    }
    const std::size_t end = std::min(content.find_first_of(blanks), content.size());
    TextLine line{line_number_, content.substr(0, end), trimmed(content.substr(end))};
    // Names may contain a #, as in "Material #25".
    if (!has_name_argument(line.keyword)) {
      line.rest = trimmed(line.rest.substr(0, line.rest.find('#')));
    }
    return line;
  }
  return {};
}

LineFeed::LineFeed(std::string_view text, Filter filter, const Cancellation& cancellation)
    : lines_(text, cancellation), filter_(std::move(filter)) {}

LineFeed::int_type LineFeed::underflow() {
  while (const std::optional<TextLine> line = lines_.next()) {
    if (!filter_(*line)) {
      continue;
    }
    // The parser gets the line as the filter did, without comments, and without the kinds of
    // blanks that it would take for part of a word.
    passed_ = line->keyword;
    passed_ += ' ';
    passed_ += line->rest;
    std::replace_if(
        passed_.begin(), passed_.end(), [](char c) { return c == '\v' || c == '\f'; }, ' ');
    passed_ += '\n';
    setg(passed_.data(), passed_.data(), passed_.data() + passed_.size());
    return traits_type::to_int_type(passed_.front());
  }
  return traits_type::eof();
}

}  // namespace transillum
