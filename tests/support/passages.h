// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The passages that people read in a repository: the comments and string literals of sources, and
// the paragraphs of documents, with the line of each character.
#pragma once

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace transillum::test {

enum class Kind { comment, string, paragraph };

/// A comment, a string literal or a paragraph. A line end is a blank here, an empty line '\n'.
struct Passage {
  Kind kind = Kind::comment;
  std::string text;
  std::vector<int> lines;  ///< the line of each character of text, from 1

  void add(std::string_view part, int line) {
    text += part;
    lines.resize(text.size(), line);
  }
};

inline bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

inline std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string_view::npos
             ? std::string_view()
             : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Finds the comments and string literals of C++, Python, CMake or JSON sources. Consecutive
/// comment lines in one column are one passage, as are literals with only white space between them.
class SourceReader {
 public:
  /// @param comment_mark what a comment begins with; empty: the language has no comments
  SourceReader(std::string_view text, std::string_view comment_mark)
      : text_(text), comment_mark_(comment_mark) {}

  std::vector<Passage> run() {
    while (at_ < text_.size()) {
      step();
    }
    return std::move(passages_);
  }

 private:
  bool here(std::string_view part) const { return text_.substr(at_, part.size()) == part; }

  void step() {
    const char c = text_[at_];
    const bool cpp = comment_mark_ == "//";
    if (c == '\n') {
      ++line_;
      line_begin_ = ++at_;
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++at_;
    } else if (!comment_mark_.empty() && here(comment_mark_)) {
      read_comment();
    } else if (cpp && here("/*")) {
      read_block_comment();
    } else if (cpp && here("#include")) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (cpp && here("R\"")) {
      read_raw_string();
    } else if (here("\"\"\"")) {
      read_until("\"\"\"", 3);
    } else if (c == '"' || (c == '\'' && comment_mark_ == "#")) {
      read_string(c);
    } else if (c == '\'' && (at_ == 0 || !is_word(text_[at_ - 1]))) {
      skip_character();
    } else {
      string_continues_ = false;
      ++at_;
    }
  }

  void read_comment() {
    const std::size_t column = at_ - line_begin_;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view words = text_.substr(at_, end - at_);
    words.remove_prefix(std::min(words.find_first_not_of("/#!<"), words.size()));
    words = trimmed(words);
    const bool alone = trimmed(text_.substr(line_begin_, column)).empty();
    if (alone && comment_line_ == line_ - 1 && comment_column_ == column) {
      passages_[comment_].add(words.empty() ? "\n" : " ", line_);
    } else {
      comment_ = passages_.size();
      passages_.push_back({Kind::comment, {}, {}});
      string_continues_ = false;
    }
    passages_[comment_].add(words, line_);
    comment_line_ = line_;
    comment_column_ = column;
    at_ = end;
  }

  void read_block_comment() {
    read_until("*/", 2);
    passages_.back().kind = Kind::comment;
    string_continues_ = false;
  }

  /// Reads a passage that ends with `mark`; it begins `skip` characters from here.
  void read_until(std::string_view mark, std::size_t skip) {
    at_ += skip;
    const std::size_t end = std::min(text_.find(mark, at_), text_.size());
    passages_.push_back({Kind::string, {}, {}});
    for (; at_ < end; ++at_) {
      add_to_string(text_.substr(at_, 1));
    }
    at_ = std::min(at_ + mark.size(), text_.size());
    string_continues_ = false;
  }

  void read_raw_string() {
    const std::size_t bracket = std::min(text_.find('(', at_), text_.size() - 1);
    const std::string mark = ")" + std::string(text_.substr(at_ + 2, bracket - at_ - 2)) + "\"";
    read_until(mark, bracket + 1 - at_);
  }

  void read_string(char quote) {
    if (!string_continues_) {
      passages_.push_back({Kind::string, {}, {}});
    }
    for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        ++at_;
        passages_.back().add(text_[at_] == 'n' ? "\n" : text_.substr(at_, 1), line_);
      } else {
        add_to_string(text_.substr(at_, 1));
      }
    }
    at_ += at_ < text_.size() && text_[at_] == quote ? 1 : 0;
    string_continues_ = comment_mark_ == "//";
  }

  void add_to_string(std::string_view character) {
    if (character != "\n") {
      passages_.back().add(character, line_);
      return;
    }
    passages_.back().add(" ", line_);
    ++line_;
    line_begin_ = at_ + 1;
    while (at_ + 1 < text_.size() && text_[at_ + 1] == ' ') {
      ++at_;  // indentation
    }
  }

  void skip_character() {
    at_ += at_ + 1 < text_.size() && text_[at_ + 1] == '\\' ? 3 : 2;
    at_ = std::min(std::min(text_.find('\'', at_), text_.size() - 1) + 1, text_.size());
    string_continues_ = false;
  }

  std::string_view text_;
  std::string_view comment_mark_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  std::vector<Passage> passages_;
  bool string_continues_ = false;   ///< the next literal is a part of the last passage
  std::size_t comment_ = 0;         ///< number of the passage with the last comment
  std::size_t comment_column_ = 0;  ///< where that comment begins
  int comment_line_ = -1;           ///< last line of that comment
};

/// The paragraphs and list items of a Markdown document; not its headings, tables and code.
inline std::vector<Passage> paragraphs_in(const std::string& document) {
  static const std::regex item(R"(^(\s*([-*+]|\d+[.)])\s+|\s*>\s?)+)");
  std::vector<Passage> found;
  std::istringstream lines(document);
  bool in_code = false, open = false;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string_view words = trimmed(line);
    const bool fence = words.starts_with("```");
    in_code = in_code != fence;
    if (fence || in_code || words.empty() || words.starts_with("#") || words.starts_with("|")) {
      open = false;
      continue;
    }
    std::smatch mark;
    const bool begins = std::regex_search(line, mark, item);
    if (begins || !open) {
      found.push_back({Kind::paragraph, {}, {}});
    } else {
      found.back().add(" ", number);
    }
    open = true;
    found.back().add(trimmed(std::string_view(line).substr(begins ? mark.length() : 0)), number);
  }
  return found;
}

}  // namespace transillum::test
