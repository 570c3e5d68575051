// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <string>

namespace transillum::cli {

/// Progress on stderr: one line redrawn in place on a terminal, otherwise plain lines at most
/// every second. Short work shows nothing.
///
/// Threads: one at a time.
class ProgressDisplay {
 public:
  ProgressDisplay();
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// What is under way, the share of it done in [0,1] (below 0: not known) and some words of
  /// detail, such as rate and time left.
  void show(const std::string& what, double share, const std::string& detail = {});
  /// Wipes the line, before something else is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool due();
  void redraw(const std::string& what, double share, const std::string& detail);

  bool terminal_;
  bool drawn_ = false;
  Clock::time_point last_;
};

/// 75 s -> "1:15 min".
std::string time_text(double seconds);

}  // namespace transillum::cli
