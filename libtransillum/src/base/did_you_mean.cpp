// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "base/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace transillum {
namespace {

/// Levenshtein distance: number of insertions, deletions and replacements.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
  // The time grows with the length of the word, so the length is limited.
  if (word.empty() || word.size() > 64) {
    return {};
  }
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(word, names);
  // Names of a damaged file may contain control characters, which are not for a terminal.
  const bool printable = std::none_of(nearest.begin(), nearest.end(),
                                      [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  return nearest.empty() || !printable ? std::string()
                                       : fmt::format("; did you mean \"{}\"?", nearest);
}

}  // namespace transillum
