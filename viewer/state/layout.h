// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// Arrangements of the docks, one per task.
enum class Layout { teach, inspect, debug };
inline constexpr int layout_count = 3;

}  // namespace transillum::viewer
