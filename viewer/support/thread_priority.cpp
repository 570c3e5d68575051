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
  // Linux keeps a nice value a thread, and new threads inherit it: so do the solver's workers.
  // If the system refuses, the window is merely less prompt. With 19 a machine with other jobs left
  // next to nothing to it: a scene's first picture took minutes. With 10 it has seven times as much
  // of a shared core, and the gaps between the window's turns were the same to what repeats: on two
  // cores without a graphics card 99 % were below 47 to 54 ms, with 19 below 40 to 56.
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));
  (void)setpriority(PRIO_PROCESS, thread, 10);
#endif
}

}  // namespace transillum::viewer
