// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "base/choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "transillum/errors.h"

namespace transillum {

std::size_t Choices::index_of(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError(
        fmt::format("unknown {} \"{}\"; choose one of {}", what, name, fmt::join(names, ", ")));
  }
  return static_cast<std::size_t>(found - names.begin());
}

void add_choice(Choices& choices, const char* name, const char* label, const char* sentence) {
  std::string shown = label != nullptr ? label : name;
  if (label == nullptr && shown.front() >= 'a' && shown.front() <= 'z') {
    shown.front() = static_cast<char>(shown.front() - 'a' + 'A');
  }
  choices.names.emplace_back(name);
  choices.labels.push_back(std::move(shown));
  choices.sentences.emplace_back(sentence);
}

}  // namespace transillum
