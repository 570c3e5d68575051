// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "base/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>

#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::string_view blanks = " \t\v\f";
constexpr std::int32_t lines_between_cancellation_checks = 4096;

bool is_comment(std::string_view line) { return trimmed(line).starts_with('#'); }

bool has_name_argument(std::string_view keyword) {
  return keyword == "usemtl" || keyword == "newmtl" || keyword == "mtllib";
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, std::uintmax_t limit) {
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

void split_words(std::string_view text, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t begin = text.find_first_not_of(blanks);
  while (begin < text.size()) {
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
  // Too large or too small for a double: strtod returns infinity or (nearly) zero.
  if (error == std::errc::result_out_of_range) {
    return std::strtod(std::string(word).c_str(), nullptr);
  }
  if (error != std::errc()) {
    return {};
  }
  return value;
}

LineFeed::LineFeed(std::string_view text, Filter filter, const Cancellation& cancellation)
    : text_(text), filter_(std::move(filter)), cancellation_(cancellation) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text_.starts_with(byte_order_mark)) {
    position_ = byte_order_mark.size();
  }
}

bool LineFeed::next_line() {
  line_.clear();
  line_number_ = lines_read_ + 1;
  if (position_ >= text_.size()) {
    return false;
  }
  bool continued = true;
  while (continued && position_ < text_.size()) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", position_), text_.size());
    line_ += text_.substr(position_, end - position_);
    const bool pair = end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n';
    position_ = end + (pair ? 2 : 1);
    ++lines_read_;
    // A comment ends with its line, even if it ends with a backslash (of a Windows path).
    continued = !line_.empty() && line_.back() == '\\' && !is_comment(line_);
    if (continued) {
      line_.back() = ' ';
    }
  }
  return true;
}

LineFeed::int_type LineFeed::underflow() {
  while (next_line()) {
    if (line_number_ % lines_between_cancellation_checks == 0) {
      cancellation_.throw_if_canceled();
    }
    TextLine line{line_number_, {}, {}};
    const std::string_view content = trimmed(line_);
    if (content.empty() || is_comment(content)) {
      continue;
    }
    const std::size_t end = std::min(content.find_first_of(blanks), content.size());
    line.keyword = content.substr(0, end);
    line.rest = trimmed(content.substr(end));
    // Names may contain a #, as in "Material #25".
    if (!has_name_argument(line.keyword)) {
      line.rest = trimmed(line.rest.substr(0, line.rest.find('#')));
    }
    if (!filter_(line)) {
      continue;
    }
    // The parser gets the line as the filter did, without comments, and without the kinds of
    // blanks that it would take for part of a word.
    std::string passed(line.keyword);
    passed += ' ';
    passed += line.rest;
    std::replace_if(
        passed.begin(), passed.end(), [](char c) { return c == '\v' || c == '\f'; }, ' ');
    passed += '\n';
    line_ = std::move(passed);
    setg(line_.data(), line_.data(), line_.data() + line_.size());
    return traits_type::to_int_type(line_.front());
  }
  return traits_type::eof();
}

}  // namespace transillum
