// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "widgets/full_screen.h"
#include "window/base/window_views.h"

class QAction;

namespace transillum::viewer {

/// An action of the window for Esc: stops loading or searching, else leaves the full screen, else
/// clears the selection.
QAction* new_leave_action(const WindowFrame& frame, FullScreen& full_screen);

}  // namespace transillum::viewer
