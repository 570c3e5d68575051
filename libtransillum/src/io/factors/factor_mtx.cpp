// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors in the coordinate form of Matrix Market: a head line, comments (%), a line with
// rows, columns and number of entries, then a line per entry; numbers of rows and columns start at
// 1. Comments, which other programs skip, have the areas, `%area A` per patch, and the hash of the
// polygons, `%polygons HASH`, and for linear functions a line `%moments` per entry, in their order.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <span>

#include "base/text_file.h"
#include "io/factors/factor_formats.h"
#include "io/text.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// The lines of a text; errors name the number of the current one.
class MtxLines {
 public:
  MtxLines(const std::string& name, std::string_view text) : name_(name), text_(text) {}

  std::optional<std::string_view> next() {
    if (text_.empty()) {
      return std::nullopt;
    }
    ++number_;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    const std::string_view line = trimmed(text_.substr(0, end));
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return line;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", name_, number_, what));
  }
  std::int64_t whole_number(std::string_view word, std::int64_t low, std::int64_t high) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < low || value > high) {
      refuse(fmt::format("{} is not a whole number from {} to {}", in_quotes(word), low, high));
    }
    return value;
  }
  double number(std::string_view word) const {
    const std::optional<double> value = parse_number(word);
    if (!value) {
      refuse(fmt::format("{} is not a number", in_quotes(word)));
    }
    return *value;
  }

 private:
  const std::string& name_;
  std::string_view text_;
  std::int64_t number_ = 0;
};

void read_head(MtxLines& lines) {
  const std::string head = lower_case(lines.next().value_or(""));
  std::vector<std::string_view> words;
  split_words(head, words);
  if (words.size() != 5 || words[0] != "%%matrixmarket" || words[1] != "matrix") {
    lines.refuse("not a matrix in the form of Matrix Market");
  }
  if (words[2] != "coordinate" || words[3] != "real" || words[4] != "general") {
    lines.refuse(fmt::format("a matrix {} {} {}; `coordinate real general` is read",
                             in_quotes(words[2]), in_quotes(words[3]), in_quotes(words[4])));
  }
}

constexpr std::size_t moments_in_line = 8;

void read_moments(const MtxLines& lines, std::string_view text,
                  std::vector<std::string_view>& words, std::vector<double>& moments) {
  split_words(text, words, moments_in_line + 1);
  if (words.size() != moments_in_line) {
    lines.refuse(fmt::format("a line of moments must have {} numbers", moments_in_line));
  }
  for (const std::string_view word : words) {
    moments.push_back(lines.number(word));
  }
}

/// For each line the value of its entry, then the moments of the line.
std::vector<double> with_first(const std::vector<FactorEntry>& entries,
                               const std::vector<double>& moments) {
  std::vector<double> all;
  for (std::size_t k = 0; k < moments.size() / moments_in_line; ++k) {
    all.push_back(k < entries.size() ? entries[k].value : 0.0);
    const auto first = moments.begin() + static_cast<std::ptrdiff_t>(moments_in_line * k);
    all.insert(all.end(), first, first + static_cast<std::ptrdiff_t>(moments_in_line));
  }
  return all;
}

}  // namespace

void write_factors_mtx(std::ostream& out, const Scene& scene, const FormFactors& form_factors) {
  TextBuffer text(out);
  text.add(
      "%%MatrixMarket matrix coordinate real general\n% form factors F_ij: share of the light "
      "leaving patch i that arrives at patch j\n");
  text.add("%polygons {}\n", hash_of_polygons(scene));
  for (const Patch& patch : scene.patches()) {
    text.add("%area {}\n", patch.area);
  }
  for (const TransferMoments& moments : form_factors.moments) {
    text.add("%moments {}\n", fmt::join(std::span(moments.value).subspan(1), " "));
  }
  text.add("{} {} {}\n", scene.patch_count(), scene.patch_count(), form_factors.size());
  for (std::size_t i = 0; i + 1 < form_factors.row_begin.size(); ++i) {
    for (std::size_t k = form_factors.row_begin[i]; k < form_factors.row_begin[i + 1]; ++k) {
      text.add("{} {} {}\n", i + 1, form_factors.source[k] + 1, form_factors.value[k]);
    }
  }
}

StoredFormFactors read_factors_mtx(const std::string& name, std::string_view text,
                                   const Cancellation& cancellation) {
  MtxLines lines(name, text);
  read_head(lines);
  StoredFormFactors stored{name, {}, {}, {}};
  std::vector<std::string_view> words;
  std::int64_t patches = 0, expected = 0;
  std::vector<FactorEntry> entries;
  std::vector<double> moments;  // 8 numbers a pair: T^00 is the form factor
  while (const auto line = lines.next()) {
    if (line->starts_with("%area ")) {
      stored.areas.push_back(lines.number(trimmed(line->substr(6))));
      continue;
    }
    if (line->starts_with("%moments ")) {
      read_moments(lines, line->substr(9), words, moments);
      continue;
    }
    if (line->starts_with("%polygons ")) {
      stored.polygons = trimmed(line->substr(10));
      continue;
    }
    if (line->empty() || line->starts_with("%")) {
      continue;
    }
    split_words(*line, words, 4);
    if (words.size() != 3) {
      lines.refuse("a line must have three numbers");
    }
    if (patches == 0) {
      // No memory is taken for more rows than the file has bytes.
      patches = lines.whole_number(words[0], 1,
                                   static_cast<std::int64_t>(std::min<std::size_t>(
                                       text.size(), std::numeric_limits<PatchId>::max() - 1)));
      lines.whole_number(words[1], patches, patches);
      // An entry takes 6 bytes at least.
      expected = lines.whole_number(words[2], 0, static_cast<std::int64_t>(text.size() / 6 + 1));
      continue;
    }
    if (entries.size() % 4096 == 0) {
      cancellation.throw_if_canceled();
    }
    entries.push_back({static_cast<PatchId>(lines.whole_number(words[0], 1, patches) - 1),
                       static_cast<PatchId>(lines.whole_number(words[1], 1, patches) - 1),
                       lines.number(words[2])});
  }
  if (patches == 0 || static_cast<std::int64_t>(entries.size()) != expected) {
    lines.refuse(fmt::format("the file has {} entries, not {}", entries.size(), expected));
  }
  stored.form_factors = sorted_factors(name, static_cast<PatchId>(patches), entries, cancellation);
  if (!moments.empty()) {
    add_moments(name, with_first(entries, moments), entries, stored.form_factors);
  }
  return stored;
}

}  // namespace transillum
