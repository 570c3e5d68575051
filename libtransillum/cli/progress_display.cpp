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

#include "report_text.h"

namespace transillum::cli {
namespace {

bool can_redraw_stderr() {
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

ProgressDisplay::ProgressDisplay(bool quiet)
    : quiet_(quiet), terminal_(can_redraw_stderr()), last_(Clock::now()) {}

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
  if (quiet_ || !due()) {
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

void ProgressDisplay::show_passes(const std::string& label, const SolveProgress& progress) {
  if (progress.direction == 0) {
    return;
  }
  show(fmt::format("{}pass {}/{}", label, progress.direction, progress.passes),
       static_cast<double>(progress.direction) / progress.passes,
       rate_text(progress.passes_per_second, progress.seconds_left));
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
  // A line that wraps cannot be redrawn in place.
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

std::string rate_text(double passes_per_second, double seconds_left) {
  return fmt::format("{:.1f} passes/s, {} left", passes_per_second, time_text(seconds_left));
}

std::shared_ptr<const BspTree> build_tree(const Scene& scene, const Cancellation& cancellation,
                                          ProgressDisplay& display) {
  return std::make_shared<const BspTree>(
      scene, cancellation, [&](double share) { display.show("building BSP tree", share); });
}

}  // namespace transillum::cli
