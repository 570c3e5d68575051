// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace transillum {

/// Sentences for the user, only the first few of each kind and how many more there are.
class Warnings {
 public:
  static constexpr std::int64_t shown_of_a_kind = 10;

  /// `kind` completes "and 7 more …".
  void add(const std::string& kind, const std::string& sentence);
  std::int64_t count(const std::string& kind) const;
  /// In the order the kinds first came up.
  std::vector<std::string> sentences() const;

 private:
  struct Kind {
    std::string name;
    std::vector<std::string> first;
    std::int64_t count = 0;
  };
  std::vector<Kind> kinds_;
};

}  // namespace transillum
