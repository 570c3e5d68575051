// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "window/base/window_views.h"

class QMenu;

namespace transillum::viewer {

class SceneEdits;

/// Adds the panel "Move" and its handles to a window.
/// @param edit  the menu that gets the commands
/// @returns the edits, a child of the window
SceneEdits* add_editing(const WindowFrame& frame, DockLayouts& docks, QMenu& edit);

}  // namespace transillum::viewer
