// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// What the Show menu draws beside the colored patches, or in their place.
enum class Overlay { normals, back_sides, cuts, wireframe, smooth };
inline constexpr Overlay all_overlays[] = {Overlay::normals, Overlay::back_sides, Overlay::cuts,
                                           Overlay::wireframe, Overlay::smooth};

}  // namespace transillum::viewer
