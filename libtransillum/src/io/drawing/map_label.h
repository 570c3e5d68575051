// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cairo.h>

#include "io/drawing/line_chart.h"
#include "io/maps/map_drawing.h"

namespace transillum {

inline constexpr const char* label_font = "DejaVu Sans";
inline constexpr ChartColor map_title_ink{0x1b, 0x21, 0x2a};

/// Draws the label of a map, white with a dark edge; its text is text where the surface has text.
void draw_map_label(cairo_t* cairo, const PlacedLabel& label);

}  // namespace transillum
