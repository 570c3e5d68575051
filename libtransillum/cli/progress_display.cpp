// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/progress_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string_view>
#include <system_error>

#include "cli/messages.h"
#include "cli/reports/report_text.h"

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

std::string bar(double fraction, int cells) {
  const int full = static_cast<int>(std::lround(fraction * cells));
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(cells - full), '.') + "]";
}

}  // namespace

ProgressDisplay::ProgressDisplay(bool quiet)
    : quiet_(quiet), terminal_(can_redraw_stderr()), last_(Clock::now()) {}

ProgressDisplay::~ProgressDisplay() {
  repeater_ = {};
  clear();
}

bool ProgressDisplay::due() {
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  if (now - last_ < (terminal_ ? 100ms : 1000ms)) {
    return false;
  }
  last_ = now;
  return true;
}

void ProgressDisplay::show(const std::string& what, double fraction, const std::string& detail) {
  const std::lock_guard lock(mutex_);
  repeated_ = {};
  show_if_due({what, fraction, detail});
}

void ProgressDisplay::show_if_due(const Line& line) {
  if (quiet_ || !due()) {
    return;
  }
  if (terminal_) {
    redraw(line);
    return;
  }
  std::string text = line.what;
  if (line.fraction >= 0) {
    text += fmt::format(", {:.0f} %", 100 * std::min(line.fraction, 1.0));
  }
  if (!line.detail.empty()) {
    text += ", " + line.detail;
  }
  print_diagnostics(text + "\n");
}

void ProgressDisplay::show_passes(const std::string& label, const SolveProgress& progress) {
  if (progress.direction == 0) {
    return;
  }
  const std::lock_guard lock(mutex_);
  repeated_ = {fmt::format("{}pass {}/{}", label, progress.direction, progress.passes),
               static_cast<double>(progress.direction) / progress.passes,
               rate_text(progress.passes_per_second, progress.seconds_left)};
  since_ = Clock::now();
  show_if_due(repeated_);
}

void ProgressDisplay::expect_passes(const std::string& label, int passes) {
  repeat({fmt::format("{}pass 0/{}", label, passes), 0, {}});
}

void ProgressDisplay::begin(const std::string& what) {
  begun_ = Clock::now();
  repeat({what, -1, {}});
}

void ProgressDisplay::show_rate(const std::string& what, double fraction, double total,
                                const char* units) {
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  if (!(fraction > 0 && seconds > 0)) {
    return;
  }
  show(what, fraction,
       fmt::format("{:.0f} {}/s, {} left", fraction * total / seconds, units,
                   time_text(seconds * (1 - fraction) / fraction)));
}

void ProgressDisplay::repeat(const Line& line) {
  if (quiet_) {
    return;
  }
  const std::lock_guard lock(mutex_);
  repeated_ = line;
  since_ = Clock::now();
  if (repeater_.joinable()) {
    return;
  }
  try {
    repeater_ = std::jthread([this](const std::stop_token& stop) {
      try {
        repeat_while_it_takes_long(stop);
      } catch (const std::bad_alloc&) {
        // No more memory: then the task fails, or nothing is repeated.
      }
    });
  } catch (const std::system_error&) {
    // No more threads: then there is less progress to read.
  }
}

void ProgressDisplay::repeat_while_it_takes_long(const std::stop_token& stop) {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  while (!stopping_.wait_for(lock, stop, 1s, [] { return false; }) && !stop.stop_requested()) {
    const std::chrono::duration<double> waiting = Clock::now() - since_;
    if (repeated_.what.empty() || waiting < 1s) {
      continue;
    }
    Line line = repeated_;
    line.detail += fmt::format("{}{}under way for {}", line.detail.empty() ? "" : ", ",
                               line.fraction < 0 ? "" : "next pass ", time_text(waiting.count()));
    show_if_due(line);
  }
}

void ProgressDisplay::redraw(const Line& line) {
  std::string text = line.what;
  if (line.fraction >= 0) {
    const double shown = std::min(line.fraction, 1.0);
    text += fmt::format(" {} {:3.0f} %", bar(shown, 16), 100 * shown);
  }
  if (!line.detail.empty()) {
    text += "  " + line.detail;
  }
  // A line that wraps cannot be redrawn in place.
  text.resize(std::min(text.size(), terminal_width() - 1));
  print_diagnostics("\r" + text + "\033[K");
  drawn_ = true;
}

void ProgressDisplay::clear() {
  const std::lock_guard lock(mutex_);
  repeated_ = {};
  if (!drawn_) {
    return;
  }
  print_diagnostics("\r\033[K");
  drawn_ = false;
}

std::string rate_text(double passes_per_second, double seconds_left) {
  return fmt::format("{:.1f} passes/s, {} left", passes_per_second, time_text(seconds_left));
}

std::shared_ptr<const BspTree> build_tree(const Scene& scene, const Cancellation& cancellation,
                                          ProgressDisplay& display, int threads) {
  return std::make_shared<const BspTree>(
      scene, cancellation, [&](double fraction) { display.show("building BSP tree", fraction); },
      threads);
}

}  // namespace transillum::cli
