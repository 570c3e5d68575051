// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// The arrangements of the window's docks, one for each kind of user.
enum class Layout { teach, inspect, debug };

}  // namespace transillum::viewer
