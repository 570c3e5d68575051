// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/temporary_folder.h"

namespace transillum::test {

/// Sets a locale whose decimal separator is a comma, for this process and for the programs that it
/// starts, and restores the locale C. The locale is compiled into a temporary folder, since few
/// machines have it.
class CommaLocale {
 public:
  CommaLocale() {
    const std::filesystem::path target = folder_.path() / name;
    const std::string command =
        std::string("localedef -i de_DE -f UTF-8 ") + target.string() + " >/dev/null 2>&1";
    // localedef also exits with 1 after warnings.
    if (std::system(command.c_str()) < 0 || !std::filesystem::exists(target)) {
      problem_ = "localedef or its source of de_DE is missing (packages libc-bin, locales)";
      return;
    }
    ::setenv("LOCPATH", folder_.path().c_str(), 1);
    ::setenv("LC_ALL", name, 1);
    if (std::setlocale(LC_ALL, name) == nullptr ||
        std::localeconv()->decimal_point != std::string(",")) {
      problem_ = "the compiled locale cannot be set";
    }
  }
  ~CommaLocale() {
    std::setlocale(LC_ALL, "C");
    ::unsetenv("LC_ALL");
    ::unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  /// Why there is no such locale; empty if it is set.
  const std::string& problem() const { return problem_; }

 private:
  static constexpr const char* name = "de_DE.UTF-8";
  TemporaryFolder folder_;
  std::string problem_;
};

}  // namespace transillum::test
