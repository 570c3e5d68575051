// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>

namespace transillum::cli {

void print_message(const std::string& text) {
  std::string line = text;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  fmt::print(stderr, "transillum: {}\n", line);
}

std::string remedy_hint(Remedy remedy) {
  switch (remedy) {
    case Remedy::none:
      break;
    case Remedy::directions:
      return " (try more directions with -m)";
    case Remedy::directions_or_row_normalization:
      return " (try more directions with -m, or --normalize rows)";
    case Remedy::directions_or_symmetric_normalization:
      return " (try more directions with -m, or --normalize symmetric)";
    case Remedy::memory:
      return " (try a larger --memory)";
  }
  return {};
}

std::string error_text(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) {
    return "not enough memory";
  }
  const auto* solve_error = dynamic_cast<const SolveError*>(&error);
  return error.what() + remedy_hint(solve_error ? solve_error->remedy() : Remedy::none);
}

void print_warnings(const Scene& scene) {
  for (const std::string& warning : scene.report().warnings) {
    print_message("warning: " + warning);
  }
}

}  // namespace transillum::cli
