// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "progress_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace transillum::cli {
namespace {

bool stderr_redraws() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
    return 80;
  }
  return size.ws_col;
}

std::string bar(double share, int cells) {
  const int full = static_cast<int>(std::lround(share * cells));
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(cells - full), '.') + "]";
}

}  // namespace

ProgressDisplay::ProgressDisplay() : terminal_(stderr_redraws()), last_(Clock::now()) {}

bool ProgressDisplay::due() {
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  if (now - last_ < (terminal_ ? 100ms : 1000ms)) {
    return false;
  }
  last_ = now;
  return true;
}

void ProgressDisplay::show(const std::string& what, double share, const std::string& detail) {
  if (!due()) {
    return;
  }
  if (terminal_) {
    redraw(what, share, detail);
    return;
  }
  std::string line = what;
  if (share >= 0) {
    line += fmt::format(", {:.0f} %", 100 * std::min(share, 1.0));
  }
  if (!detail.empty()) {
    line += ", " + detail;
  }
  fmt::print(stderr, "{}\n", line);
}

void ProgressDisplay::redraw(const std::string& what, double share, const std::string& detail) {
  std::string line = what;
  if (share >= 0) {
    const double shown = std::min(share, 1.0);
    line += fmt::format(" {} {:3.0f} %", bar(shown, 16), 100 * shown);
  }
  if (!detail.empty()) {
    line += "  " + detail;
  }
  // A line that wraps could not be redrawn in place.
  line.resize(std::min(line.size(), terminal_width() - 1));
  fmt::print(stderr, "\r{}\033[K", line);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressDisplay::clear() {
  if (!drawn_) {
    return;
  }
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

std::string time_text(double seconds) {
  if (!std::isfinite(seconds)) {
    return "?";
  }
  if (seconds < 1) {
    return fmt::format("{:.0f} ms", 1000 * seconds);
  }
  if (seconds < 59.95) {
    return fmt::format("{:.1f} s", seconds);
  }
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) {
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  }
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace transillum::cli
