// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace transillum::viewer {

void lower_thread_priority() {
#ifdef __linux__
  // Linux has one nice value per thread, and new threads inherit it: the solver's workers too.
  // If the system refuses, the window only responds more slowly. With 19, the worker got almost no
  // time on a machine with other jobs: the first picture of a scene took minutes. With 10, it gets
  // seven times as much of a shared core, and the UI thread's delays are the same within the
  // measurement noise: on two cores without a graphics card, 99 % were below 47 to 54 ms, with 19
  // below 40 to 56 ms.
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));
  (void)setpriority(PRIO_PROCESS, thread, 10);
#endif
}

}  // namespace transillum::viewer
