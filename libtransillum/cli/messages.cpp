// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace transillum::cli {

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

}  // namespace transillum::cli
