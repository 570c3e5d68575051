// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QtCore/qnamespace.h>
#include <string>
#include <vector>

#include "state/view_choices.h"

namespace transillum::viewer {

/// The place of a panel in a layout.
struct DockPlace {
  enum class Opening {
    front,   ///< shown, in front of its stack
    behind,  ///< shown as a tab behind the front
    closed   ///< hidden until it is requested
  };
  Layout layout;
  Qt::DockWidgetArea area;
  int stack;   ///< panels of a side with the same number are tabs of one stack
  int height;  ///< height of the stack, pixels
  Opening opening = Opening::closed;
};

/// The places of a panel. @param panel  the name of its dock without "_dock"
/// @returns at most one place for each layout; none for an unknown name
const std::vector<DockPlace>& dock_places_of(const std::string& panel);

}  // namespace transillum::viewer
