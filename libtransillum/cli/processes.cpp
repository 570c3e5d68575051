// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/processes.h"

namespace transillum::cli {

Processes& processes() {
  static Processes processes;
  return processes;
}

bool is_first_process() { return !processes().sums || processes().sums->is_first(); }

void in_all_processes(const std::function<void()>& body) {
  if (processes().sums) {
    processes().sums->agree(body);
  } else {
    body();
  }
}

}  // namespace transillum::cli
