// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/radiosity.h"

namespace transillum::cli {

/// Progress on stderr: one line redrawn in place on a terminal, otherwise plain lines at most once
/// per second. Tasks that finish sooner show nothing.
///
/// Threads: not thread-safe.
class ProgressDisplay {
 public:
  /// @param quiet shows nothing
  explicit ProgressDisplay(bool quiet = false);
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows the task, its finished share in [0,1] (below 0: unknown) and details, such as rate and
  /// time left.
  void show(const std::string& what, double share, const std::string& detail = {});
  /// Shows label and number of the pass, with rate and time left; nothing between iterations.
  void show_passes(const std::string& label, const SolveProgress& progress);
  /// Clears the line, before other text is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool due();
  void redraw(const std::string& what, double share, const std::string& detail);

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point last_;
};

/// "12.3 passes/s, 1:15 min left"
std::string rate_text(double passes_per_second, double seconds_left);

/// Builds the BSP tree of a scene and shows the progress.
/// @throws Canceled
std::shared_ptr<const BspTree> build_tree(const Scene& scene, const Cancellation& cancellation,
                                          ProgressDisplay& display);

}  // namespace transillum::cli
