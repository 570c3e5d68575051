// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// Parts of the 3-D picture that the Show menu switches.
enum class Overlay { normals, back_sides, cuts, wireframe, smooth };
inline constexpr Overlay all_overlays[] = {Overlay::normals, Overlay::back_sides, Overlay::cuts,
                                           Overlay::wireframe, Overlay::smooth};

}  // namespace transillum::viewer
