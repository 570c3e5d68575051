// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace transillum::cli {
namespace {

/// Levenshtein's distance, one row of the table at a time.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

}  // namespace

void print_message(const std::string& text) {
  std::string line = text;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  fmt::print(stderr, "transillum: {}\n", line);
}

void print_warnings(const Scene& scene) {
  for (const std::string& warning : scene.report().warnings) {
    print_message("warning: " + warning);
  }
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& choices) {
  if (word.empty() || choices.empty() || word.size() > 64) return {};
  const auto nearest = std::min_element(choices.begin(), choices.end(), [&](auto& a, auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  const std::size_t allowed = std::max<std::size_t>(1, nearest->size() / 3);
  if (edit_distance(word, *nearest) > allowed) return {};
  return fmt::format(", did you mean \"{}\"?", *nearest);
}

}  // namespace transillum::cli
