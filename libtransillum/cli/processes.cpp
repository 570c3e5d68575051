// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/processes.h"

namespace transillum::cli {

Processes& processes() {
  static Processes processes;
  return processes;
}

bool is_first_process() { return !processes().group || processes().group->rank() == 0; }

void in_all_processes(const std::function<void()>& body) {
  if (processes().group) {
    processes().group->agree(body);
  } else {
    body();
  }
}

}  // namespace transillum::cli
