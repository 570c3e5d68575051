// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace transillum {

/// Warnings for the user: the first few of each kind, then only their number.
class Warnings {
 public:
  static constexpr std::int64_t shown_of_a_kind = 10;

  /// @param kind completes "and 7 more …"
  /// @param sentence without a final period
  void add(const std::string& kind, const std::string& sentence);
  std::int64_t count(const std::string& kind) const;
  /// Grouped by kind, in the order in which the kinds first occurred.
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
