// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "transillum/patch_sums.h"

namespace transillum::cli {

/// The processes of a program that is started several times at once: transillum-mpi. All parse the
/// same arguments. The first one prints and writes everything; the others are silent and share
/// the passes of `solve`.
struct Processes {
  std::shared_ptr<PatchSums> sums;       ///< sums of a solve; null if this process is alone
  int here = 1;                          ///< processes on this machine
  int threads = 0;                       ///< default of --threads; 0: the number of cores
  std::function<std::string()> traffic;  ///< says what was sent, in a sentence; all must call it
};

/// Set once, before the program runs.
Processes& processes();

/// Whether this process prints and writes.
bool is_first_process();

/// Runs `body` in all processes, and where one fails, fails in all.
/// @throws the error of `body`, or OtherProcessFailed
void in_all_processes(const std::function<void()>& body);

}  // namespace transillum::cli
