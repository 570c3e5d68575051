// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/radiosity_solver.h"

namespace transillum::cli {

/// Progress on stderr: one line redrawn in place on a terminal, otherwise plain lines at most once
/// per second. Tasks that finish sooner show nothing. A thread of its own repeats the last line
/// about passes, or the task begun, while they take long.
///
/// Threads: only one may call it.
class ProgressDisplay {
 public:
  /// @param quiet shows nothing
  explicit ProgressDisplay(bool quiet = false);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows the task, its finished fraction in [0,1] (below 0: unknown) and details, such as rate
  /// and time left.
  void show(const std::string& what, double fraction, const std::string& detail = {});
  /// Shows label and number of the pass, with rate and time left; nothing between iterations.
  void show_passes(const std::string& label, const SolveProgress& progress);
  /// Passes begin, of which the first may take minutes.
  void expect_passes(const std::string& label, int passes);
  /// A task begins whose share is unknown and which may take long: its name is repeated.
  void begin(const std::string& what);
  /// Shows the finished fraction of the task begun, with rate and time left.
  /// @param total number of `units` in the task
  void show_rate(const std::string& what, double fraction, double total, const char* units);
  /// Clears the line, before other text is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  /// The contents of the line.
  struct Line {
    std::string what;
    double fraction = -1;
    std::string detail;
  };
  bool due();
  void show_if_due(const Line& line);
  void redraw(const Line& line);
  void repeat(const Line& line);
  void repeat_while_it_takes_long(const std::stop_token& stop);

  bool quiet_;
  bool terminal_;
  std::mutex mutex_;  ///< guards the members below
  bool drawn_ = false;
  Clock::time_point last_;
  Line repeated_;            ///< empty while neither passes nor a task begun are under way
  Clock::time_point since_;  ///< when repeated_ was set
  Clock::time_point begun_;  ///< when the last task began
  std::condition_variable_any stopping_;
  std::jthread repeater_;
};

/// "12.3 passes/s, 1:15 min left"
std::string rate_text(double passes_per_second, double seconds_left);

/// Builds the BSP tree of a scene and shows the progress.
/// @param threads at most; 0: the number of cores.
/// @throws Canceled
std::shared_ptr<const BspTree> build_tree(const Scene& scene, const Cancellation& cancellation,
                                          ProgressDisplay& display, int threads = 0);

}  // namespace transillum::cli
