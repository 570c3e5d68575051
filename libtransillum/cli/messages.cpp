// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/messages.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>

#include "cli/processes.h"

namespace transillum::cli {

void print_diagnostics(std::string_view text) noexcept {
  while (!text.empty() && is_first_process()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      return;
    }
  }
}

void print_message(std::string_view text) noexcept {
  try {
    std::string line = "transillum: " + std::string(text);
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    print_diagnostics(line + "\n");
  } catch (const std::bad_alloc&) {
    print_diagnostics("transillum: not enough memory\n");
  }
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
  const auto* solve_error = dynamic_cast<const SolveError*>(&error);
  return error.what() + remedy_hint(solve_error ? solve_error->remedy() : Remedy::none);
}

std::string warning_text(const std::string& warning) {
  const bool is_black = warning.find("has no diffuse reflectance") != std::string::npos;
  return warning + (is_black ? " (try --reflectance NAME=R)" : "");
}

void print_warnings(const Scene& scene) {
  for (const std::string& warning : scene.report().warnings) {
    print_message("warning: " + warning_text(warning));
  }
}

}  // namespace transillum::cli
