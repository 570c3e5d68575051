// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/warnings.h"

#include <fmt/format.h>

#include <algorithm>

namespace transillum {

void Warnings::add(const std::string& kind, const std::string& sentence) {
  auto found =
      std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.name == kind; });
  if (found == kinds_.end()) {
    found = kinds_.insert(kinds_.end(), {kind, {}, 0});
  }
  if (++found->count <= shown_of_a_kind) {
    found->first.push_back(sentence);
  }
}

std::int64_t Warnings::count(const std::string& kind) const {
  for (const Kind& k : kinds_) {
    if (k.name == kind) {
      return k.count;
    }
  }
  return 0;
}

std::vector<std::string> Warnings::sentences() const {
  std::vector<std::string> all;
  for (const Kind& kind : kinds_) {
    all.insert(all.end(), kind.first.begin(), kind.first.end());
    if (kind.count > shown_of_a_kind) {
      all.push_back(fmt::format("and {} more {}", kind.count - shown_of_a_kind, kind.name));
    }
  }
  return all;
}

}  // namespace transillum
