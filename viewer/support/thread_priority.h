// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// Makes the calling thread, and the threads that it will start, give way to the window.
void lower_thread_priority();

}  // namespace transillum::viewer
