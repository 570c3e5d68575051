// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// Lowers the priority of the calling thread, and of threads that it starts later, below the
/// UI thread's. Linux only; elsewhere without effect.
void lower_thread_priority();

}  // namespace transillum::viewer
