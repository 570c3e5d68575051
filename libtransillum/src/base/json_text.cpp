// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Checks JSON texts with nlohmann's parser, which reports one event per token and builds no
// document. Its own stack grows by one bit per level.
#include "base/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <vector>

#include "base/text_file.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using nlohmann::json;

/// Iterates over a text and records how far the parser has read.
class Reader {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Reader(const char* next, const char*& reached) : next_(next), reached_(&reached) {}
  reference operator*() const { return *next_; }
  Reader& operator++() {
    *reached_ = ++next_;
    return *this;
  }
  bool operator==(const Reader& other) const { return next_ == other.next_; }
  bool operator!=(const Reader& other) const { return next_ != other.next_; }

 private:
  const char* next_;
  const char** reached_;
};

/// Receives the events of the parser and throws an InputError at the first violation.
class Checker : public nlohmann::json_sax<json> {
 public:
  Checker(std::string_view text, const std::string& name, std::uintmax_t most_values)
      : text_(text), name_(name), most_values_(most_values), reached_(text.data()) {}

  void run() {
    json::sax_parse(Reader(text_.data(), reached_), Reader(text_.data() + text_.size(), reached_),
                    this);
  }

  bool null() override { return count_value(); }
  bool boolean(bool) override { return count_value(); }
  bool number_integer(number_integer_t) override { return count_value(); }
  bool number_unsigned(number_unsigned_t) override { return count_value(); }
  bool number_float(number_float_t, const string_t&) override { return count_value(); }
  bool string(string_t&) override { return count_value(); }
  bool binary(binary_t&) override { return count_value(); }
  bool start_object(std::size_t) override { return begin_level(); }
  bool start_array(std::size_t) override { return begin_level(); }
  bool end_object() override { return end_level(); }
  bool end_array() override { return end_level(); }
  bool key(string_t& key) override {
    if (!keys_.back().insert(key).second) {
      fail(fmt::format("the key {} occurs twice in one object", in_quotes(key)));
    }
    return true;
  }
  bool parse_error(std::size_t, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    constexpr int out_of_range = 406;
    if (error.id == out_of_range) {
      fail(fmt::format("the number {} is out of range", in_quotes(token)));
    }
    fail("invalid JSON (see https://www.json.org): check commas, quotes and brackets");
  }

 private:
  bool count_value() {
    if (++values_ > most_values_) {
      fail(fmt::format("more than {} values", most_values_));
    }
    return true;
  }
  bool begin_level() {
    if (keys_.size() >= deepest_json) {
      fail(fmt::format("more than {} lists and objects inside each other", deepest_json));
    }
    keys_.emplace_back();
    return count_value();
  }
  bool end_level() {
    keys_.pop_back();
    return true;
  }
  /// The error is at the last character that the parser has read.
  [[noreturn]] void fail(const std::string& what) const {
    const auto read = static_cast<std::size_t>(reached_ - text_.data());
    const std::string_view before = text_.substr(0, std::max<std::size_t>(read, 1) - 1);
    const std::size_t end = before.rfind('\n');
    const std::string_view line = end == std::string_view::npos ? before : before.substr(end + 1);
    const auto is_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    throw InputError(fmt::format("{}, line {}, column {}: {}", name_,
                                 1 + std::count(before.begin(), before.end(), '\n'),
                                 1 + std::count_if(line.begin(), line.end(), is_character), what));
  }

  std::string_view text_;
  const std::string& name_;
  std::uintmax_t most_values_;
  const char* reached_;
  std::uintmax_t values_ = 0;
  std::vector<std::unordered_set<std::string>> keys_;  ///< keys of each open level
};

}  // namespace

std::string read_json_file(const std::filesystem::path& path) {
  return read_text_file(path, largest_json_file);
}

void check_json(std::string_view text, const std::string& name, std::uintmax_t limit) {
  if (text.size() > limit) {
    throw InputError(
        fmt::format("{}: {} bytes of JSON; the limit is {}", name, text.size(), limit));
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw InputError(name + ": an empty file");
  }
  // A value has at least a byte, so a larger limit of bytes is one of values too.
  Checker(text, name, limit > largest_json_file ? limit : most_json_values).run();
}

}  // namespace transillum
